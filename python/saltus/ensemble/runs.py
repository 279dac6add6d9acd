"""What a sweep asks of the runs that it makes, and how runs follow one another."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Protocol

from saltus.ensemble.columns import Columns, empty, join
from saltus.ensemble.table import Column, Table, entry
from saltus.errors import ModelError

__all__ = ["NoSystem", "Outcome", "Runs", "Watch", "each", "said"]

Watch = Callable[[int], bool]
"""is called with the number of finished runs; True ends the sweep"""
Outcome = tuple[Columns, "BaseException | None"]
"""the columns of all runs, and the exception of a signal, or None"""


class NoSystem(ModelError):
    """The function that was given to a sweep makes no system, so no row can run."""


class Runs(Protocol):
    """Runs by rows of values. Pickle takes them to another process."""

    @property
    def is_factory(self) -> bool:
        """Whether each row makes a system of its own, so that threads share no plan."""

    @property
    def needs_interpreter(self) -> bool:
        """Whether a run calls a Python function, so that threads would wait for each other."""

    def run(
        self, values: Mapping[str, Column], threads: int = 1, watch: Watch | None = None
    ) -> Outcome:
        """The outcome of the runs with these values."""

    def fingerprint(self, table: Table) -> dict[str, str]:
        """A digest of each thing on which the results depend, by name."""


def each(
    values: Mapping[str, Column], watch: Watch | None, one: Callable[[dict[str, Any]], Outcome]
) -> Outcome:
    """The rows one after another, until a signal or `watch` ends them."""
    runs = len(next(iter(values.values())))
    parts: list[Columns] = []
    raised: BaseException | None = None
    try:
        while raised is None and len(parts) < runs and not (watch and watch(len(parts))):
            part, raised = one({name: entry(column, len(parts)) for name, column in values.items()})
            parts.append(part)
    except KeyboardInterrupt as error:  # between two rows
        raised = error
    if len(parts) < runs:
        parts.append(empty(runs - len(parts)))
    return join(parts), raised


def said(error: BaseException) -> str:
    """An exception in one line: a ModelError says all itself."""
    return str(error) if isinstance(error, ModelError) else f"{type(error).__name__}: {error}"
