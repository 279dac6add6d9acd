"""`Model`: a model in SBML as a block."""

from __future__ import annotations

import functools
import math
import os
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from saltus.errors import ModelError
from saltus.leaf_system import LeafSystem
from saltus.sbml.algebraic import unknowns
from saltus.sbml.events import ASSIGNED, CROSSED, END, HIGHEST, START
from saltus.sbml.formula import Formula, evaluated
from saltus.sbml.instant import Instant
from saltus.sbml.kinds import LATER, RUNNING, kinds_of
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
    return model_block(model, values=values)


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
        values: Mapping[str, float] | None = None,
    ):
        super().__init__(name=model.getId() or "model")
        says = declared(model)
        for name, value in _numbers_by_id(values).items():
            says.begin(name, value)
        unknown = says.unknown = unknowns(says) if says.algebraic else []
        numbers = initial_values(says, unknown)
        kinds = kinds_of(says, unknown, {n for n, v in numbers.items() if v == 0.0})
        made = ModelFormulas(kinds, numbers)
        self._declare(made, shown)

    def _declare(self, made: ModelFormulas, shown: Iterable[Shown] | None) -> None:
        kinds, named = made.kinds, None if shown is None else list(shown)
        for name, value in zip(kinds.parameters, made.p, strict=True):
            self.declare_dynamic_parameter(name, value if math.isfinite(value) else 0.0)
        self.constants = made.p
        """the parameters at the start, in their order"""
        derivatives = made.derivatives()
        outputs = made.outputs(named)
        instant = made.instant()
        if kinds.states:
            taken = kinds.amounts | RESERVED
            free = named is None and taken.isdisjoint(kinds.states)
            self.declare_continuous_state(
                default_value=made.x, ode=derivatives, names=kinds.states if free else ()
            )
        self.curved = any(map(made.scope.curved, made.scope.differences))
        """whether a comparison is no straight line in time and states: the solver looks at the
        errors of states alone, and a step may pass its turns
        """
        z = made.z
        if instant is not None:
            z = instant.beginning(made.z)
            self.declare_discrete_state(z)
            self._declare_sides(instant)
            self._declare_events(instant)
        _require_finite_start(made, instant, derivatives, z)
        if named is None:
            known = set(self.output_names)
            for name, formula in outputs.items():
                if name not in known:
                    self.declare_output_port(formula, name=name, shape=(), boolean=False)
        else:
            self.shown = outputs["shown"]
            if kinds.states:
                self.declare_continuous_state_output("x")
            if instant is not None:
                self.declare_discrete_state_output("z")

    def _declare_sides(self, instant: Instant) -> None:
        """What is known of the comparisons, and of the triggers that read them."""
        declare = functools.partial(
            self.declare_zero_crossing, direction="rising", zeno_tolerance=0.0
        )
        declare(instant.before(), instant.start(), START, at_start="fire")
        if instant.differences:
            declare(
                instant.guards(),
                instant.compare(),
                CROSSED,
                size=2 * len(instant.differences) + 1,
                at_start="ignore",  # `later` looks at a difference that begins at zero
            )
            self.declare_zero_crossing(
                instant.positive(LATER),
                instant.later(),
                END,
                "rising",
                persistent=True,
                delay=instant.just_after(),
            )
        if instant.events:
            declare(instant.positive(RUNNING), instant.assign(), ASSIGNED)

    def _declare_events(self, instant: Instant) -> None:
        for i, event in enumerate(instant.events):
            declare = functools.partial(
                self.declare_zero_crossing,
                instant.positive(instant.truths[i]),
                direction="rising",
                delay=None if event.delay is None else instant.number(event.delay),
            )
            declare(
                reset_map=instant.execute(i),
                name=event.name,
                priority=instant.number(event.priority),
                persistent=event.persistent,
                use_values_from_trigger_time=event.early,
            )
            if event.delay is not None and instant.differences:
                declare(reset_map=instant.look(), name=f"{event.name} is due", priority=HIGHEST)


def _numbers_by_id(values: Mapping[str, float] | None) -> Mapping[str, float]:
    if values is not None and not isinstance(values, Mapping):
        raise ModelError(f"values: expected a dict of numbers by id, found {values!r}")
    return values or {}


def _require_finite_start(
    made: ModelFormulas, instant: Instant | None, derivatives: Formula, z: np.ndarray
) -> None:
    """ModelError, which names the id, for a rate that is not finite at the start. Where an event
    triggers there, the run looks at the rates after it.
    """
    if instant is not None:
        begun = evaluated(instant.start().tape, 0.0, made.x, z, made.p)
        if any(begun[k] > z[k] for k in instant.truths):
            return
        z = begun
    rates = evaluated(derivatives.tape, 0.0, made.x, z, made.p)
    for name, rate in zip(made.kinds.states, rates, strict=True):
        if not math.isfinite(rate):
            raise ModelError(
                f"the rate of '{name}' is {rate:g} at the start; expected a finite number: look at "
                "divisions by zero in its rule and in the reactions that change it"
            )
