"""`Model`: a model in SBML as a block."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from saltus import _core
from saltus.errors import ModelError
from saltus.leaf_system import LeafSystem
from saltus.sbml.algebraic import unknowns
from saltus.sbml.events import DUE, NEVER, STARTED, Program, events_of
from saltus.sbml.formula import Called, Formula, evaluated
from saltus.sbml.instant import Instant
from saltus.sbml.kinds import FIRST, Kinds, kinds_of
from saltus.sbml.quantities import Declared, declared
from saltus.sbml.reading import model_of
from saltus.sbml.running import RunningScope
from saltus.sbml.scope import InitialScope, Scope

__all__ = ["Model", "load", "model_block"]

AFTER = 1e-13
"""relative; how much later than its zero a strict comparison of the time changes"""
OTHER = {"x", "z", "mode"}
"""ids that no state may have for a name in a context; they are outputs all the same"""
Shown = tuple[str, str]
"""(id, 'value', 'amount' or 'concentration')"""


def load(
    source: str | os.PathLike[str],
    *,
    values: Mapping[str, float] | None = None,
    seed: int = 0,
) -> Model:
    """A model in SBML, any level and version, as a block.

    Parameters
    ----------
    source : str or path
        the file, or the text of the model.
    values : dict of str to float, optional
        values at the start in place of those of the model, by id; the initial assignments of
        others are computed from them. A value that is set later, in a context or a sweep, changes
        itself alone.
    seed : int
        chooses among events of equal priority that are due at one time.

    Returns
    -------
    Model
        its constants are parameters and its variables outputs, all under their ids. Time is in the
        model's unit of time.

    Raises
    ------
    ModelError
        For no file, no XML, errors that libsbml finds (its messages, by line), and for what has no
        time course here, by id: fast reactions, delays of values, algebraic rules that are not
        linear, packages other than 'comp'.

    Examples
    --------
    >>> import saltus, saltus.sbml
    >>> model = saltus.sbml.load('''<sbml xmlns="http://www.sbml.org/sbml/level3/version2/core"
    ...   level="3" version="2"><model id="decay"><listOfParameters>
    ...   <parameter id="x" value="1" constant="false"/>
    ...   <parameter id="k" value="2" constant="true"/></listOfParameters>
    ...   <listOfRules><rateRule variable="x">
    ...   <math xmlns="http://www.w3.org/1998/Math/MathML"><apply><times/><cn>-1</cn>
    ...   <ci>k</ci><ci>x</ci></apply></math></rateRule></listOfRules></model></sbml>''')
    >>> end = saltus.simulate(model, (0.0, 1.0), rtol=1e-9, atol=1e-12).context
    >>> f"{end.continuous_state[0]:.6f}"
    '0.135335'
    """
    _document, model = model_of(source)  # which owns the model
    return model_block(model, seed=seed, values=values)


def model_block(model: Any, *arguments: Any, **how: Any) -> Model:
    """The block of a model of libsbml; ModelError where its formulas are nested too deep."""
    try:
        return Model(model, *arguments, **how)
    except RecursionError:
        raise ModelError(
            "the rules and functions of the model are nested too deep for Python's stack; write "
            "them in fewer levels, or raise sys.setrecursionlimit"
        ) from None


class Model(LeafSystem):
    """A model in SBML. Made by `load`."""

    def __init__(
        self,
        model: Any,
        shown: Iterable[Shown] | None = None,
        seed: int = 0,
        values: Mapping[str, float] | None = None,
    ):
        super().__init__(name=model.getId() or "model")
        says = declared(model)
        for name, value in (values or {}).items():
            says.begin(name, value)
        unknown = says.unknown = unknowns(says) if says.algebraic else []
        numbers = _initial_values(says, unknown)
        kinds = kinds_of(says, unknown, {n for n, v in numbers.items() if v == 0.0})
        made = _Made(kinds, numbers, seed)
        self._declare(made, shown)

    def _declare(self, made: _Made, shown: Iterable[Shown] | None) -> None:
        kinds, named = made.kinds, None if shown is None else list(shown)
        for name, value in zip(kinds.parameters, made.p, strict=True):
            self.declare_dynamic_parameter(name, value if math.isfinite(value) else 0.0)
        self.constants = made.p
        """the parameters at the start, in their order"""
        derivatives = made.derivatives()
        outputs = made.outputs(named)
        program = made.program(derivatives.tape)
        if kinds.states:
            taken = kinds.amounts | OTHER
            free = named is None and taken.isdisjoint(kinds.states)
            self.declare_continuous_state(
                default_value=made.x, ode=derivatives, names=kinds.states if free else ()
            )
        self.curved = program.curved
        _require_finite_start(made, program, derivatives)
        self._declare_events(made, program)
        if named is None:
            known = set(self.output_names)
            for name, formula in outputs.items():
                if name not in known:
                    self.declare_output_port(formula, name=name, shape=(), boolean=False)
        else:
            self.shown = outputs["shown"]
            if kinds.states:
                self.declare_continuous_state_output("x")
            if program.happens:
                self.declare_discrete_state_output("z")

    def _declare_events(self, made: _Made, program: Program) -> None:
        if not program.happens:
            return
        self.declare_discrete_state(made.discrete(program))
        self.declare_zero_crossing(
            made.started(),
            _Start(program),
            name="start",
            direction="rising",
            at_start="fire",
            zeno_tolerance=0.0,
        )
        self.declare_zero_crossing(
            made.guards(),
            _Crossing(program),
            name="events",
            direction="rising",
            size=2 * len(program.timely) + 1,
            zeno_tolerance=0.0,
        )


def _require_finite_start(made: _Made, program: Program, derivatives: Formula) -> None:
    """ModelError, which names the id, for a rate that is not finite at the start."""
    instant = Instant(program, 0.0, made.x, made.discrete(program), made.p)
    if program.happens:
        instant.start()
    rates = evaluated(derivatives.tape, 0.0, instant.x, instant.z, made.p)
    for name, rate in zip(made.kinds.states, rates, strict=True):
        if not math.isfinite(rate):
            raise ModelError(
                f"the rate of '{name}' is {rate:g} at the start; expected a finite number: look at "
                "divisions by zero in its rule and in the reactions that change it"
            )


class _Start(Called):
    def __init__(self, program: Program):
        self.program = program

    def __call__(self, time: float, state: Any, /, **parameters: float) -> Any:
        instant = _instant(self.program, time, state, parameters)
        instant.start()
        return _after(state, instant)


class _Crossing(Called):
    def __init__(self, program: Program):
        self.program = program

    def __call__(self, time: float, state: Any, /, **parameters: float) -> Any:
        instant = _instant(self.program, time, state, parameters)
        instant.crossed(state.entry)
        return _after(state, instant)


def _instant(program: Program, time: float, state: Any, parameters: dict[str, float]) -> Instant:
    p = np.fromiter(parameters.values(), float, len(parameters))
    return Instant(program, time, state.continuous_state, state.discrete_state, p)


def _after(state: Any, instant: Instant) -> Any:
    """The state with what has changed."""
    if not np.array_equal(instant.x, state.continuous_state):
        state = state.with_continuous_state(instant.x)
    if not np.array_equal(instant.z, state.discrete_state):
        state = state.with_discrete_state(instant.z)
    return state


def _initial_values(says: Declared, unknown: list[str]) -> dict[str, float]:
    """What each id stands for at the start, but for those that a run finds by a rule."""
    graph = _core.Graph()
    scope = InitialScope(graph, says, unknown)
    found = {*says.assigned, *unknown}
    nodes = {
        name: scope.value(name)
        for name, quantity in says.quantities.items()
        if (name not in found or quantity.kind == "compartment") and not says.is_unset(name)
    }
    numbers = evaluated(graph.tape(list(nodes.values())), 0.0, (), (), ())
    unset = {name: math.nan for name in says.quantities if says.is_unset(name)}
    return {**unset, **dict(zip(nodes, numbers.tolist(), strict=True))}


class _Made:
    """The formulas of a model."""

    def __init__(self, kinds: Kinds, values: dict[str, float], seed: int):
        self.kinds, self.values, self.seed = kinds, values, seed
        self.x, self.z, self.p = (
            np.array([self.stored(name) for name in names], dtype=float)
            for names in (kinds.states, kinds.held, kinds.parameters)
        )
        self._require_finite()
        self.graph = _core.Graph()
        self.scope = RunningScope(self.graph, kinds, self.p, FIRST + len(kinds.held))

    def stored(self, name: str) -> float:
        """The number that stands for an id in memory, at the start."""
        value = self.values[name]
        if name in self.kinds.held and self.kinds.declared.is_unset(name):
            return 0.0  # which nothing reads before an event has set it
        if name not in self.kinds.amounts:
            return value
        found = self.kinds.declared.quantities[name]
        if found.given_amount and name not in self.kinds.declared.initial:
            return 0.0 if math.isnan(found.value) else found.value
        return value * self.values[found.compartment]

    def _require_finite(self) -> None:
        for names, numbers in ((self.kinds.states, self.x), (self.kinds.held, self.z)):
            for name, value in zip(names, numbers, strict=True):
                if not math.isfinite(value):
                    raise ModelError(
                        f"'{name}' starts at {value:g}; expected a finite number: look at its "
                        "initial assignment, and at divisions by zero"
                    )

    def derivatives(self) -> Formula:
        return Formula(self.graph, [self.scope.stored_rate(n) for n in self.kinds.states])

    def outputs(self, shown: list[Shown] | None) -> dict[str, Formula]:
        if shown is not None:
            return {"shown": Formula(self.graph, [self.shown(*one) for one in shown])}
        says = self.kinds.declared
        names = [n for n in says.quantities if n not in self.kinds.parameters]
        names += [n for n in self.kinds.parameters if says.quantities[n].kind == "species"]
        names = [n for n in names if not says.is_unset(n) or n in self.kinds.held]
        names += [name for name in says.reactions if name]
        return {name: Formula(self.graph, [self.number(name)], True) for name in names}

    def number(self, name: str) -> int:
        """The node of an id that is shown, which may be unset."""
        unset = self.kinds.declared.is_unset(name)
        return self.scope.defined(name) if unset else self.scope.value(name)

    def shown(self, name: str, how: str) -> int:
        """The node of an id as it is to be shown."""
        scope: Scope = self.scope
        found = self.kinds.declared.quantities.get(name)
        if found is None or found.kind != "species" or how == "value":
            return self.number(name)
        if how == "amount" and name in self.kinds.amounts:
            return self.scope.stored(name)
        if (how == "amount") == found.substance:
            return self.number(name)
        op = "mul" if how == "amount" else "div"
        return scope.apply(op, self.number(name), scope.value(found.compartment))

    def program(self, flow: Any) -> Program:
        return events_of(self.scope, flow, self.seed)

    def discrete(self, program: Program) -> np.ndarray:
        """The discrete state before the start."""
        z = np.zeros(program.discrete)
        z[DUE] = NEVER
        z[FIRST : FIRST + len(self.z)] = self.z
        return z

    def started(self) -> Formula:
        """1 before the start of the run, -1 from then on."""
        graph = self.graph
        twice = graph.apply("mul", graph.constant(2.0), graph.discrete_state(STARTED))
        return Formula(graph, [graph.apply("sub", graph.constant(1.0), twice)], True)

    def guards(self) -> Formula:
        """The differences, their negatives, and the time since an execution became due."""
        scope, graph, found = self.scope, self.graph, list(self.scope.differences)
        up = [self.late(n, k not in scope.zero_above) for k, n in enumerate(found)]
        down = [self.late(graph.apply("neg", n), k not in scope.zero_below)
                for k, n in enumerate(found)]  # fmt: skip
        due = graph.apply("sub", graph.time(), graph.discrete_state(DUE))
        return Formula(graph, [*up, *down, due])

    def late(self, node: int, strictly: bool) -> int:
        """A guard for a difference that becomes positive. One of the time alone that is zero at a
        time at which its comparison has not changed yet fires just after that time: a row there
        shows the values before.
        """
        if not (strictly and self.scope.only_time(node)):
            return node
        graph = self.graph
        size = graph.apply("add", graph.constant(1.0), graph.apply("abs", graph.time()))
        return self.scope.apply("sub", node, graph.apply("mul", graph.constant(AFTER), size))
