"""Blocks that decide. A boolean is 0 or 1; every number except 0 counts as true."""

from __future__ import annotations

from saltus import _core
from saltus.library.block import Block

__all__ = [
    "Comparator",
    "Counter",
    "HitCrossing",
    "IfThenElse",
    "LogicalOperator",
    "MultiportSwitch",
    "Relay",
    "Stop",
    "Switch",
]


class Comparator(Block, _core.Comparator):
    """y = u_0 operator u_1, entry by entry: 0 or 1.

    The first four are located by the smooth guard u_0 - u_1, and y is held between such instants;
    == and != have no guard and are meant for held signals.

    Parameters
    ----------
    operator
        "<", "<=", ">", ">=", "==" or "!=".
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If the operator is unknown.

    Examples
    --------
    >>> from saltus.library import Comparator
    >>> saltus.response(Comparator("<"), [1.0, 4.0], 2.0)
    array([1., 0.])
    """

    def __init__(self, operator: str, *, name: str | None = None):
        super().__init__(self._named(name), operator)


class LogicalOperator(Block, _core.LogicalOperator):
    """y = function(u_0, u_1, ...), entry by entry: 0 or 1. Every number except 0 counts as true.

    Parameters
    ----------
    function
        "or", "and", "not", "nor", "nand" or "xor" (an odd number of inputs is true).
    n_inputs
        How many inputs there are; "not" takes 1.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If the function is unknown, or does not take this number of inputs.

    Examples
    --------
    >>> from saltus.library import LogicalOperator
    >>> saltus.response(LogicalOperator("and"), [1.0, 1.0], [0.0, 1.0])
    array([0., 1.])
    """

    def __init__(self, function: str, n_inputs: int = 2, *, name: str | None = None):
        super().__init__(self._named(name), function, n_inputs)


class Switch(Block, _core.Switch):
    """y = true_value if control, else false_value: the names of its inputs, true_value, control,
    false_value in this order.

    Parameters
    ----------
    threshold
        Without it control is a boolean, or a real signal that is true while it does not rest at 0,
        also where it moves through 0. With a number, in the unit of control, control is a
        real signal, and true at or above the number; the times at which it passes are located as events.
        The number is the parameter `threshold` of the context.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Examples
    --------
    >>> from saltus.library import Clock, Switch
    >>> saltus.response(Switch(2.0), 5.0, Clock(), 1.0, t=[1.0, 3.0])
    array([1., 5.])
    """

    def __init__(self, threshold: float | None = None, *, name: str | None = None):
        super().__init__(self._named(name), threshold)


class Counter(Block, _core.Counter):
    """y = the number of edges of the input `trigger`, a boolean. With a limit it counts 0, 1, ...,
    limit - 1, 0, ...

    Parameters
    ----------
    edge
        "rising", "falling" or "either".
    limit
        A whole number > 0, if any.
    initial_state
        The count at the start.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If the edge is unknown, or the limit is not above 0.

    Examples
    --------
    >>> from saltus.library import Counter, Pulse
    >>> saltus.response(Counter(), Pulse(period=2.0, phase_delay=1.0), t=[0.5, 1.5, 4.0])
    array([0., 1., 2.])
    """

    def __init__(
        self,
        edge: str = "rising",
        limit: int | None = None,
        initial_state: int = 0,
        *,
        name: str | None = None,
    ):
        super().__init__(self._named(name), edge, limit, initial_state)


class HitCrossing(Block, _core.HitCrossing):
    """Logs the times at which u passes an offset: the event `hit` of the block. No output.

    It is a monitor: the trajectory has the same bits with and without it.

    Parameters
    ----------
    offset
        The value to pass, in the unit of u. It is a parameter of the context.
    direction
        The direction of u - offset: "crosses_zero", "positive_then_non_positive" or
        "negative_then_non_negative".
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If the direction is unknown.

    Examples
    --------
    >>> from saltus.library import HitCrossing, Sine
    >>> builder = saltus.DiagramBuilder()
    >>> sine, half = builder.add(Sine(), HitCrossing(0.5, name="half"))
    >>> builder.connect(sine.output(), half.input())
    >>> diagram = builder.build()
    >>> results = saltus.simulate(diagram, diagram.create_context(), (0.0, 3.0))
    >>> results.events.times("half.hit").round(6)
    array([0.523599, 2.617994])
    """

    def __init__(
        self, offset: float = 0.0, direction: str = "crosses_zero", *, name: str | None = None
    ):
        super().__init__(self._named(name), offset, direction)


class IfThenElse(Block, _core.IfThenElse):
    """y = true_value if condition else false_value, entry by entry: the names of its inputs,
    condition, true_value, false_value in this order. The condition is a boolean, or a real signal
    that is true while it does not rest at 0, also where it moves through 0.

    Parameters
    ----------
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Examples
    --------
    >>> from saltus.library import IfThenElse
    >>> saltus.response(IfThenElse(), 1.0, [5.0, 6.0], 0.0)
    array([5., 6.])
    """

    def __init__(self, *, name: str | None = None):
        super().__init__(self._named(name))


class MultiportSwitch(Block, _core.MultiportSwitch):
    """y = u_k, where k is the whole number nearest to the input `control`, at least 0 and at most
    the last input; entry by entry.

    If y reaches a derivative, the times at which control passes k - 1/2 are located as events.

    Parameters
    ----------
    n_inputs
        How many inputs in_0, in_1, ... there are beside `control`, 1 or more.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If there is no input.

    Examples
    --------
    >>> from saltus.library import Clock, MultiportSwitch
    >>> saltus.response(MultiportSwitch(3), Clock(), 10.0, 20.0, 30.0, t=[0.0, 1.2, 9.0])
    array([10., 20., 30.])
    """

    def __init__(self, n_inputs: int, *, name: str | None = None):
        super().__init__(self._named(name), n_inputs)


class Relay(Block, _core.Relay):
    """y = on_value once u has reached on_threshold, off_value once it has fallen to off_threshold.

    Numbers only. Both switches are located as events, everywhere: the mode, 1 for on, is a state. A
    start at or beyond a threshold has its side. If the thresholds are equal when the block is made
    it has no mode: in a loop such a relay chatters, and the run ends with that status.

    Parameters
    ----------
    on_threshold, off_threshold
        The thresholds, in the unit of u; off_threshold <= on_threshold.
    on_value, off_value
        The values of y. All four are parameters of the context.
    initially_on
        The side of a start between the thresholds.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If off_threshold is above on_threshold.

    Examples
    --------
    >>> from saltus.library import Relay, Sine
    >>> saltus.response(Relay(0.5, -0.5), Sine(), t=[0.5, 0.6, 3.5, 3.7])
    array([0., 1., 1., 0.])
    """

    def __init__(
        self,
        on_threshold: float = 1.0,
        off_threshold: float = 0.0,
        on_value: float = 1.0,
        off_value: float = 0.0,
        *,
        initially_on: bool = False,
        name: str | None = None,
    ):
        super().__init__(
            self._named(name), on_threshold, off_threshold, on_value, off_value, initially_on
        )


class Stop(Block, _core.Stop):
    """Ends the run when its input, a boolean, becomes true; at once if it is true.

    The status is 'terminal', and the row after the instant is kept.

    Parameters
    ----------
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Examples
    --------
    >>> from saltus.library import Comparator, Clock, Constant, Stop
    >>> builder = saltus.DiagramBuilder()
    >>> t, two, late, stop = builder.add(Clock(), Constant(2.0), Comparator(">="), Stop())
    >>> builder.connect(t.output(), late.input(0))
    >>> builder.connect(two.output(), late.input(1))
    >>> builder.connect(late.output(), stop.input())
    >>> diagram = builder.build()
    >>> results = saltus.simulate(diagram, diagram.create_context(), (0.0, 5.0))
    >>> results.status, round(results.context.time, 9)
    ('terminal', 2.0)
    """

    def __init__(self, *, name: str | None = None):
        super().__init__(self._named(name))
