"""Results in a file, and back.

The format is NumPy's own `.npz`: every array is in it bit for bit, and everything else as JSON
beside it. Nothing in it is ever executed, so a file of unknown origin is safe to open.
"""

from __future__ import annotations

import errno
import os
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any

import numpy as np

from saltus import _core
from saltus.errors import ModelError
from saltus.results.header import checked_arrays, checked_events, checked_statistics, strings, text
from saltus.results.record import KINDS, KeptRun

if TYPE_CHECKING:
    from saltus.results.outcome import Results

__all__ = ["load_results", "save"]

FORMAT = "saltus results 2"
OTHERS = {
    ".csv": "results.to_csv(path) writes the rows as text",
    ".tsv": "results.to_pandas().to_csv(path, sep='\\t') writes the rows as text",
    ".txt": "results.to_pandas().to_string(path) writes the rows as text",
    ".json": "results.to_pandas().to_json(path) writes the rows so",
    ".xlsx": "results.to_pandas().to_excel(path) writes the rows so",
    ".parquet": "results.to_pandas().to_parquet(path) writes the rows so",
    ".feather": "results.to_pandas().to_feather(path) writes the rows so",
    ".h5": "results.to_pandas().to_hdf(path, key='results') writes the rows so",
    ".hdf5": "results.to_pandas().to_hdf(path, key='results') writes the rows so",
    ".nc": "results.to_xarray().to_netcdf(path) writes the rows so",
    ".npy": "numpy.save(path, results.time) writes one array",
    ".mat": "scipy.io.savemat(path, dict(results.outputs)) writes the signals so",
    ".pkl": "pickle.dump(results, file) writes so",
    ".pickle": "pickle.dump(results, file) writes so",
}
"""suffixes of formats that a saved run does not have, and how to write them"""


def save(run: KeptRun, path: str | PathLike[str], kind: dict[str, Any]) -> None:
    """Writes a run; the file has exactly the name that was given."""
    import json

    refuse_suffix(path)
    if run.sensitivities is not None:
        raise ModelError(
            "save: the file format has no place for derivatives; write them with numpy.savez, or "
            "the whole results with pickle"
        )
    if run.apart:
        raise ModelError(
            "save: the file format has one table, and the islands of this run have rows of their "
            "own; run it with save_at=[...] and event_rows=False, or write the results with pickle"
        )
    arrays = {"time": run.time, "jump": run.jump}
    arrays |= {f"output {i}": array for i, array in enumerate(run.outputs.values())}
    arrays["event time"] = np.array([e[0] for e in run.events], dtype=float)
    arrays["event predicted"] = np.array([e[6] for e in run.events], dtype=float)
    states = [x for e in run.events for x in (e[7], e[8])]
    arrays["event states"] = np.concatenate(states) if states else np.empty(0)
    layout, values = run.context.__getstate__()  # type: ignore[attr-defined]
    header = {
        "format": FORMAT,
        **kind,
        "outputs": list(run.outputs),
        "status": run.status,
        "message": run.message,
        "block": run.block,
        "statistics": run.statistics,
        "events": [[*e[1:6], e[9], len(e[7]), list(e[10])] for e in run.events],
        "event_names": run.event_names,
        "context": {"layout": layout, "values": values},
    }
    arrays["header"] = np.frombuffer(json.dumps(header).encode(), dtype=np.uint8)
    with open(fspath(path), "wb") as file:
        np.savez_compressed(file, **arrays)  # type: ignore[arg-type,unused-ignore]


def refuse_suffix(path: str | PathLike[str]) -> None:
    """ModelError for a name that promises another format than NumPy's .npz."""
    suffix = os.path.splitext(fspath(path))[1].lower()
    if suffix in OTHERS:
        raise ModelError(
            f"save: expected a name that ends in '.npz', found '{fspath(path)}', and the file is "
            f"no {suffix} file; {OTHERS[suffix]}"
        )


def load_results(path: str | PathLike[str]) -> Results:
    """Reads a file of `Results.save`.

    Parameters
    ----------
    path : str or path
        The file.

    Returns
    -------
    Results, or Solution if `saltus.solve` made it
        The results with the same bits: rows, events, status, statistics, final context. A run
        continues from its context if the system has the same blocks. The file has neither dense
        output nor the exception of a failed run, but it has its message.

    Raises
    ------
    ModelError
        If the file is damaged, or was not written by `Results.save`.
    OSError
        If there is no such file, or it cannot be read.

    Examples
    --------
    >>> import os, tempfile, saltus
    >>> path = os.path.join(tempfile.mkdtemp(), "decay.npz")
    >>> solution = saltus.solve(lambda t, x: -x, (0, 1), [1.0])
    >>> solution.save(path)
    >>> bool((saltus.load_results(path).time == solution.time).all())
    True
    """
    import json
    import zipfile

    try:
        with open(fspath(path), "rb") as file, np.load(file, allow_pickle=False) as parts:
            arrays = {name: parts[name] for name in parts.files}
        header = json.loads(arrays["header"].tobytes())
        if header["format"] != FORMAT:
            raise ModelError(f"expected the format '{FORMAT}', found '{header['format']}'")
        results: Results = KINDS[header["kind"]](_kept(header, arrays), header)
        return results
    except OSError as error:
        # Also for a place before the beginning of the file, and for a damaged stream, which has no
        # errno.
        if error.errno not in (None, errno.EINVAL):
            raise
        reason = str(error)
    except (zipfile.BadZipFile, ModelError, EOFError, KeyError) as error:
        reason = f"it has no {error}" if isinstance(error, KeyError) else str(error)
    except Exception as error:  # any exception that a damaged file causes
        reason = f"{type(error).__name__}: {error}"
    raise ModelError(
        f"{fspath(path)}: expected a file of Results.save; it is another one or damaged ({reason})"
    )


def _kept(header: dict[str, Any], arrays: dict[str, np.ndarray]) -> KeptRun:
    outputs = checked_arrays(strings("'outputs'", header["outputs"]), arrays)
    if header["status"] not in _core.status_names():
        raise ModelError(f"the status is {str(header['status'])[:60]}")
    return KeptRun(
        time=arrays["time"],
        jump=arrays["jump"],
        outputs=outputs,
        context=_context(header["context"]),
        status=header["status"],
        message=text("'message'", header["message"]),
        block=text("'block'", header["block"]),
        statistics=checked_statistics(header["statistics"]),
        events=checked_events(header["events"], arrays),
        event_names=strings("'event_names'", header["event_names"]),
    )


def _context(data: dict[str, Any]) -> _core.Context:
    leaves, systems = data["layout"]
    layout = (
        [(*leaf[:7], [tuple(p) for p in leaf[7]], *leaf[8:]) for leaf in map(tuple, leaves)],
        [tuple(system) for system in systems],
    )
    context = _core.Context.__new__(_core.Context)
    context.__setstate__((layout, data["values"]))  # type: ignore[attr-defined]
    return context
