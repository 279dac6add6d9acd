"""`bound`: the data of one experiment with the signals, the span and the values of its run."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from saltus import _core
from saltus._engine import core_context
from saltus._signals import blocks_in, port_of
from saltus._span import span_of
from saltus.errors import ModelError
from saltus.fitting.experiment import Experiment
from saltus.fitting.tables import Columns, columns_of
from saltus.ports import OutputPort
from saltus.system import System

__all__ = ["Bound", "bound", "where_of"]


@dataclass(frozen=True)
class Bound:
    """An experiment whose names are those of a system."""

    where: str
    """the begin of a message about it"""
    experiment: Experiment
    columns: Columns
    context: _core.Context
    span: tuple[float, float]
    signals: dict[str, tuple[str, tuple[int, ...] | None]]
    """name in the data -> name under which the run records it, entry"""
    recorded: dict[str, OutputPort]


def where_of(experiment: Experiment) -> str:
    return f"fit: {experiment.name}"


def bound(
    system: System,
    experiment: Experiment,
    context: _core.Context | None,
    t_span: object,
    signals: Mapping[str, OutputPort | str],
) -> Bound:
    """Finds everything that an experiment names. ModelError for what there is not."""
    where = where_of(experiment)
    columns = columns_of(where, experiment.data)
    start = experiment.context or context
    start = core_context(system.create_context() if start is None else start)
    span = _span(where, columns, experiment.t_span or t_span, start.time)
    for name, value in experiment.values.items():
        try:
            start = _core.with_entry(start, name, np.atleast_1d(np.asarray(value, dtype=float)))
        except (ModelError, TypeError, ValueError) as error:
            raise ModelError(f"{where}: values: {error}") from None
    start = start if start.time == span[0] else start.with_time(span[0])
    found = {name: _signal(where, system, name, signals) for name in columns.signals}
    return Bound(
        where,
        experiment,
        columns,
        start,
        span,
        {name: (recorded, entry) for name, (recorded, entry, _) in found.items()},
        {recorded: port for recorded, _, port in found.values()},
    )


def _span(where: str, columns: Columns, t_span: object, begin: float) -> tuple[float, float]:
    """The span of the run: as it is given, or as long as the data need it."""
    times = [columns.time, *(np.asarray(e.times) for e in columns.events.values())]
    all_times = np.concatenate(times)
    all_times = all_times[np.isfinite(all_times)]
    if t_span is not None:
        begin, end = span_of(where, t_span)
    else:
        seen = [np.asarray(e.times) for e in columns.events.values()]
        last = np.nanmax(np.concatenate(seen), initial=begin) if seen else begin
        # An event of the run may be later than the measured one: the span is twice as long.
        end = float(max(begin, np.max(columns.time, initial=begin), 2.0 * last - begin))
    outside = all_times[(all_times < begin) | (all_times > end)]
    if len(outside):
        raise ModelError(
            f"{where}: a value at t = {outside[0]:g} s is outside of the run, which goes from "
            f"{begin:g} s to {end:g} s; change the data, t_span or the time of the context"
        )
    return begin, end


def _signal(
    where: str, system: System, name: str, signals: Mapping[str, OutputPort | str]
) -> tuple[str, tuple[int, ...] | None, OutputPort]:
    """The recorded name of a signal in the data, its entry and its port."""
    base, entry = name, None
    if name not in signals and (match := re.fullmatch(r"(.+)\[(\d+(?:,\d+)?)\]", name)):
        base, entry = match[1], tuple(map(int, match[2].split(",")))
    if base in signals:
        return base, entry, port_of(system, signals[base], f"{where}: signal '{base}'")
    try:
        return base, entry, port_of(system, base)
    except ModelError:
        hint = _core.known_names(base, list(dict.fromkeys([*signals, *_known(system)])))
        raise ModelError(f"{where}: the data name an unknown signal '{name}'{hint}") from None


def _known(system: System) -> list[str]:
    """The paths of the outputs of a system and of its blocks."""
    inside = [f"{block.name}.{port}" for block in blocks_in(system) for port in block.output_names]
    return [*system.output_names, *inside]
