"""`LeafSystem`: a block of your own, declared in its constructor."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from typing import Any

from numpy.typing import ArrayLike

from saltus import _core
from saltus._declarations import (
    EVERYTHING,
    RequiresInputs,
    callback_of,
    direction_of,
    initial_of,
    inputs_of,
    places_of,
    shape_of,
)
from saltus._porting import refusing
from saltus.errors import ModelError
from saltus.system import System

__all__ = ["LeafSystem"]


class LeafSystem(System, _core.LeafSystem):
    """A block with equations of its own. Call `super().__init__(name=...)`, then declare.

    A callback runs in one of three ways; `system.explain()` says which, and why not faster:

    - *traced*: before a run it is called once with symbols and becomes an expression that runs
      without the interpreter, with an exact Jacobian. If a value that it read has changed, such as
      an attribute, it is traced again before the next run, and between two pieces of one;
    - *called*: a callback that cannot be traced, for example because it branches on a value, prints
      or counts, is called for every value. The option `python="called"` has all of them called;
    - *compiled*: a pointer to a compiled function in place of a Python one, see `saltus.compiled`.

    Every callback is called as `f(time, state, *inputs, **parameters)`:

    - `time` [s] is a float;
    - `state` has `continuous_state`, `discrete_state` (read-only arrays of the declared shapes) and
      `mode`, `relations`, and `with_continuous_state(x)`, `with_discrete_state(z)`, `with_mode(m)`,
      which return a new state;
    - inputs come in the order of the ports, a float for one number, else a read-only array.
      `requires_inputs` says which: True all, False none, a list of positions those. Say it
      precisely: an input that is not read is neither computed nor part of a loop;
    - parameters come by keyword, a float for a number, else a read-only array.

    A callback returns numbers as a list, a tuple or an array, one number as itself too; a Jacobian
    also as a sparse matrix of SciPy. A reset map or an update returns a state, or numbers alone:
    these are the one state that the block has. If it has a continuous and a discrete one, they are
    the discrete one in an update, and a reset map has to say which. Another number of them than
    expected is a `ModelError`.

    Every array may be kept: it never changes. A callback must not change the world: it is called as
    often as the engine likes, from the thread that runs the simulation. `simulate` raises the
    exception of a callback unchanged.

    A callback that returns numbers may fill an array in their place, which is quicker: one with an
    argument called `out`, the last or by keyword, gets an array of the shape of the state for an
    ode, n by n for a Jacobian, else with an entry for each number. It sets every entry (they begin
    as NaN) and returns nothing; an output then has to say its `shape`.

    Examples
    --------
    >>> import saltus
    >>> class Oscillator(saltus.LeafSystem):
    ...     def __init__(self):
    ...         super().__init__(name="oscillator")
    ...         self.declare_continuous_state(default_value=[1.0, 0.0], ode=self.ode)
    ...
    ...     def ode(self, time, state, out):
    ...         x, v = state.continuous_state
    ...         out[0], out[1] = v, -x
    >>> print(Oscillator().explain())
    oscillator: ode  traced

    A room that a thermostat heats, and that counts its hours:

    >>> class Room(saltus.LeafSystem):
    ...     def __init__(self):
    ...         super().__init__(name="room")
    ...         self.declare_continuous_state(default_value=[20.0], ode=self.flow)
    ...         self.declare_discrete_state(default_value=[0.0])
    ...         self.declare_default_mode(1)
    ...         self.declare_dynamic_parameter("power", 30.0)
    ...         self.declare_input_port("outside")
    ...         self.declare_output_port(self.gap, name="gap")
    ...         self.declare_continuous_state_output("temperature")
    ...         self.declare_discrete_state_output("hours")
    ...         self.declare_mode_output("on")
    ...         self.declare_zero_crossing(self.warm, name="warm", start_mode=1, end_mode=0)
    ...         self.declare_zero_crossing(self.cold, name="cold", start_mode=0, end_mode=1)
    ...         self.declare_periodic_update(self.count, period=1.0, offset=1.0)
    ...         self.declare_one_shot(self.open_window, 0.5)
    ...
    ...     def flow(self, time, state, outside, *, power):
    ...         return [power * state.mode + outside - state.continuous_state[0]]
    ...
    ...     def gap(self, time, state, outside, *, power):
    ...         return state.continuous_state[0] - outside
    ...
    ...     def warm(self, time, state, outside, *, power):
    ...         return state.continuous_state[0] - 21.0
    ...
    ...     def cold(self, time, state, outside, *, power):
    ...         return state.continuous_state[0] - 19.0
    ...
    ...     def count(self, time, state, outside, *, power):
    ...         return state.with_discrete_state(state.discrete_state + 1.0)
    ...
    ...     def open_window(self, time, state, outside, *, power):
    ...         return state.with_continuous_state(state.continuous_state - 2.0)
    >>> from saltus.library import Constant
    >>> builder = saltus.DiagramBuilder()
    >>> room, outside = builder.add(Room(), Constant(5.0))
    >>> builder.connect(outside.output(), room.input("outside"))
    >>> house = builder.build()
    >>> end = saltus.simulate(house, house.create_context(), (0.0, 3.5)).context[room]
    >>> end.discrete_state, bool(19.0 - 2.0 <= end.continuous_state[0] <= 21.0)
    (array([3.]), True)
    """

    __slots__ = ("_callbacks", "_made")  # not in __dict__, which a traced function is watched by

    @refusing
    def __init__(self, name: str | None = None):
        super().__init__(name or _core.next_name(type(self).__name__))
        self._made = True  # before that a declaration would find no block to declare in

    @refusing
    def declare_continuous_state(
        self,
        shape: int | tuple[int, ...] | ArrayLike | None = None,
        default_value: ArrayLike | None = None,
        ode: Callable[..., ArrayLike] | None = None,
        requires_inputs: RequiresInputs = True,
        jacobian: Callable[..., ArrayLike] | None = None,
        jacobian_sparsity: Any = None,
        sparse_jacobian: Callable[..., ArrayLike] | None = None,
    ) -> None:
        """The continuous state x, with dx/dt = ode(time, state, *inputs, **parameters), in units of
        x per second.

        `shape` n is a vector of n zeros, () a single number; `default_value` (or an array in place
        of the shape) says where it starts. Without `ode` it is constant between resets. `jacobian`
        gives the n by n matrix d(ode)/dx, row by row, for a stiff method; without it, and for
        entries that are not finite, differences are used. Once a block.

        `jacobian_sparsity` says where d(ode)/dx may differ from zero, in every mode: an n by n
        array or a scipy.sparse matrix, not zero there, or a pair (rows, columns), each place once;
        a stiff method then needs neither memory nor calls for the others. Name too many rather than
        too few. `sparse_jacobian` gives the values there, in that order (for a matrix that of its
        `nonzero()`).
        """
        what = f"block '{self.name}': continuous state"
        initial = initial_of(what, shape, default_value)
        places = None if jacobian_sparsity is None else places_of(what, jacobian_sparsity)
        if sparse_jacobian is not None and places is None:
            raise ModelError(f"{what}: sparse_jacobian without jacobian_sparsity; give both")
        super().declare_continuous_state(
            initial,
            callback_of(ode),
            inputs_of(requires_inputs),
            callback_of(jacobian),
            places,
            callback_of(sparse_jacobian),
        )

    @refusing
    def declare_discrete_state(
        self,
        default_value: ArrayLike | None = None,
        shape: int | tuple[int, ...] | None = None,
    ) -> None:
        """The discrete state z, numbers that only resets and updates change. Once a block."""
        super().declare_discrete_state(
            initial_of(f"block '{self.name}': discrete state", shape, default_value)
        )

    @refusing
    def declare_default_mode(self, mode: int) -> None:
        """The mode the block starts in: an integer that selects among its zero crossings, see
        `start_mode` there.
        """
        super().declare_default_mode(mode)

    @refusing
    def declare_dynamic_parameter(self, name: str, default_value: ArrayLike) -> None:
        """A number or an array that lives in the context, `context.with_parameter(name, value)`,
        and that every callback gets by keyword.
        """
        super().declare_dynamic_parameter(name, default_value)

    @refusing
    def declare_input_port(
        self, name: str | None = None, shape: int | tuple[int, ...] | None = None
    ) -> int:
        """An input, called in_0, in_1, ... if not said; returns its position.

        With a `shape`, another one is refused. An input of one number comes as a float, with shape
        1 as an array.
        """
        return super().declare_input_port(name or "", shape_of(shape))

    @refusing
    def declare_output_port(
        self,
        callback: Callable[..., ArrayLike],
        name: str | None = None,
        requires_inputs: RequiresInputs = True,
        shape: int | tuple[int, ...] | None = None,
        default_value: ArrayLike | None = None,
        boolean: bool | None = None,
        reads: Iterable[str] = EVERYTHING,
    ) -> int:
        """An output, y = callback(time, state, *inputs, **parameters), called out_0, out_1, ... if
        not said; returns its position.

        `shape` (or the shape of `default_value`) is () for a number, n for a vector. Where it is
        not said, and where `boolean` is not, callback is called once before the run, with inputs at
        zero, to see. A boolean output that reaches a derivative or a reset is located by bisection
        and held in between. `reads` says what it depends on, of 'time', 'continuous_state',
        'discrete_state', 'mode', 'inputs': what reads neither time nor a continuous state is
        computed at events only, not at every stage of the solver.
        """
        inputs = inputs_of(requires_inputs)
        return super().declare_output_port(
            callback_of(callback),
            name or "",
            inputs,
            shape_of(shape, default_value),
            boolean,
            list(reads),
            _core.Convention.state,
        )

    @refusing
    def declare_continuous_state_output(self, name: str | None = None) -> int:
        """An output that shows the whole continuous state; it is never copied. Returns its
        position.
        """
        return super().declare_continuous_state_output(name or "")

    @refusing
    def declare_discrete_state_output(self, name: str | None = None) -> int:
        """An output that shows the whole discrete state; it is never copied. Returns its
        position.
        """
        return super().declare_discrete_state_output(name or "")

    @refusing
    def declare_mode_output(self, name: str | None = None) -> int:
        """An output that shows the mode. Returns its position."""
        return super().declare_mode_output(name or "")

    @refusing
    def declare_zero_crossing(
        self,
        guard: Callable[..., ArrayLike],
        reset_map: Callable[..., _core.State | ArrayLike] | None = None,
        name: str | None = None,
        direction: str = "crosses_zero",
        start_mode: int | None = None,
        end_mode: int | None = None,
        terminal: bool = False,
        zeno_tolerance: float | None = None,
        requires_inputs: RequiresInputs = True,
        max_count: int = 1,
        size: int = 1,
        at_start: str = "auto",
        on_zeno: str | int = "hold",
        holds: Sequence[Sequence[int]] | None = None,
    ) -> None:
        """An event where g = guard(time, state, *inputs, **parameters), a smooth number in any
        unit, reaches zero or crosses it. A truth is a guard, too, with the positive side where it
        is true: `x[0] > 0` is located as smoothly as x[0], any other truth where it jumps. Without
        a reset map, a mode change and `terminal` it is only logged, and changes nothing.

        - `reset_map`, called like the guard, returns x+ from x-, the state before the event, or the
          numbers of the one state that the block has.
        - `direction` is 'crosses_zero' (or 'both'), 'positive_then_non_positive' ('falling'),
          'negative_then_non_negative' ('rising'), 'edge_detection' (any change, for values that
          jump) or 'none' (never).
        - With `start_mode` it is seen in that mode only; `end_mode` is the mode after it.
        - `terminal` ends the run after the reset map, `max_count` n when it happens the n-th time.
        - `size` n is n guards in one: the guard returns n numbers, each fires for itself, and
          `state.entry` tells the reset map which one did, 0 to n - 1.
        - `at_start` is for a guard at zero, or on its firing side, when a run starts or its mode is
          entered. 'auto': at zero and headed for the firing side it fires at once if it has a reset
          map or changes the mode, and waits if not; on the firing side it waits until it has been
          on the other. 'ignore' waits, 'fire' fires at once, 'error' is a SimulationError.
        - `on_zeno` says what becomes of the block where events accumulate. 'hold': the state rests
          at the accumulation state until the guard moves to its armed side. 'stop': the run ends,
          status 'zeno_stop'. 'error': a SimulationError. An integer: the mode to go on in.
        - `holds` lists, for each of the `size` guards, the positions in the continuous state that
          rest on a hold, such as [[0, 1]]; without it all do.
        - `zeno_tolerance` [s] overrides that of the simulator options, 0 switches the monitor off.

        A ModelError for a name declared twice, an unknown direction, `at_start` or `on_zeno` (with
        the nearest name), a `size` or `max_count` below 1, a `max_count` without `terminal`, a
        negative `zeno_tolerance`, and `holds` of another length or beyond the state.
        """
        options = {
            "direction": direction_of(direction),
            "start_mode": start_mode,
            "end_mode": end_mode,
            "terminal": terminal,
            "max_count": max_count,
            "size": size,
            "at_start": at_start,
            "on_zeno": on_zeno,
            "zeno_tolerance": zeno_tolerance,
            "holds": holds,
            "inputs": inputs_of(requires_inputs),
        }
        super().declare_zero_crossing(
            callback_of(guard), callback_of(reset_map), name or "", options
        )

    @refusing
    def declare_relation(
        self,
        guard: Callable[..., ArrayLike],
        name: str | None = None,
        true_at_zero: bool = False,
        requires_inputs: RequiresInputs = True,
        size: int = 1,
        reads: Iterable[str] = EVERYTHING,
    ) -> int:
        """A truth with a smooth guard: true while g = guard(time, state, *inputs, **parameters) is
        positive. Returns its position in `state.relations`.

        The engine locates the zeros of the guard and holds the truth between them, so a derivative
        may jump with the truth. `true_at_zero` is the truth for g = 0 where no side is known yet.
        With `size` n the guard returns n numbers, and the truth is a read-only array of 0 and 1 in
        place of a bool. `reads` is as for `declare_output_port`. An output that reads
        `state.relations` is declared after the relation. A callback that reads them is called, not
        traced; the guard itself is traced.

        Raises ModelError for a name declared twice and for a `size` below 1.

        Examples
        --------
        >>> class Tank(saltus.LeafSystem):
        ...     def __init__(self):
        ...         super().__init__(name="tank")
        ...         self.declare_continuous_state([20.0], ode=self.ode)
        ...         self.full = self.declare_relation(self.above, name="full")
        ...
        ...     def above(self, time, state):
        ...         return state.continuous_state[0] - 25.0
        ...
        ...     def ode(self, time, state):
        ...         return [0.5 if state.relations[self.full] else 1.0]
        >>> tank = Tank()
        >>> end = saltus.simulate(tank, tank.create_context(), (0.0, 9.0)).context
        >>> f"{end.continuous_state[0]:.6f}"
        '27.000000'
        """
        return super().declare_relation(
            callback_of(guard),
            name or "",
            true_at_zero,
            size,
            inputs_of(requires_inputs),
            list(reads),
        )

    @refusing
    def declare_edge_reset(
        self,
        reset_map: Callable[..., _core.State | ArrayLike],
        input: int,
        edge: str = "rising",
        name: str | None = None,
        on_zeno: str | int = "hold",
        zeno_tolerance: float | None = None,
        requires_inputs: RequiresInputs = True,
    ) -> None:
        """A reset at an edge of an input, read as a boolean: every number except 0 is true.

        `reset_map`, called like a guard, returns x+ from x-. `edge` is 'rising', 'falling' or
        'either'. The signal has to be held: a comparison, a logical block, a discrete state. The
        input needs no guard of its own. `on_zeno` and `zeno_tolerance` are as for
        `declare_zero_crossing`; a hold ends when the signal falls back.

        Raises ModelError for a name declared twice, an unknown `edge` or `on_zeno`.

        Examples
        --------
        >>> class Counter(saltus.LeafSystem):
        ...     def __init__(self):
        ...         super().__init__(name="counter")
        ...         self.declare_discrete_state([0.0])
        ...         self.declare_input_port("gate")
        ...         self.declare_edge_reset(self.count, input=0, edge="falling")
        ...
        ...     def count(self, time, state, gate):
        ...         return state.with_discrete_state(state.discrete_state + 1.0)
        >>> from saltus.library import Pulse
        >>> builder = saltus.DiagramBuilder()
        >>> pulse, counter = builder.add(Pulse(period=1.0), Counter())
        >>> builder.connect(pulse.output(), counter.input())
        >>> diagram = builder.build()
        >>> end = saltus.simulate(diagram, diagram.create_context(), (0.0, 3.75)).context
        >>> end.discrete_state
        array([4.])
        """
        options = {
            "edge": edge,
            "on_zeno": on_zeno,
            "zeno_tolerance": zeno_tolerance,
            "inputs": inputs_of(requires_inputs),
        }
        super().declare_edge_reset(callback_of(reset_map), input, name or "", options)

    @refusing
    def declare_periodic_update(
        self,
        callback: Callable[..., _core.State | ArrayLike],
        period: float,
        offset: float = 0.0,
        name: str | None = None,
    ) -> None:
        """At offset + k period [s], k = 0, 1, ..., callback returns the new state, or the new
        discrete state alone (the continuous one where the block has no other).
        """
        super().declare_periodic_update(callback_of(callback), period, offset, name or "")

    @refusing
    def declare_time_event(
        self,
        callback: Callable[..., _core.State | ArrayLike] | None = None,
        *,
        times: Sequence[float] | None = None,
        period: float | None = None,
        offset: float = 0.0,
        end: float = math.inf,
        count: int | None = None,
        name: str | None = None,
    ) -> None:
        """At each of `times` [s], or at offset + k period [s], k = 0, 1, ..., or once at `offset`,
        callback returns the new state, or the new discrete state alone.

        None is later than `end` [s], and there are `count` at most, from the first one on. The
        times increase. None for a callback is an exact stop where held outputs are read again.

        Raises
        ------
        ModelError
            For times that do not increase, for times beside a period or an offset, and for a period
            or a count that is not positive.

        Examples
        --------
        >>> class Doses(saltus.LeafSystem):
        ...     def __init__(self):
        ...         super().__init__(name="doses")
        ...         self.declare_continuous_state([0.0], ode=lambda t, s: -s.continuous_state)
        ...         self.declare_time_event(self.dose, times=[0.5, 1.0, 4.0], end=2.0, name="dose")
        ...     def dose(self, time, state):
        ...         return state.with_continuous_state(state.continuous_state + 1.0)
        >>> doses = Doses()
        >>> results = saltus.simulate(doses, doses.create_context(), (0.0, 5.0))
        >>> results.events.times("dose", "time").tolist()
        [0.5, 1.0]
        """
        try:
            listed = None if times is None else [float(t) for t in times]
        except (TypeError, ValueError):
            raise ModelError(
                f"block '{self.name}': time event: expected times [s], found {times!r}"
            ) from None
        super().declare_time_event(
            callback_of(callback), period, offset, listed, end, count, name or ""
        )

    @refusing
    def declare_one_shot(
        self,
        callback: Callable[..., _core.State | ArrayLike] | None,
        time: float,
        name: str | None = None,
    ) -> None:
        """The same once, at `time` [s]. None for a callback is an exact stop where held outputs are
        read again.
        """
        super().declare_one_shot(callback_of(callback), time, name or "")
