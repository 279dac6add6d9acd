"""The executors of a sweep: threads, processes, one run after another, or a pool of yours."""

from __future__ import annotations

import os
from typing import Any

from saltus import _core
from saltus.ensemble.columns import Columns
from saltus.ensemble.job import Job, Watch
from saltus.ensemble.table import Table
from saltus.errors import ModelError

__all__ = ["Outcome", "chosen", "run"]

KINDS = ("threads", "processes", "serial")
Outcome = tuple[Columns, "BaseException | None", str, int]


def _workers(workers: int | None, runs: int) -> int:
    if workers is not None and (not isinstance(workers, int) or workers < 1):
        raise ModelError(f"sweep: workers: expected 1 or more, found {workers!r}")
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    return min(workers or cores or 1, runs)


def run(job: Job, table: Table, executor: Any, workers: int | None, watch: Watch) -> Outcome:
    """Runs the job by the given executor, or by a suitable one. Returns the outcome, the executor's
    name and the number of workers.
    """
    kind, count = chosen(job, table, executor, workers)
    if kind == "processes":
        return *_in_processes(job, table, count, watch), kind, count
    if kind in KINDS:
        return *job.run(table.columns, count, watch), kind, count
    from saltus.ensemble import pools  # loaded only when processes are needed

    return *pools.run_pooled(executor, job, table, count, watch), kind, count


def chosen(job: Job, table: Table, executor: Any, workers: int | None) -> tuple[str, int]:
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
    job: Job, table: Table, count: int, watch: Watch
) -> tuple[Columns, BaseException | None]:
    from saltus.ensemble import pools

    sent = pools.pickled(job)
    with pools.process_pool(count) as pool:
        columns, raised = pools.run_pooled(pool, sent, table, count, watch)
    lost = [r for r, _ in columns["reasons"].values() if "process that made this run ended" in r]
    if len(lost) == table.runs:
        raise ModelError(pools.NO_MAIN)
    return columns, raised
