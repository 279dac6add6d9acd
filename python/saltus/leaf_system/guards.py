"""The guards of a block: zero crossings and relations."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

from numpy.typing import ArrayLike

from saltus import _core
from saltus._declarations import EVERYTHING, RequiresInputs, callback_of, direction_of, inputs_of
from saltus._porting import refusing
from saltus._quantities import Declared, mode_of, on_zeno_of
from saltus._whole import is_whole
from saltus.leaf_system.derivatives import columns_of

__all__ = ["DeclaresGuards"]


def _for_each_guard(holds: object, size: object) -> object:
    """The positions of a single guard as a list of lists."""
    flat = isinstance(holds, (list, tuple)) and len(holds) > 0 and all(map(is_whole, holds))
    return [holds] if flat and size == 1 else holds


class DeclaresGuards(_core.LeafSystem):
    """Declares events that are located by the zeros of a function, or by an edge of an input."""

    __slots__ = ()

    _declared_quantities: Declared

    @refusing
    def declare_zero_crossing(
        self,
        guard: Callable[..., ArrayLike],
        reset_map: Callable[..., _core.State | ArrayLike] | None = None,
        name: str | None = None,
        direction: str = "crosses_zero",
        start_mode: int | str | None = None,
        end_mode: int | str | None = None,
        terminal: bool = False,
        zeno_tolerance: float | None = None,
        requires_inputs: RequiresInputs = True,
        max_count: int = 1,
        size: int = 1,
        at_start: str = "auto",
        on_zeno: str | int = "hold",
        holds: Sequence[Sequence[int]] | Sequence[int] | None = None,
        formula: bool = False,
        delay: float | Callable[..., ArrayLike] | None = None,
        priority: float | Callable[..., ArrayLike] | None = None,
        persistent: bool | None = None,
        initial_value: bool | None = None,
        use_values_from_trigger_time: bool | None = None,
        guard_derivatives: Callable[..., Mapping[str, ArrayLike]] | None = None,
        reset_derivatives: Callable[..., Mapping[str, ArrayLike]] | None = None,
    ) -> None:
        """Declares an event that happens where g = guard(time, state, *inputs, **parameters), a
        smooth number in any unit, reaches zero or crosses it. A truth is a guard too, positive
        where it is true: `x[0] > 0` is located as smoothly as x[0], any other truth where it jumps.
        Without a reset map, a mode change and `terminal` the event is only logged, and changes
        nothing.

        - `reset_map`, called like the guard, returns x+ from x-, the state before the event, or the
          numbers of the one state that the block has.
        - `direction` is 'crosses_zero' (or 'both'), 'positive_then_non_positive' ('falling'),
          'negative_then_non_negative' ('rising'), 'edge_detection' (any change, for values that
          jump) or 'none' (never).
        - With `start_mode` the guard is seen in that mode only; `end_mode` is the mode after the
          event. A mode is an integer, or its name, if `declare_default_mode` was given names before.
        - `terminal` ends the run after the reset map; with `max_count` n, when the event happens
          the n-th time.
        - `size` n is n guards in one: the guard returns n numbers, each fires on its own, and in
          the reset map `state.entry` is the index of the guard that fired, 0 to n - 1.
        - `at_start` is for a guard at zero, or on its firing side, when a run starts or its mode is
          entered. With 'auto' a guard that is at zero and headed for the firing side fires at once
          if it has a reset map or changes the mode, and otherwise waits; on the firing side it
          waits until it has been on the other side. 'ignore' waits, 'fire' fires at once, 'error'
          is a SimulationError.
        - `on_zeno` decides how the block continues where events accumulate. 'hold': the state rests
          at the accumulation state until the guard moves to its armed side. 'stop': the run ends,
          status 'zeno_stop'. 'error': a SimulationError. A mode: the one to go on in.
        - `holds` lists, for each of the `size` guards, the positions in the continuous state that
          rest on a hold, such as [[0, 1], [2, 3]], or [0, 1] for a single guard. Without it those
          rest that the reset map changes and those that the guard reads, or all where a function is
          called. A floor whose position is a state of the same block rests too, unless `holds`
          leaves it out.
        - `zeno_tolerance` [s] overrides that of the simulator options, 0 switches the monitor off.
        - `formula` has the meaning of the same argument of `declare_output_port`, for the guard.
        - `guard_derivatives` gives those of the guard, with `size` rows, as `derivatives` in
          `declare_continuous_state`. `reset_derivatives` gives those of the reset map: the rows are
          all of x+, then z+, and an entry that the reset map keeps has the row of the identity.

        With any of the following it is *queued*, like an event of SBML (Level 3 Version 2, section
        4.11): its firing is a trigger, which schedules an execution of the reset map and of
        `end_mode`. It has an effect, is not `terminal`, and no Zeno monitor.

        - `delay` [s], >= 0, is the time from the trigger to the execution: a number, or a function
          that is called like the guard, at the trigger.
        - `priority` is a number or a function. Of the executions that are due at one time that with
          the highest priority comes first; priorities are evaluated anew before each execution.
          Equal priorities come in a random order, by `event_seed` of the options, and executions
          without a priority after all others.
        - `persistent=False`: if the guard goes back before the execution, the execution is
          cancelled.
        - `initial_value` says whether the guard counts as on its firing side before the start. With
          False it fires at the start if it is there; with True it waits until it has been on the
          other side.
        - `use_values_from_trigger_time=True`: the reset map is computed at the trigger, and the
          entries of the states that it changes are written at the execution.

        The event log has the kinds 'scheduled', 'cancelled' and 'executed'. A trigger over several
        comparisons is a truth over them, such as `lambda t, s: (s.continuous_state[0] > 1) &
        (s.continuous_state[1] < 2)`, with a direction. A delay that is negative or not finite, or a
        priority that is not a number, is a SimulationError.

        Raises ModelError for a name declared twice, an unknown direction, `at_start` or `on_zeno`
        (with the nearest name), a `size` or `max_count` below 1, a `max_count` without `terminal`,
        a negative `zeno_tolerance`, and `holds` of another length or beyond the state. For a queued
        zero crossing also for `terminal`, a missing effect, options of Zeno holds, a constant delay
        that is negative, and `persistent=False` or `initial_value` without one direction.

        Examples
        --------
        >>> tank = saltus.LeafSystem(name="tank")
        >>> tank.declare_continuous_state([0.0], ode=lambda t, s: [1.0])
        >>> tank.declare_zero_crossing(
        ...     guard=lambda t, s: s.continuous_state[0] - 1.0,
        ...     reset_map=lambda t, s: [0.0],
        ...     name="empty",
        ...     direction="rising",
        ...     delay=0.25,
        ... )
        >>> events = saltus.simulate(tank, tank.create_context(), (0.0, 1.5)).events
        >>> [(event.kind, round(event.time, 9)) for event in events]
        [('scheduled', 1.0), ('executed', 1.25)]
        """
        what = f"block '{self.name}': zero crossing '{name or ''}'"
        options = {
            "direction": direction_of(direction),
            "start_mode": mode_of(what, start_mode, self._declared_quantities.modes),
            "end_mode": mode_of(what, end_mode, self._declared_quantities.modes),
            "terminal": terminal,
            "max_count": max_count,
            "size": size,
            "at_start": at_start,
            "on_zeno": on_zeno_of(what, on_zeno, self._declared_quantities.modes),
            "zeno_tolerance": zeno_tolerance,
            "holds": _for_each_guard(holds, size),
            "formula": bool(formula),
            "inputs": inputs_of(requires_inputs),
            "delay": callback_of(delay),
            "priority": callback_of(priority),
            "persistent": persistent,
            "initial_value": initial_value,
            "use_values_from_trigger_time": use_values_from_trigger_time,
            "yields": bool(getattr(reset_map, "yields", False)),
            "follows_updates": bool(getattr(reset_map, "follows_updates", False)),
            "guard_derivatives": columns_of(
                guard_derivatives, self, inputs_of(requires_inputs), size, "derivatives of guard"
            ),
            "reset_derivatives": columns_of(
                reset_derivatives,
                self,
                inputs_of(requires_inputs),
                "states",
                "derivatives of reset map",
            ),
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
        formula: bool = False,
    ) -> int:
        """Declares a truth with a smooth guard: it is true while g = guard(time, state, *inputs,
        **parameters) is positive. Returns its position in `state.relations`.

        The engine locates the zeros of the guard and holds the truth between them, so a derivative
        may jump with the truth. `true_at_zero` is the truth for g = 0 where no side is known yet.
        With `size` n the guard returns n numbers, and the truth is a read-only array of 0 and 1 in
        place of a bool. `reads` and `formula` have the meaning that they have in
        `declare_output_port`. An output that reads `state.relations` is declared after the
        relation. A callback that reads them is called, not traced; the guard itself is traced.

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
            bool(formula),
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
        """Declares a reset at an edge of an input, read as a boolean: every number except 0 is
        true.

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
        what = f"block '{self.name}': edge reset '{name or ''}'"
        options = {
            "edge": edge,
            "on_zeno": on_zeno_of(what, on_zeno, self._declared_quantities.modes),
            "zeno_tolerance": zeno_tolerance,
            "inputs": inputs_of(requires_inputs),
        }
        super().declare_edge_reset(callback_of(reset_map), input, name or "", options)
