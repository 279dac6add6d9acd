"""A job: the settings that all runs of a sweep share. It can go to another process."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from saltus import _core
from saltus._engine import core_context, core_options, needs_interpreter
from saltus._quantities import Quantity
from saltus._signals import port_of, quantities_of
from saltus._status import WELL
from saltus.callbacks import Callbacks, called_callbacks, planned
from saltus.ensemble.columns import Columns, failed
from saltus.ensemble.runs import NoSystem, Outcome, Watch, each, said
from saltus.ensemble.table import Column, Table, entry
from saltus.errors import ModelError
from saltus.options import SimulatorOptions
from saltus.results import Results
from saltus.system import OutputPort, System

__all__ = ["Following", "Job"]

Values = Mapping[str, Column]


class Following(NamedTuple):
    """One system, whose values follow from others, such as the parameters of a scene file. It takes
    the place of the system in `sweep`.
    """

    system: System
    follow: Callable[[Values], Values]


@dataclass(frozen=True)
class Job:
    """One system, or a function that makes a system from some of the values."""

    system: System | Callable[..., System]
    context: _core.Context | None
    span: tuple[float, float]
    options: SimulatorOptions
    signals: Mapping[str, OutputPort | str]
    reduce: Callable[[Results], Any] | None
    follow: Callable[[Values], Values] | None = None
    """gives the values of a context that follow from those of the sweep; None: they are the same"""

    @property
    def is_factory(self) -> bool:
        return not isinstance(self.system, System)

    @property
    def needs_interpreter(self) -> bool:
        """Whether a run calls a Python function, so that threads would wait for each other."""
        if not isinstance(self.system, System):
            return True
        return needs_interpreter(self.system, self.options)

    def for_factory(self, names: list[str]) -> list[str]:
        """The varied names that are arguments of the factory."""
        if isinstance(self.system, System):
            return []
        try:
            parameters = inspect.signature(self.system).parameters.values()
        except (TypeError, ValueError):  # a compiled function has no signature
            return [name for name in names if name.isidentifier()]
        if any(p.kind is p.VAR_KEYWORD for p in parameters):
            return [name for name in names if name.isidentifier()]
        known = {p.name for p in parameters if p.kind in (p.POSITIONAL_OR_KEYWORD, p.KEYWORD_ONLY)}
        return [name for name in names if name in known]

    def ensemble(self, system: System, values: Values) -> _core.Ensemble:
        """The runs of one system with these values. ModelError if the values do not fit the
        system.
        """
        signals = {name: port_of(system, port) for name, port in self.signals.items()}
        options = core_options(replace(self.options, recorded_signals=signals), system)
        context = self.context or system.create_context(self.span[0])
        begin = core_context(context)

        def plan(callbacks: Callbacks | None) -> _core.Ensemble:
            when = self.options.machine_code
            return _core.Ensemble(system, begin, self.span, options, callbacks, when)

        traced = self.options.python == "traced"
        ensemble = planned(system, plan)[0] if traced else plan(called_callbacks(system))
        values = values if self.follow is None else self.follow(values)
        for name, column in values.items():
            ensemble.vary(name, _numbers(name, column))
        return ensemble

    def check(self, values: Values) -> None:
        """Raises ModelError for impossible names and values, before anything is run."""
        if isinstance(self.system, System):
            self.ensemble(self.system, values)
            return
        own = self.for_factory(list(values))
        self._require_arguments(own)
        if len(own) == len(values):
            return
        self._first(values, own)

    def _require_arguments(self, own: list[str]) -> None:
        """Raises ModelError if the factory needs an argument that the values do not have."""
        assert not isinstance(self.system, System)
        try:
            signature = inspect.signature(self.system)
        except (TypeError, ValueError):  # a compiled function has no signature
            return
        variadic = (inspect.Parameter.VAR_POSITIONAL, inspect.Parameter.VAR_KEYWORD)
        needed = [
            name
            for name, p in signature.parameters.items()
            if p.default is p.empty and p.kind not in variadic
        ]
        if missing := [name for name in needed if name not in own]:
            raise NoSystem(
                f"sweep: {_name(self.system)}{signature} needs {', '.join(map(repr, missing))}, "
                "which the values do not have; expected a system, or a function make(**values) "
                "that returns one. A derivative f(t, x, k) becomes a system as the ode of a "
                "LeafSystem, with k as a parameter of it or of make(k)"
            )

    def _make(self, row: Mapping[str, Any], own: list[str]) -> System:
        """The system of one row."""
        assert not isinstance(self.system, System)
        system = self.system(**{name: row[name] for name in own})
        if not isinstance(system, System):
            raise NoSystem(
                f"sweep: {_name(self.system)} returned {system!r}; expected a function that makes "
                "a system"
            )
        return system

    def _first(self, values: Values, own: list[str]) -> None:
        """Checks the names that are no arguments of the factory by the first system."""
        assert not isinstance(self.system, System)
        system = self._make({name: entry(values[name], 0) for name in own}, own)
        rest = {name: column[:1] for name, column in values.items() if name not in own}
        context = system.create_context()
        for name in rest:
            try:
                _core.find_entry(context, name)
            except ModelError:
                known = [*inspect.signature(self.system).parameters, *_core.entry_names(context)]
                raise ModelError(
                    f"sweep: unknown parameter or state '{name}'{_core.known_names(name, known)}"
                ) from None
        self.ensemble(system, rest)

    def run(self, values: Values, threads: int = 1, watch: Watch | None = None) -> Outcome:
        """The columns of the runs with these values, and the exception of a signal, or None."""
        if isinstance(self.system, System):
            return self._run(self.system, values, threads, watch)
        own = self.for_factory(list(values))
        return each(values, watch, lambda row: self._run_one(row, own))

    def fingerprint(self, table: Table) -> dict[str, str]:
        """A digest of each thing on which the results depend, by name."""
        from saltus.ensemble.fingerprint import fingerprint

        return fingerprint(self, table)

    def _run(self, system: System, values: Values, threads: int, watch: Watch | None) -> Outcome:
        ensemble = self.ensemble(system, values)
        reduced = _Reduced(self.reduce, quantities_of(system, self.signals))
        each = None if self.reduce is None else reduced
        columns, raised = ensemble.run(threads, list(self.options.save_at), watch, each)
        columns["reduced"] = reduced.values
        reduced.note(columns)
        columns["names"] = {"x": ensemble.state_names("x"), "z": ensemble.state_names("z")}
        if ensemble.has_modes:
            columns["names"]["mode"] = ensemble.state_names("mode")
        return columns, raised

    def _run_one(self, row: Mapping[str, Any], own: list[str]) -> Outcome:
        try:
            rest = {name: [value] for name, value in row.items() if name not in own}
            return self._run(self._make(row, own), rest, 1, None)
        except NoSystem:
            raise
        except Exception as error:  # the factory raised it, or the values do not fit its system
            return failed(1, said(error)), None
        except KeyboardInterrupt as error:
            return failed(1, "interrupted"), error


class _Reduced:
    """Calls `reduce` for each run that ended well, and notes the runs for which it raised."""

    def __init__(
        self,
        reduce: Callable[[Results], Any] | None,
        quantities: Callable[[], dict[str, Quantity]],
    ):
        self.reduce, self.quantities = reduce, quantities
        self.values: dict[int, Any] = {}
        self.errors: dict[int, str] = {}

    def __call__(self, run: int, core: _core.Results, raised: BaseException | None) -> None:
        if core.status not in WELL or self.reduce is None:
            return
        try:
            self.values[run] = self.reduce(Results(core, raised, None, self.quantities))
        except Exception as error:
            self.errors[run] = f"reduce: {said(error)}"

    def note(self, columns: Columns) -> None:
        failure = _core.status_names().index("failed")
        for run, error in self.errors.items():
            columns["status"][run] = failure
            columns["reasons"][run] = (error, "")


def _name(function: Any) -> str:
    return getattr(function, "__name__", type(function).__name__)


def _numbers(name: str, column: Column) -> np.ndarray:
    """Values of all runs; vectors, and matrices row by row, make a row for each run."""
    try:
        numbers = np.array(column, dtype=float)
    except (TypeError, ValueError):
        raise ModelError(f"sweep: '{name}': expected numbers, found {column[0]!r}, ...") from None
    if numbers.ndim > 3:
        raise ModelError(f"sweep: '{name}': expected a number, a vector or a matrix for each run")
    return numbers.reshape(len(numbers), -1) if numbers.ndim == 3 else numbers
