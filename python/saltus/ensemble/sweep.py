"""`sweep`: a system run for each point of a grid, or each row of a table."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from saltus import _core
from saltus.ensemble.columns import STATUS, Columns, join
from saltus.ensemble.dataset import (
    refuse_reserved,
    require_xarray,
    summary,
    to_dataset,
    to_dict,
)
from saltus.ensemble.job import Job, Watch
from saltus.ensemble.table import Table, table_of
from saltus.errors import ModelError
from saltus.porting import OPTIONS, refuse
from saltus.results import Results
from saltus.simulation import SimulatorOptions
from saltus.span import span_of
from saltus.system import OutputPort, System

if TYPE_CHECKING:
    import pandas  # type: ignore[import-untyped,import-not-found,unused-ignore]

__all__ = ["sweep"]

SOON = 0.5  # [s] what takes no longer is not worth the start of other processes
NOTED = 0.25  # [s] from one line of progress to the next
KINDS = ("threads", "processes", "serial")
Outcome = tuple[Columns, "BaseException | None", str, int]


def sweep(
    system: System | Callable[..., System],
    values: Mapping[str, Any] | Iterable[Mapping[str, Any]] | pandas.DataFrame,
    t_span: tuple[float, float],
    *,
    options: SimulatorOptions | None = None,
    recorded_signals: Mapping[str, OutputPort | str] | None = None,
    context: _core.Context | None = None,
    executor: Any = None,
    workers: int | None = None,
    reduce: Callable[[Results], Any] | None = None,
    progress: bool = False,
    paired: bool = False,
    as_dict: bool = False,
    **option_overrides: Any,
) -> Any:
    """Runs a system once for each point of a grid of values, or for each row of a table.

    The runs know nothing of each other: each is, bit for bit, the run that `simulate` would make,
    whatever the executor, the number of workers and the order. A run that fails keeps its reason,
    and the others go on. Systems of C++ blocks run in threads over one compiled plan; those with
    Python functions one after another here, or in processes.

    Parameters
    ----------
    system : System or callable
        The system; or a function ``make(**values) -> System`` for values that are structure, such
        as the attribute of a block. Of `values` it gets those it has arguments for.
    values : mapping, list of dicts or pandas.DataFrame
        A dict of names and values makes the grid of all combinations; with ``paired=True`` its
        columns belong together, row by row, as those of a list of dicts or a DataFrame do. A
        single value holds for all runs. A name is that of a parameter, ``"g"``, or of an initial
        state: ``"x"`` and ``"z"`` are the continuous and the discrete state of a block, ``"x[0]"``
        an entry, ``"mode"`` its mode. In a diagram the path of the block goes before it:
        ``"ball.g"``, ``"ball.x[0]"``.
    t_span : (float, float)
        Begin and end [s].
    options : SimulatorOptions, optional
        How each run is done; any option can also be given by name, such as ``rtol=1e-9``.
        Recorded signals are kept at the times of the option ``save_at`` [s], or else at the end.
        ``throw`` says nothing here: failures are kept.
    recorded_signals : mapping of str to OutputPort or str, optional
        What to record, by name: a port, or its name, ``"y"`` or ``"ball.y"``, which works for
        systems that are not made yet.
    context : Context, optional
        The values that are not varied; those of the blocks if not said.
    executor : optional
        ``"threads"``, ``"processes"``, ``"serial"``, or an object with ``submit`` or ``map``:
        an executor of `concurrent.futures` or of mpi4py, a Dask ``Client``, a pool of joblib or
        multiprocessing. Not said: threads where no Python function runs; else it begins here, and
        what remains after half a second goes to processes if it can.
    workers : int, optional
        Threads or processes, or workers of the executor; the number of cores if not said.
    reduce : callable, optional
        ``reduce(results)`` of a run that ended well gives a number, an array, or a dict of such,
        which are kept in place of states and signals. An error in it is one of its run.
    progress : bool
        Shows how many runs are done: a bar where tqdm is installed, else a line.
    paired : bool
        The columns of a dict belong together.
    as_dict : bool
        A dict of numpy arrays, by the same names and in the same shapes, which needs no xarray.
    **option_overrides
        Single options.

    Returns
    -------
    xarray.Dataset
        Over the names of a grid, or over ``run``: the recorded signals, ``continuous_state``,
        ``discrete_state`` and ``modes`` at the end, or what `reduce` gave; ``status``, ``message``
        and ``block`` of each run, ``end_time`` and ``wall_time`` [s], ``events`` and ``steps``.
        nan stands where a run has no value: where it failed, or after its end. A signal at the time
        of an event has the value after it. ``attrs`` has the failures by reason, the wall time and
        the runs per second of the whole.

    Raises
    ------
    ModelError
        Before anything is run: for unknown names, with the nearest one, for values that cannot be
        meant, and where a system cannot go to another process.
    ImportError
        Before anything is run: where xarray is not installed, unless `as_dict`.
    KeyboardInterrupt
        After Ctrl-C, with what is done as its attribute ``results``; the status of the rest is
        'interrupted' or 'not_run'.

    Examples
    --------
    >>> import saltus
    >>> ball = saltus.scene("bouncing-ball").system
    >>> grid = {"e": [0.5, 0.7, 0.9], "x[0]": [5.0, 10.0]}
    >>> landed = saltus.sweep(ball, grid, (0.0, 3.0), rtol=1e-9)
    >>> landed["events"].dims, landed["events"].values.tolist()
    (('e', 'x[0]'), [[7, 2], [2, 1], [2, 1]])
    """
    table = table_of(values, paired)
    job = _job(system, t_span, options, recorded_signals, context, reduce, option_overrides)
    refuse_reserved(table.columns, job.signals)
    if not as_dict:
        require_xarray()
    job.check(table.columns)
    start = time.perf_counter()
    with _Progress(table.runs, progress or bool(job.options.progress)) as shown:
        columns, raised, kind, count = _run(job, table, executor, workers, shown.watch)
    attributes = summary(columns, time.perf_counter() - start)
    attributes |= {"executor": kind, "workers": count, "saltus": _core.__version__}
    give = to_dict if as_dict else to_dataset
    reduced = _name_of(reduce)
    results = give(columns, table, reduced, list(job.options.save_at), attributes)
    if raised is not None:
        raised.results = results  # type: ignore[attr-defined]
        raise raised
    return results


def _name_of(reduce: Callable[[Results], Any] | None) -> str:
    """Of the result of `reduce`, where it is no dict."""
    if reduce is None:
        return ""
    name = getattr(reduce, "__name__", "")
    return name if name.isidentifier() else "reduced"


def _job(
    system: object,
    t_span: object,
    options: SimulatorOptions | None,
    signals: Mapping[str, OutputPort | str] | None,
    context: _core.Context | None,
    reduce: Callable[[Results], Any] | None,
    overrides: dict[str, Any],
) -> Job:
    if not isinstance(system, System) and not callable(system):
        raise ModelError(
            f"sweep: expected a system, or a function that makes one, found {system!r}"
        )
    if context is not None and not isinstance(system, System):
        raise ModelError("sweep: a context is of one system; here a function makes many")
    if "throw" in overrides:
        raise ModelError("sweep: no option 'throw': failures are kept, with their reasons")
    options = options or SimulatorOptions()
    if not isinstance(options, SimulatorOptions):
        raise ModelError(f"sweep: expected SimulatorOptions, found {options!r}")
    refuse("sweep", overrides, SimulatorOptions.__dataclass_fields__, OPTIONS)
    options = replace(options, **overrides)
    signals = dict(signals if signals is not None else options.recorded_signals or {})
    if reduce is None:  # nobody sees events and steps
        if options.save_steps:
            raise ModelError("sweep: save_steps: runs have no steps in common; say save_at=[...]")
        options = replace(options, save_steps=False, record_events=False)
    elif not callable(reduce):
        raise ModelError(f"sweep: reduce: expected a function of a Results, found {reduce!r}")
    options = replace(options, recorded_signals=None)
    return Job(system, context, _span(t_span), options, signals, reduce)


def _span(t_span: object) -> tuple[float, float]:
    begin, end = span_of("sweep", t_span)
    if not end >= begin:
        raise ModelError(f"sweep: expected a span with begin <= end, found {begin} s to {end} s")
    return begin, end


def _workers(workers: int | None, runs: int) -> int:
    if workers is not None and (not isinstance(workers, int) or workers < 1):
        raise ModelError(f"sweep: workers: expected 1 or more, found {workers!r}")
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    return min(workers or cores or 1, runs)


def _run(job: Job, table: Table, executor: Any, workers: int | None, watch: Watch) -> Outcome:
    """By the executor that was asked for, or that suits; with what it was and how many workers."""
    count = _workers(workers, table.runs)
    if executor is None:
        return _run_as_suits(job, table, workers, count, watch)
    if not isinstance(executor, str):
        from saltus.ensemble import pools  # processes are not loaded before they are wanted

        columns, raised = pools.run_pooled(executor, job, table, count, watch)
        return columns, raised, type(executor).__name__, count
    if executor not in KINDS:
        hint = _core.known_names(executor, list(KINDS))
        raise ModelError(f"sweep: unknown executor '{executor}'{hint}")
    if executor == "processes":
        return *_in_processes(job, table, count, watch), executor, count
    if executor == "threads" and job.is_factory:
        raise ModelError("sweep: a function makes systems one by one: no threads share a plan")
    count = count if executor == "threads" else 1
    return *job.run(table.columns, count, watch), executor, count


def _run_as_suits(job: Job, table: Table, workers: int | None, count: int, watch: Watch) -> Outcome:
    if not job.needs_interpreter:
        return *job.run(table.columns, count, watch), "threads", count
    portable = _portable(job, must=(workers or 1) > 1)
    if count == 1 or not portable:
        return *job.run(table.columns, 1, watch), "serial", 1
    start = time.perf_counter()
    columns, raised = job.run(
        table.columns, 1, lambda done: watch(done) or time.perf_counter() - start > SOON
    )
    done = _begun(columns)
    if raised is not None or done == table.runs:
        return columns, raised, "serial", 1
    rest = Table(table.part(done, table.runs), {"run": []}, table.runs - done)
    more, raised = _in_processes(job, rest, count, lambda n: watch(done + n))
    return join([_rows(columns, done), more]), raised, "processes", count


def _portable(job: Job, must: bool) -> bool:
    """Whether it can go to another process; ModelError where it must."""
    from saltus.ensemble import pools

    try:
        pools.pickled(job)
    except ModelError:
        if must:
            raise
        return False
    return True


def _begun(columns: Columns) -> int:
    """How many runs were made to their end, counted from the first."""
    ended = ~_is(columns, "not_run", "interrupted")
    return len(ended) if ended.all() else int(ended.argmin())


def _is(columns: Columns, *names: str) -> Any:
    import numpy as np

    return np.isin(STATUS[columns["status"]], names)


def _rows(columns: Columns, count: int) -> Columns:
    """The first rows."""
    cut = {n: c[:count] for n, c in columns.items() if hasattr(c, "shape")}
    cut["signals"] = {name: array[:count] for name, array in columns["signals"].items()}
    for name in ("reasons", "reduced"):
        cut[name] = {run: value for run, value in columns[name].items() if run < count}
    return cut | {"names": columns["names"]}


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


class _Progress:
    """A bar of tqdm, or a line for a terminal without it; nothing unless it is wanted."""

    def __init__(self, runs: int, wanted: bool):
        self.runs, self.bar, self.wanted = runs, None, wanted
        self.next = 0.0

    def __enter__(self) -> _Progress:
        if self.wanted:
            try:
                import tqdm  # type: ignore[import-untyped,unused-ignore]

                self.bar = tqdm.tqdm(total=self.runs, unit="run")
            except ImportError:
                pass
        return self

    def watch(self, done: int) -> bool:
        """Shows it; never ends the sweep."""
        if self.bar is not None:
            self.bar.update(done - self.bar.n)
        elif self.wanted and time.monotonic() >= self.next:
            self.next = time.monotonic() + NOTED
            print(f"\r{done} of {self.runs} runs", end="", flush=True, file=_stderr())
        return False

    def __exit__(self, kind: object, *rest: object) -> None:
        if kind is None:
            self.next = 0.0
            self.watch(self.runs)
        if self.bar is not None:
            self.bar.close()
        elif self.wanted:
            print(file=_stderr())


def _stderr() -> Any:
    import sys

    return sys.stderr
