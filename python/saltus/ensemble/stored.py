"""A sweep with a store: only the missing chunks are run, and each is kept when it is finished.

A fingerprint cannot see all on which results depend, for example a file that a function reads. So
one finished row is run again before the others, and its results have to be those in the store.
"""

from __future__ import annotations

import concurrent.futures
import pickle
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from saltus.ensemble import executors, pools
from saltus.ensemble.columns import PLAIN, WIDE, Columns, empty, failed, join
from saltus.ensemble.runs import NoSystem, Runs, Watch
from saltus.ensemble.store import Store
from saltus.ensemble.table import Table
from saltus.errors import ModelError

__all__ = ["run_stored"]

SAME = [name for name in (*PLAIN, *WIDE) if name != "wall_time"]
"""columns that are equal in each run of a row"""


class _Stored:
    """The chunks of one call: those that are finished, and why others are lost."""

    def __init__(self, job: Runs, table: Table, store: Store, watch: Watch):
        self.job, self.table, self.store, self.watch = job, table, store, watch
        self.cuts = store.cuts(table.runs)
        loaded = ((i, store.load(i, b - a)) for i, (a, b) in enumerate(self.cuts))
        self.done: dict[int, Columns] = {i: c for i, c in loaded if c is not None}
        self.lost: dict[int, str] = {}
        self.raised: BaseException | None = None

    def missing(self) -> list[int]:
        return [i for i in range(len(self.cuts)) if i not in self.done]

    def keep(self, number: int, columns: Columns) -> None:
        self.store.save(number, columns)
        self.done[number] = columns
        self.lost.pop(number, None)
        self.watch(sum(len(c["status"]) for c in self.done.values()))

    def known_row(self) -> dict[str, Any]:
        """The values of the first finished row."""
        first = self.cuts[min(self.done)][0]
        return self.table.part(first, first + 1)

    def require_same(self, again: Columns) -> None:
        """ModelError if a finished row that was run again has other results than in the store."""
        kept = self.done[min(self.done)]
        for name in SAME:
            now, then = np.asarray(again[name][0]), np.asarray(kept[name][0])
            then = then[: len(now)] if now.ndim else then  # a chunk has the width of its widest row
            if not np.array_equal(now, then, equal_nan=True):
                raise ModelError(
                    f"sweep: store '{self.store.path}': run {self.cuts[min(self.done)][0]} has "
                    f"{name} = {now} now, and {then} in the store, so the system has changed "
                    "since; take another directory, or remove this one"
                )

    def columns(self) -> Columns:
        return join([self._chunk(i, b - a) for i, (a, b) in enumerate(self.cuts)])

    def _chunk(self, number: int, runs: int) -> Columns:
        if number in self.done:
            return self.done[number]
        return failed(runs, self.lost[number]) if number in self.lost else empty(runs)


def run_stored(
    job: Runs, table: Table, executor: Any, workers: int | None, watch: Watch, store: Store,
    retries: int,
) -> executors.Outcome:  # fmt: skip
    """As `executors.run`. A chunk that was lost is submitted again up to `retries` times."""
    kind, count = executors.chosen(job, table, executor, workers)
    state = _Stored(job, table, store, watch)
    if kind in ("threads", "serial"):
        _run_here(state, count)
        return state.columns(), state.raised, kind, count
    sent = pools.pickled(job) if kind == "processes" else job
    if state.done:
        with _pool(executor, kind, 1) as pool:
            state.require_same(pools.submitted(pool, sent, state.known_row(), -1).result())
    for attempt in range(retries + 1):
        if state.raised is None and state.missing():
            with _pool(executor, kind, count) as pool:
                _run_round(state, pool, sent, attempt)
    return state.columns(), state.raised, kind, count


def _run_here(state: _Stored, threads: int) -> None:
    try:
        if state.done:
            again, state.raised = state.job.run(state.known_row(), 1, None)
            if state.raised is None:
                state.require_same(again)
        for number in state.missing() if state.raised is None else []:
            part = state.table.part(*state.cuts[number])
            columns, state.raised = state.job.run(part, threads, None)
            if state.raised is not None:
                return
            state.keep(number, columns)
    except KeyboardInterrupt as error:  # while a chunk was written
        state.raised = error


@contextmanager
def _pool(executor: Any, kind: str, count: int) -> Iterator[Any]:
    if kind != "processes":
        yield executor
        return
    with pools.process_pool(count) as pool:  # a new one each time: a broken pool takes nothing
        yield pool


def _run_round(state: _Stored, pool: Any, job: Runs | bytes, attempt: int) -> None:
    """Submits all missing chunks. Their results are kept in the order of the rows."""
    missing = state.missing()
    parts = [state.table.part(*state.cuts[number]) for number in missing]
    futures: list[Any] = []
    try:
        for part in parts:
            futures.append(pools.submitted(pool, job, part, attempt))
    except concurrent.futures.BrokenExecutor as error:
        state.lost |= dict.fromkeys(missing[len(futures) :], _lost(error))
    try:
        for number, future in zip(missing, futures, strict=False):
            _take(state, number, future)
    except KeyboardInterrupt as error:
        state.raised = error
        pools.interrupted(pool)
    finally:
        for future in futures:
            future.cancel()


def _take(state: _Stored, number: int, future: Any) -> None:
    try:
        columns = future.result()
    except (pickle.PicklingError, AttributeError, TypeError) as error:
        raise ModelError(
            f"sweep: cannot be run in another process ({error}); {pools.REMEDY}"
        ) from None
    except NoSystem:
        raise
    except (Exception, concurrent.futures.CancelledError) as error:
        state.lost[number] = _lost(error)
    else:
        state.keep(number, columns)


def _lost(error: BaseException) -> str:
    return f"the chunk of this run was lost: {type(error).__name__}: {error}"
