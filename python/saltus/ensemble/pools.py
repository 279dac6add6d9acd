"""Runs in other processes: a pool of our own, or any executor with `submit` or `map`."""

from __future__ import annotations

import functools
import math
import multiprocessing
import pickle
import threading
from collections.abc import Iterator
from concurrent.futures import CancelledError, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from typing import Any

from saltus.ensemble.columns import Columns, empty, failed, join
from saltus.ensemble.runs import NoSystem, Runs, Watch
from saltus.ensemble.table import Column, Table
from saltus.errors import ModelError

__all__ = ["REMEDY", "Workers", "interrupted", "pickled", "process_pool", "run_pooled", "submitted"]

REMEDY = (
    "give a function that makes the system instead, at the top level of a module that the other "
    "process can import: sweep(make_ball, ...) with `def make_ball(e): return Ball(e)`"
)
NO_MAIN = (
    "sweep: a process of the pool ended before it could run anything. A script that starts "
    "processes needs `if __name__ == '__main__':` around what it does; or take executor='serial'"
)


def pickled(job: Runs) -> bytes:
    """The job for another process; a ModelError with advice if it cannot go there."""
    try:
        return pickle.dumps(job)
    except Exception as error:  # pickle raises many kinds
        what = "function" if job.is_factory else "system"
        raise ModelError(
            f"sweep: this {what}, its signals or its options cannot go to another process "
            f"({error}); {REMEDY}"
        ) from None


@functools.lru_cache(maxsize=4)
def _unpickled(job: bytes) -> Runs:
    loaded: Runs = pickle.loads(job)
    return loaded


def _run_part(job: Runs | bytes, values: dict[str, Column]) -> Columns:
    """In the other process."""
    columns: Columns = (_unpickled(job) if isinstance(job, bytes) else job).run(values)[0]
    return columns


def _run_again(job: Runs | bytes, values: dict[str, Column], attempt: int) -> Columns:
    """A part in its attempt of this number, by which Dask takes it for another task."""
    del attempt
    return _run_part(job, values)


def submitted(executor: Any, job: Runs | bytes, values: dict[str, Column], attempt: int) -> Any:
    """The future of one part. ModelError for an executor without `submit`."""
    if hasattr(executor, "submit"):
        return executor.submit(_run_again, job, values, attempt)
    raise ModelError(
        "sweep: a store needs 'threads', 'processes', 'serial' or an executor with submit(), "
        f"found {executor!r}"
    )


@contextmanager
def undisturbed() -> Iterator[None]:
    """Ctrl-C within the block comes after it."""
    import signal

    if threading.current_thread() is not threading.main_thread():
        yield
        return
    came: list[int] = []
    usual = signal.signal(signal.SIGINT, lambda number, _: came.append(number))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, usual)
        if came:
            signal.raise_signal(signal.SIGINT)


class Workers(ProcessPoolExecutor):
    """New processes. Nothing of this process is copied into them, so locks of its threads cannot
    stop them.
    """

    def __init__(self, count: int):
        super().__init__(count, multiprocessing.get_context("spawn"), _deaf)

    def submit(self, *arguments: Any, **named: Any) -> Any:
        """As that of the base, which starts a process and then notes it: Ctrl-C between the two
        would leave one of which nobody knows.
        """
        with undisturbed():
            return super().submit(*arguments, **named)

    def kill(self) -> None:
        """Ends the processes within their runs, whose results nobody waits for. The futures are
        broken then; one that is cancelled before would end the thread that breaks them.
        """
        with undisturbed():
            for process in list((self._processes or {}).values()):
                process.kill()
        self.shutdown()


@contextmanager
def process_pool(workers: int) -> Iterator[Workers]:
    """Processes that live as long as the block. Ctrl-C, and a second one, leaves none of them."""
    pool = Workers(workers)
    try:
        yield pool
        pool.shutdown(cancel_futures=True)
    except BaseException:
        pool.kill()
        raise


def interrupted(executor: Any) -> None:
    """After Ctrl-C: the workers of a pool of ours have nothing more to do."""
    if isinstance(executor, Workers):
        executor.kill()


def _deaf() -> None:
    """Ignores Ctrl-C, which is for the process that started the sweep: that one decides which runs
    do not begin.
    """
    import signal

    signal.signal(signal.SIGINT, signal.SIG_IGN)


def _cuts(runs: int, workers: int) -> list[tuple[int, int]]:
    """Parts of equal length, some for each worker: a part is lost or late as a whole."""
    length = max(1, math.ceil(runs / (8 * workers)))
    return [(first, min(first + length, runs)) for first in range(0, runs, length)]


def run_pooled(
    executor: Any, job: Runs | bytes, table: Table, workers: int, watch: Watch | None
) -> tuple[Columns, BaseException | None]:
    """The columns of all runs in their order, and the exception that was raised, or None."""
    cuts = _cuts(table.runs, workers)
    values = [table.part(first, last) for first, last in cuts]
    parts: list[Columns] = []
    raised: BaseException | None = None
    submitted = _submitted(executor, job, values)
    try:
        for first, last in cuts:
            parts.append(_part(submitted, last - first))
            if watch is not None and watch(last):
                break
    except KeyboardInterrupt as error:
        raised = error
        interrupted(executor)
    submitted.close()
    parts += [empty(last - first) for first, last in cuts[len(parts) :]]
    return join(parts), raised


def _submitted(executor: Any, job: Runs | bytes, values: list[Any]) -> Any:
    """The parts one after another. Closing the iterator cancels the parts that have not begun."""
    if hasattr(executor, "submit"):
        futures = [executor.submit(_run_part, job, part) for part in values]
        return _results_of(futures)
    if hasattr(executor, "map"):
        return _mapped(executor, job, values)
    raise ModelError(
        "sweep: expected an executor with submit() or map(), 'threads', 'processes' or 'serial', "
        f"found {executor!r}"
    )


def _results_of(futures: list[Any]) -> Iterator[Any]:
    try:
        for future in futures:
            yield future.result
    finally:
        for future in futures:
            future.cancel()


def _mapped(executor: Any, job: Runs | bytes, values: list[Any]) -> Iterator[Any]:
    done = iter(executor.map(functools.partial(_run_part, job), values))
    for _ in values:
        yield functools.partial(next, done)


def _part(submitted: Iterator[Any], runs: int) -> Columns:
    """The next part. If it was lost, its runs have the cause as their reason."""
    try:
        columns: Columns = next(submitted)()
    except (pickle.PicklingError, AttributeError, TypeError) as error:  # it cannot be sent there
        raise ModelError(f"sweep: cannot be run in another process ({error}); {REMEDY}") from None
    except NoSystem:
        raise
    except (CancelledError, BrokenProcessPool) as error:
        return failed(runs, f"the process that made this run ended: {error}")
    except Exception as error:
        return failed(runs, f"{type(error).__name__}: {error}")
    return columns
