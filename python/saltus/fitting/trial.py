"""`Trial`: the runs of one experiment, and their residuals."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from saltus import _core
from saltus._status import WELL
from saltus.errors import Error, ModelError
from saltus.fitting.bound import Bound
from saltus.fitting.observed import (
    EventSeries,
    Series,
    event_series,
    refuse_unknown_sigma,
    series,
)
from saltus.fitting.step_bound import StepBound
from saltus.fitting.tables import sigma_of
from saltus.options import SimulatorOptions
from saltus.results import Results
from saltus.simulation import Simulator, simulate
from saltus.system import System

__all__ = ["Evaluation", "RunFailed", "Stopped", "Trial"]

Values = Mapping[str, float]


class RunFailed(Exception):
    """A run that gives no residuals; the fit goes on with a shorter step."""

    def __init__(self, message: str, results: Results | None = None):
        super().__init__(message)
        self.results = results


class Stopped(Exception):
    """The option `interrupt` has ended a run, and with it the fit."""


class Evaluation(NamedTuple):
    """The values of one run, in the order of the data, and what was missing."""

    model: np.ndarray
    derivatives: np.ndarray
    """(data, parameters); nan where the run has none"""
    reasons: tuple[str, ...]
    """why derivatives are missing"""


class Trial:
    """The runs of one experiment: a simulator that is used for all of them."""

    def __init__(
        self,
        system: System,
        bound: Bound,
        names: Sequence[str],
        sigma: object,
        options: SimulatorOptions,
    ):
        self.bound, self.system, self.names = bound, system, list(names)
        self.no_derivatives = ""
        self._times, rows = np.unique(bound.columns.time, return_inverse=True)
        self._options = replace(
            options,
            recorded_signals=bound.recorded,
            save_at=self._times.tolist(),
            save_steps=False,
            event_rows=not len(self._times),  # without times there are no rows to choose
            record_events=bool(bound.columns.events),
            sensitivity=self.names,
            dense_output=False,
            throw=True,
            progress=False,
            interrupt=(limit := StepBound(options.interrupt)),
        )
        self._limit, self._given = limit, options.interrupt
        self.without_sigma: list[str] = []
        self._plain: Simulator | None = None
        self._simulator = self._first_simulator()
        given = bound.experiment.sigma if bound.experiment.sigma is not None else sigma
        self.observed = self._observed(rows, given)
        self.data = np.concatenate([each.data for each in self.observed])
        self.sigma = np.concatenate([each.sigma for each in self.observed])
        self.missing = self._size() - len(self.data)

    def _first_simulator(self) -> Simulator:
        """A simulator with derivatives; without, if the system has none."""
        plain = self._without().initialize(self.bound.context)  # refuses what no run can do
        try:
            simulator = Simulator(self.system, self._options)
            return simulator.initialize(self.bound.context)
        except ModelError as error:
            self.no_derivatives = str(error)
            return plain

    def _without(self) -> Simulator:
        """The simulator of runs without derivatives, for differences."""
        if self._plain is None:
            self._plain = Simulator(self.system, replace(self._options, sensitivity=()))
        return self._plain

    def _observed(self, rows: np.ndarray, sigma: object) -> list[Series | EventSeries]:
        where, columns = self.bound.where, self.bound.columns
        refuse_unknown_sigma(where, sigma, [*columns.signals, *columns.events])
        empty = self._without().results  # has the shapes of the signals, and the names of events
        found: list[Series | EventSeries] = []
        for name, values in columns.signals.items():
            recorded, entry = self.bound.signals[name]
            shape = empty.outputs[recorded].shape[1:]
            self._note_sigma(name, sigma)
            deviations = sigma_of(where, sigma, name, values)
            parts = (columns.time, rows, values, deviations)
            found.append(series(where, name, recorded, entry, shape, *parts))
        for name, given in columns.events.items():
            try:
                empty.events.times(name, given.kind)
            except ModelError as error:
                raise ModelError(f"{where}: event times: {error}") from None
            if given.sigma is None:
                self._note_sigma(name, sigma if isinstance(sigma, Mapping) else None)
            found.append(event_series(where, name, given, sigma, self.bound.span[1]))
        return found

    def _note_sigma(self, name: str, sigma: object) -> None:
        if (sigma.get(name) if isinstance(sigma, Mapping) else sigma) is None:
            self.without_sigma.append(name)

    def _size(self) -> int:
        columns = self.bound.columns
        sizes = [column.size for column in columns.signals.values()]
        return sum(sizes) + sum(np.size(given.times) for given in columns.events.values())

    def start(self, values: Values) -> _core.Context:
        """The context at the begin of a run with these values."""
        context = self.bound.context
        for name, value in values.items():
            context = _core.with_entry(context, name, np.array([value]))
        return context

    def evaluate(self, values: Values) -> Evaluation:
        """The run with these values in place of the data. RunFailed if it gives none."""
        count = 0 if self.no_derivatives else len(self.names)
        results = self._run(self._simulator, values)
        model = self._model(results, count)
        if self.no_derivatives:
            nothing = np.full((len(model.model), len(self.names)), np.nan)
            return Evaluation(model.model, nothing, (self.no_derivatives,))
        gaps = results.sensitivity_gaps if np.isnan(model.derivatives).any() else ()
        reasons = [f"{g.event} at t = {g.time:.6g} s, by {g.parameter}: {g.reason}" for g in gaps]
        return Evaluation(model.model, model.derivatives, tuple(reasons))

    def predict(self, values: Values) -> np.ndarray:
        """The same without derivatives."""
        return self._model(self._run(self._without(), values), 0).model

    def _model(self, results: Results, count: int) -> Evaluation:
        parts = [each.model(results, count) for each in self.observed]
        model = np.concatenate([part.values for part in parts])
        if not np.isfinite(model).all():
            k = int(np.flatnonzero(~np.isfinite(model))[0])
            raise RunFailed(f"the value {k} of the run is not finite", results)
        return Evaluation(model, np.concatenate([part.derivatives for part in parts]), ())

    def _run(self, simulator: Simulator, values: Values) -> Results:
        self._limit.begin()
        try:
            simulator.initialize(self.start(values))
            status = simulator.advance_to(self.bound.span[1])
        except Exception as error:  # a callback may raise anything at a value that makes no sense
            if self._limit.reached:
                raise RunFailed(self._limit.message, getattr(error, "results", None)) from error
            raise _failure(error) from error
        results = simulator.results
        if status not in WELL or len(results.time) < len(self._times):
            raise RunFailed(
                f"the run ended at t = {results.context.time:g} s ({status}), before the last "
                f"time of the data, {self._times[-1]:g} s",
                results,
            )
        self._limit.well()
        return results

    def show(self, values: Values) -> Results:
        """A whole run with these values: every step and event, and dense output."""
        options = replace(
            self._options,
            sensitivity=(),
            save_steps=True,
            event_rows=True,
            record_events=True,
            dense_output=True,
            throw=False,
            interrupt=self._given,
        )
        return simulate(self.system, self.start(values), self.bound.span, options)


def _failure(error: Exception) -> Exception:
    """What an exception of a run means for the fit."""
    results = getattr(error, "results", None)
    if isinstance(results, Results) and results.status == "interrupted":
        return Stopped(str(error))
    said = str(error) if isinstance(error, Error) else f"{type(error).__name__}: {error}"
    return RunFailed(said, results)
