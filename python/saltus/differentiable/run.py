"""`Run`: a run as a function from an array of parameters to arrays of fixed shapes."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, NoReturn

import numpy as np

from saltus import _core
from saltus._engine import core_context
from saltus._quantities import named_states
from saltus._signals import is_diagram, signals_of
from saltus._span import span_of
from saltus.differentiable.derivatives import derivatives_of, raise_for_gap
from saltus.differentiable.settings import checked_gaps, counts_of, names_of, options_of
from saltus.differentiable.values import RunValues
from saltus.errors import ModelError, SimulationError
from saltus.options import SimulatorOptions
from saltus.results import Results
from saltus.simulation import simulate
from saltus.system import OutputPort, System

__all__ = ["Run"]


class Run:
    """What `jax_function` and `torch_function` make of their arguments, without either package."""

    def __init__(
        self,
        where: str,
        system: System,
        wrt: Sequence[str],
        time_span: tuple[float, float],
        context: _core.Context | None,
        options: SimulatorOptions | None,
        recorded_signals: Mapping[str, OutputPort | str] | Sequence[str] | None,
        save_at: Sequence[float] | None,
        events: Mapping[str, int] | Sequence[str],
        gaps: str,
        overrides: Mapping[str, Any],
    ):
        if not isinstance(system, System):
            raise ModelError(f"{where}: expected a system, found {system!r}")
        self.where, self.system = where, system
        self.span = span_of(where, time_span)
        self.gaps = checked_gaps(where, gaps)
        self.counts = counts_of(where, events)
        names = names_of(where, wrt)
        options = options_of(where, options, save_at, self.span, overrides)
        given = options.recorded_signals if recorded_signals is None else recorded_signals
        if given is None and not is_diagram(system):  # a run that ends early has no row at its end
            given = [system.output_names[i] for i in named_states(system)]
        self.options = replace(options, recorded_signals=signals_of(system, given))
        self.context = core_context(
            system.create_context(self.span[0]) if context is None else context
        )
        self.context = self.context.with_time(self.span[0])
        self._look(names)

    def _look(self, names: list[str]) -> None:
        """Learns the shapes from a run that ends where it begins. It refuses what no run can do."""
        begin = self.span[0]
        options = replace(self.options, sensitivity=names, save_at=(begin,))
        look = simulate(self.system, self.context, (begin, begin), options)
        self.parameters = look.sensitivities.parameters
        """the names of the entries of p; a vector has a name for each entry"""
        self.groups = {name: self._entries(name) for name in names}
        """name of wrt -> its places in p"""
        for event in self.counts:
            look.events.times(event)  # refuses an unknown name
        rows = len(self.options.save_at)
        self.shapes = RunValues(
            {name: (rows, *array.shape[1:]) for name, array in look.outputs.items()},
            look.context.continuous_state.shape,
            look.context.discrete_state.shape,
            (),
            {name: (count,) for name, count in self.counts.items()},
        )
        """the shape of each value"""

    def _entries(self, name: str) -> list[int]:
        entry = re.compile(re.escape(name) + r"(\[\d+\])?")
        return [i for i, known in enumerate(self.parameters) if entry.fullmatch(known)]

    def values(self, p: np.ndarray) -> RunValues:
        """The values of the run with the parameters p."""
        return self._values(p, self._run(p, self.options))

    def with_columns(self, p: np.ndarray) -> tuple[RunValues, RunValues]:
        """The values, and their derivatives with the parameters along the last axis."""
        results = self._run(p, replace(self.options, sensitivity=self.parameters))
        values = self._values(p, results)
        found = derivatives_of(self.system, results, self.counts)
        if self.gaps == "error":
            raise_for_gap(self.where, found, self.parameters)
        return values, found.columns

    def _run(self, p: np.ndarray, options: SimulatorOptions) -> Results:
        context = self.context
        for name, value in zip(self.parameters, p, strict=True):
            context = _core.with_entry(context, name, float(value))
        return simulate(self.system, context, self.span, options)

    def _values(self, p: np.ndarray, results: Results) -> RunValues:
        rows, wanted = len(results.time), len(self.options.save_at)
        if self.shapes.outputs and rows != wanted:
            self._refuse(p, results, f"expected a row at each of {wanted} times, found {rows}")
        context = results.context
        return RunValues(
            {name: np.array(results[name]) for name in self.shapes.outputs},
            np.array(context.continuous_state),
            np.array(context.discrete_state),
            np.array(context.time),
            {name: self._times(p, results, name) for name in self.counts},
        )

    def _times(self, p: np.ndarray, results: Results, name: str) -> np.ndarray:
        times, count = results.events.times(name), self.counts[name]
        if len(times) < count:
            self._refuse(p, results, f"expected {count} events '{name}', found {len(times)}")
        return np.array(times[:count])

    def _refuse(self, p: np.ndarray, results: Results, what: str) -> NoReturn:
        """The shapes are fixed before the run, so a run with fewer values is an error."""
        end = results.context.time
        given = ", ".join(f"{n} = {v:.6g}" for n, v in zip(self.parameters, p, strict=True))
        raise SimulationError(
            f"{self.where}: {what}, with {given}; the run ended at t = {end} s with the status "
            f"'{results.status}'; ask for fewer, for earlier times, or for a later end",
            end,
            results=results,
        )
