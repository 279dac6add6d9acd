"""The arguments that `jax_function` and `torch_function` share, checked."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import fields, replace
from typing import Any

import numpy as np

from saltus._core import known_names
from saltus._porting import OPTIONS, refuse
from saltus._whole import is_whole
from saltus.errors import ModelError
from saltus.options import SimulatorOptions

__all__ = ["checked_gaps", "counts_of", "names_of", "options_of"]

GAPS = ("error", "nan")
FIXED: dict[str, tuple[Any, str]] = {
    "sensitivity": ((), "the names are those of wrt"),
    "dense_output": (False, "say save_at=[...] for values at chosen times"),
    "save_steps": (None, "steps differ from run to run; say save_at=[...]"),
    "record_events": (True, "say with events={...} which event times to return"),
    "throw": (True, "a run that fails has no values, so it raises an exception"),
}
"""option -> its one possible value, and what to do in place of another"""


def names_of(where: str, wrt: Any) -> list[str]:
    """The names to differentiate by. ModelError unless they are a list of at least one text."""
    names = list(wrt) if isinstance(wrt, (list, tuple)) else []
    if not names or not all(isinstance(name, str) for name in names):
        raise ModelError(
            f"{where}: wrt: expected a list of parameters and start values, such as "
            f"['g', 'x[0]'], found {wrt!r}"
        )
    return names


def counts_of(where: str, events: Any) -> dict[str, int]:
    """How many times of each event are returned: of a list of names the first time of each."""
    if isinstance(events, (list, tuple)):
        events = dict.fromkeys(events, 1)
    if not isinstance(events, Mapping):
        raise ModelError(
            f"{where}: events: expected names and counts, such as {{'bounce': 2}}, or a list of "
            f"names, found {events!r}"
        )
    for name, count in events.items():
        if not isinstance(name, str) or not is_whole(count) or count < 1:
            raise ModelError(
                f"{where}: events: expected a name and a count of 1 or more, found {name!r}: "
                f"{count!r}"
            )
    return {name: int(count) for name, count in events.items()}


def options_of(
    where: str,
    options: SimulatorOptions | None,
    save_at: Sequence[float] | None,
    span: tuple[float, float],
    overrides: Mapping[str, Any],
) -> SimulatorOptions:
    """The options of the runs, with rows at `save_at` only, by default at the end."""
    options = options or SimulatorOptions()
    if not isinstance(options, SimulatorOptions):
        raise ModelError(f"{where}: expected SimulatorOptions, found {options!r}")
    refuse(where, overrides, (field.name for field in fields(options)), OPTIONS)
    options = replace(options, **overrides)
    if overrides.get("event_rows"):
        raise ModelError(f"{where}: no option 'event_rows' here: rows at events differ by run")
    for name, (value, advice) in FIXED.items():
        given = getattr(options, name)
        if given != value and not (name == "sensitivity" and len(given) == 0):
            raise ModelError(f"{where}: no option '{name}' here: {advice}")
    times = _times(where, options.save_at if save_at is None else save_at, span)
    return replace(options, save_at=times, save_steps=False, event_rows=False)


def _times(where: str, save_at: Any, span: tuple[float, float]) -> tuple[float, ...]:
    """The times of the rows, which must lie in the span: a run has no row elsewhere."""
    try:
        times = tuple(float(time) for time in save_at) or (span[1],)
    except (TypeError, ValueError):
        raise ModelError(f"{where}: save_at: expected times [s], found {save_at!r}") from None
    for time, before in zip(times, (-np.inf, *times), strict=False):
        if not (span[0] <= time <= span[1] and before < time):
            raise ModelError(
                f"{where}: save_at: expected increasing times from {span[0]} s to {span[1]} s, "
                f"found {time} s"
            )
    return times


def checked_gaps(where: str, gaps: Any) -> str:
    """ModelError for an unknown answer to the question what a missing derivative becomes."""
    if gaps not in GAPS:
        hint = known_names(str(gaps), list(GAPS))
        raise ModelError(f"{where}: gaps: expected 'error' or 'nan', found {gaps!r}{hint}")
    return str(gaps)
