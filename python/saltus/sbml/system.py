"""`Model`: a model in SBML as a block."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from saltus.errors import ModelError
from saltus.leaf_system import LeafSystem
from saltus.sbml.algebraic import unknowns
from saltus.sbml.events import Program
from saltus.sbml.formula import Called, Formula, evaluated
from saltus.sbml.instant import Instant
from saltus.sbml.kinds import kinds_of
from saltus.sbml.model_formulas import ModelFormulas, Shown, initial_values
from saltus.sbml.quantities import declared
from saltus.sbml.reading import model_of

__all__ = ["Model", "load", "model_block"]

RESERVED = {"x", "z", "mode"}
"""ids that no state may have for a name in a context; they are outputs all the same"""


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
        numbers = initial_values(says, unknown)
        kinds = kinds_of(says, unknown, {n for n, v in numbers.items() if v == 0.0})
        made = ModelFormulas(kinds, numbers, seed)
        self._declare(made, shown)

    def _declare(self, made: ModelFormulas, shown: Iterable[Shown] | None) -> None:
        kinds, named = made.kinds, None if shown is None else list(shown)
        for name, value in zip(kinds.parameters, made.p, strict=True):
            self.declare_dynamic_parameter(name, value if math.isfinite(value) else 0.0)
        self.constants = made.p
        """the parameters at the start, in their order"""
        derivatives = made.derivatives()
        outputs = made.outputs(named)
        program = made.program(derivatives.tape)
        if kinds.states:
            taken = kinds.amounts | RESERVED
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

    def _declare_events(self, made: ModelFormulas, program: Program) -> None:
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


def _require_finite_start(made: ModelFormulas, program: Program, derivatives: Formula) -> None:
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
