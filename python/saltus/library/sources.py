"""Blocks without inputs. Their output is called 'out'."""

from __future__ import annotations

from numpy.typing import ArrayLike

from saltus import _core
from saltus.library.block import Block

__all__ = ["Clock", "Constant", "Pulse", "Ramp", "Sine", "Step"]


class Constant(Block, _core.Constant):
    """y = value. Never computed during a run.

    Parameters
    ----------
    value
        A number, a vector or a matrix. It is the parameter `value` of the context, of a matrix its
        entries row by row.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Examples
    --------
    >>> from saltus.library import Constant
    >>> saltus.response(Constant([1.0, 2.0]))
    array([1., 2.])
    """

    def __init__(self, value: ArrayLike, *, name: str | None = None):
        super().__init__(self._named(name), value)


class Step(Block, _core.Step):
    """y = start_value for t < step_time, else end_value.

    Parameters
    ----------
    start_value, end_value
        Numbers, vectors or matrices. Parameters of the context.
    step_time
        [s] One exact event.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Examples
    --------
    >>> from saltus.library import Step
    >>> saltus.response(Step(0.0, 5.0, step_time=2.0), t=[1.0, 2.0, 3.0])
    array([0., 5., 5.])
    """

    def __init__(
        self,
        start_value: ArrayLike = 0.0,
        end_value: ArrayLike = 1.0,
        step_time: float = 1.0,
        *,
        name: str | None = None,
    ):
        super().__init__(self._named(name), start_value, end_value, step_time)


class Sine(Block, _core.Sine):
    """y = amplitude sin(frequency t + phase) + bias.

    Parameters
    ----------
    amplitude, bias
        Values in the unit of y, a number or a vector each.
    frequency
        [rad/s]
    phase
        [rad] All four are parameters of the context.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Examples
    --------
    >>> from saltus.library import Sine
    >>> saltus.response(Sine(2.0, frequency=np.pi / 2), t=[0.0, 1.0, 3.0])
    array([ 0.,  2., -2.])
    """

    def __init__(
        self,
        amplitude: ArrayLike = 1.0,
        frequency: ArrayLike = 1.0,
        phase: ArrayLike = 0.0,
        bias: ArrayLike = 0.0,
        *,
        name: str | None = None,
    ):
        super().__init__(self._named(name), amplitude, frequency, phase, bias)


class Clock(Block, _core.Clock):
    """y = t, the time [s].

    Parameters
    ----------
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Examples
    --------
    >>> from saltus.library import Clock
    >>> saltus.response(Clock(), t=[0.5, 1.5])
    array([0.5, 1.5])
    """

    def __init__(self, *, name: str | None = None):
        super().__init__(self._named(name))


class Ramp(Block, _core.Ramp):
    """y = start_value + slope max(0, t - start_time).

    Parameters
    ----------
    start_value, slope
        Numbers, vectors or matrices, slope in units of y per second. Parameters of the context.
    start_time
        [s] The kink there is an exact event.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Examples
    --------
    >>> from saltus.library import Ramp
    >>> saltus.response(Ramp(1.0, slope=2.0, start_time=1.0), t=[0.5, 1.0, 2.0])
    array([1., 1., 3.])
    """

    def __init__(
        self,
        start_value: ArrayLike = 0.0,
        slope: ArrayLike = 1.0,
        start_time: float = 1.0,
        *,
        name: str | None = None,
    ):
        super().__init__(self._named(name), start_value, slope, start_time)


class Pulse(Block, _core.Pulse):
    """y = amplitude in the first part of each period, else 0.

    Parameters
    ----------
    amplitude
        A number or a vector. Parameter of the context.
    period
        [s] From one rising edge to the next. Edges are exact events, counted by integers.
    pulse_width
        The part of a period in which y is `amplitude`, 0 to 1.
    phase_delay
        [s] When the first period begins; before it y is 0.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If the period is not above 0, or the width is outside 0 to 1.

    Examples
    --------
    >>> from saltus.library import Pulse
    >>> saltus.response(Pulse(3.0, period=2.0, pulse_width=0.25), t=[0.25, 1.0, 2.25])
    array([3., 0., 3.])
    """

    def __init__(
        self,
        amplitude: ArrayLike = 1.0,
        *,  # in other tools the width is before the period
        period: float = 1.0,
        pulse_width: float = 0.5,
        phase_delay: float = 0.0,
        name: str | None = None,
    ):
        super().__init__(self._named(name), amplitude, period, pulse_width, phase_delay)
