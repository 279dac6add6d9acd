"""The executors of a sweep: threads, processes, one run after another, or a pool of yours."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from saltus import _core
from saltus.ensemble.columns import Columns
from saltus.ensemble.runs import Runs, Watch
from saltus.ensemble.table import Table
from saltus.errors import ModelError

if TYPE_CHECKING:
    from saltus.ensemble.store import Store

__all__ = ["Outcome", "chosen", "run", "store_of"]

KINDS = ("threads", "processes", "serial")
Outcome = tuple[Columns, "BaseException | None", str, int]


def _workers(workers: int | None, runs: int) -> int:
    if workers is not None and (not isinstance(workers, int) or workers < 1):
        raise ModelError(f"sweep: workers: expected 1 or more, found {workers!r}")
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    return min(workers or cores or 1, runs)


def run(
    job: Runs, table: Table, executor: Any, workers: int | None, watch: Watch,
    store: Store | None = None, retries: int = 0,
) -> Outcome:  # fmt: skip
    """Runs the job by the given executor, or by a suitable one; with a store, what is not in it.
    Returns the outcome, the executor's name and the number of workers.
    """
    if store is not None:
        from saltus.ensemble.stored import run_stored

        return run_stored(job, table, executor, workers, watch, store, retries)
    kind, count = chosen(job, table, executor, workers)
    if kind == "processes":
        return *_in_processes(job, table, count, watch), kind, count
    if kind in KINDS:
        return *job.run(table.columns, count, watch), kind, count
    from saltus.ensemble import pools  # loaded only when processes are needed

    return *pools.run_pooled(executor, job, table, count, watch), kind, count


def chosen(job: Runs, table: Table, executor: Any, workers: int | None) -> tuple[str, int]:
    """The name of the executor, and the number of workers.

    Without an executor the system and `workers` decide, never the clock: the same call runs the
    same way.
    """
    count = _workers(workers, table.runs)
    if executor is None:
        if not job.needs_interpreter:
            return "threads", count
        return ("serial", 1) if workers is None or count == 1 else ("processes", count)
    if not isinstance(executor, str):
        return type(executor).__name__, count
    if executor not in KINDS:
        hint = _core.known_names(executor, list(KINDS))
        raise ModelError(f"sweep: unknown executor '{executor}'{hint}")
    if executor == "threads" and job.is_factory:
        raise ModelError("sweep: a function makes systems one by one: no threads share a plan")
    return executor, 1 if executor == "serial" else count


def _in_processes(
    job: Runs, table: Table, count: int, watch: Watch
) -> tuple[Columns, BaseException | None]:
    from saltus.ensemble import pools

    sent = pools.pickled(job)
    with pools.process_pool(count) as pool:
        columns, raised = pools.run_pooled(pool, sent, table, count, watch)
    lost = [r for r, _ in columns["reasons"].values() if "process that made this run ended" in r]
    if len(lost) == table.runs:
        raise ModelError(pools.NO_MAIN)
    return columns, raised


def store_of(
    path: str | os.PathLike[str] | None, chunk: object, retries: object, job: Runs, table: Table
) -> Store | None:
    """The store in this directory, or None without a path. ModelError for impossible arguments."""
    for name, value, least in (("chunk", chunk, 1), ("retries", retries, 0)):
        if value is None and name == "chunk":
            continue
        if not isinstance(value, int) or isinstance(value, bool) or value < least:
            raise ModelError(f"sweep: {name}: expected {least} or more, found {value!r}")
        if path is None and value != 0:
            raise ModelError(f"sweep: {name}={value} needs a store: say store='a directory'")
    if path is None:
        return None
    from saltus.ensemble.store import Store

    return Store(path, job, table, chunk)  # type: ignore[arg-type]
