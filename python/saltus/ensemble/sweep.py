"""`sweep`: a system run for each point of a grid, or each row of a table."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from saltus import _core
from saltus._engine import core_options
from saltus._porting import OPTIONS, refuse
from saltus._signals import named
from saltus._span import rows_within, span_of
from saltus.ensemble.dataset import (
    refuse_reserved,
    summary,
    to_dataset,
    to_dict,
    xarray,
)
from saltus.ensemble.executors import run, store_of
from saltus.ensemble.job import Following, Job
from saltus.ensemble.progress import Progress
from saltus.ensemble.table import table_of
from saltus.errors import ModelError
from saltus.results import Results
from saltus.simulation import SimulatorOptions
from saltus.system import OutputPort, System

if TYPE_CHECKING:
    import pandas  # type: ignore[import-untyped,import-not-found,unused-ignore]

__all__ = ["sweep"]


def sweep(
    system: System | Callable[..., System],
    values: Mapping[str, Any] | Iterable[Mapping[str, Any]] | pandas.DataFrame,
    t_span: tuple[float, float],
    *,
    options: SimulatorOptions | None = None,
    recorded_signals: Mapping[str, OutputPort | str] | Sequence[str] | None = None,
    context: _core.Context | None = None,
    executor: Any = None,
    workers: int | None = None,
    reduce: Callable[[Results], Any] | None = None,
    progress: bool = False,
    paired: bool = False,
    as_dict: bool = False,
    store: str | os.PathLike[str] | None = None,
    chunk: int | None = None,
    retries: int = 0,
    **option_overrides: Any,
) -> Any:
    """Runs a system once for each point of a grid of values, or for each row of a table.

    The runs are independent: each is, bit for bit, the run that `simulate` would make, whatever the
    executor, the number of workers and the order. A run that fails keeps its reason, and the others
    go on. Systems of C++ blocks run in threads over one compiled plan; systems with Python
    functions run one after another here, or in processes if you ask for them.

    Parameters
    ----------
    system : System or callable
        The system; or a function ``make(**values) -> System`` for values that are structure, such
        as the attribute of a block. It gets the `values` for which it has arguments.
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
        The options of each run; any option can also be given by name, such as ``rtol=1e-9``.
        Recorded signals are kept at the times of the option ``save_at`` [s], or else at the end.
        ``throw`` has no effect here: failures are kept.
    recorded_signals : mapping of str to OutputPort or str, optional
        The signals to record, by name: a port, or its name, ``"y"`` or ``"ball.y"``, which works
        for systems that are not made yet.
    context : Context, optional
        The values that are not varied; by default those of the blocks.
    executor : optional
        ``"threads"``, ``"processes"``, ``"serial"``, or an object with ``submit`` or ``map``:
        an executor of `concurrent.futures` or of mpi4py, a Dask ``Client``, a pool of joblib or
        multiprocessing. By default threads if no Python function runs, otherwise one run after
        another here, or processes if `workers` is above 1. A script that starts processes needs
        ``if __name__ == "__main__":`` around its statements.
    workers : int, optional
        The number of threads, processes, or workers of the executor; by default the number of
        cores.
    reduce : callable, optional
        ``reduce(results)`` of a run that ended well gives a number, an array, or a dict of these,
        which are kept in place of states and signals. An error in it is an error of its run.
    progress : bool
        Shows how many runs are done, by a bar if tqdm is installed, otherwise by a line.
    paired : bool
        The columns of a dict belong together, row by row.
    as_dict : bool
        Return a dict of numpy arrays with the same names and shapes, which needs no xarray.
    store : path, optional
        A directory that keeps finished chunks of rows, so that the same call after a kill runs only
        the missing ones and gives the same bits (the wall times of finished rows included). A chunk
        is written whole or not at all; a damaged one is run again; a store of another sweep is
        refused. Chunks are pickles: open only a store that you trust.
    chunk : int, optional
        With a store, the rows of a chunk; by default such that there are at most 64 chunks.
    retries : int
        With a store, how often a chunk is submitted again whose worker died. After that its rows
        have the status 'failed' and the cause as their message; the next call runs them again.
    **option_overrides
        Single options.

    Returns
    -------
    xarray.Dataset
        The dataset over the names of a grid, or over ``run``. It has the recorded signals,
        ``continuous_state``, ``discrete_state`` and ``modes`` at the end, or the values of
        `reduce`; ``status``, ``message`` and ``block`` of each run, ``end_time`` and ``wall_time``
        [s], ``events`` and ``steps``.
        A value is nan if a run has none, because it failed or because it had ended. A signal at the
        time of an event has the value after the event. ``attrs`` has the failures by reason, the
        wall time and the runs per second of the whole.

    Raises
    ------
    ModelError
        Before anything is run, if a name is unknown (the message has the nearest), a value is
        impossible, a function needs more than the values, or a system cannot go to another process.
        Also if a function makes something else than a system, or a store belongs to another sweep.
    ImportError
        Before anything is run, if xarray is not installed, unless `as_dict`.
    KeyboardInterrupt
        After Ctrl-C. Its attribute ``results`` has the finished runs; the status of the others is
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
    system, follow = system if isinstance(system, Following) else (system, None)
    job = _job(system, t_span, options, recorded_signals, context, reduce, option_overrides)
    job = replace(job, follow=follow)
    refuse_reserved(table.columns, job.signals)
    if not as_dict:
        xarray()
    job.check(table.columns)
    kept = store_of(store, chunk, retries, job, table)
    start = time.perf_counter()
    with Progress(table.runs, progress or bool(job.options.progress)) as shown:
        columns, raised, kind, count = run(
            job, table, executor, workers, shown.watch, kept, retries
        )
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
    """The name of the result of `reduce` if it is no dict."""
    if reduce is None:
        return ""
    name = getattr(reduce, "__name__", "")
    return name if name.isidentifier() else "reduced"


def _job(
    system: object,
    t_span: object,
    options: SimulatorOptions | None,
    signals: Mapping[str, OutputPort | str] | Sequence[str] | None,
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
    signals = named(signals if signals is not None else options.recorded_signals or {})
    if reduce is None:  # events and steps are not shown
        if options.sensitivity:
            raise ModelError(
                "sweep: sensitivity: a dataset has no derivatives; say with reduce=... what to keep"
            )
        if options.save_steps:
            raise ModelError("sweep: save_steps: runs have no steps in common; say save_at=[...]")
        options = replace(options, save_steps=False, record_events=False)
    elif not callable(reduce):
        raise ModelError(f"sweep: reduce: expected a function of a Results, found {reduce!r}")
    options, span = replace(options, recorded_signals=None), span_of("sweep", t_span)
    core_options(options)  # refuses times that are none
    options = replace(options, save_at=rows_within("sweep", options.save_at, span))
    return Job(system, context, span, options, signals, reduce)
