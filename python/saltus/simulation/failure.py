"""The error that a run raises when it ends badly."""

from __future__ import annotations

import contextlib
from typing import NoReturn

from saltus.errors import ModelError, SimulationError
from saltus.results import Results

__all__ = ["raise_for"]


def raise_for(results: Results, error: BaseException | None) -> NoReturn:
    """Raises `error`, or a `SimulationError` if there is none, with the results of the run."""
    if error is None:
        error = SimulationError(results.message, results._ended_at, results.block)
    with contextlib.suppress(AttributeError):  # a class with slots has no room for it
        error.results = results  # type: ignore[attr-defined]
    if hasattr(error, "add_note") and not isinstance(error, (SimulationError, ModelError)):
        error.add_note(f"in a run, at t = {results._ended_at} s; `.results` is what it did")
    if isinstance(error, KeyboardInterrupt) and not error.args:
        error.args = (f"{results.message}; its attribute results has what was computed",)
    try:
        raise error
    finally:
        del error  # otherwise the exception and this frame would refer to each other
