"""The store of a sweep: a directory of chunks of rows, from which an interrupted sweep goes on."""

from __future__ import annotations

import hashlib
import inspect
import json
import os
import pickle
import re
from pathlib import Path
from typing import Any

import numpy as np

from saltus import _core
from saltus._engine import core_context
from saltus.ensemble.columns import Columns
from saltus.ensemble.job import Job
from saltus.ensemble.table import Table
from saltus.errors import ModelError
from saltus.system import OutputPort, System

__all__ = ["Store"]

FORMAT = 1
DIGEST = 32  # [bytes] the SHA-256 of a chunk, before its pickle
CHUNKS = 64  # without `chunk`, a sweep has about as many parts
ADDRESS = re.compile(r" at 0x[0-9a-f]+")


class Store:
    """Files `chunk-000000.pickle` of columns, and `manifest.json`, which says of which sweep."""

    def __init__(self, path: str | os.PathLike[str], job: Job, table: Table, chunk: int | None):
        self.path = Path(path)
        found = self._manifest()
        default = -(-table.runs // CHUNKS) if found is None else found.get("chunk")
        self.chunk = chunk if chunk is not None else default
        task = {**_task(job, table), "format": FORMAT, "chunk": self.chunk}
        if found is None:
            self.path.mkdir(parents=True, exist_ok=True)
            _write(self.path / "manifest.json", json.dumps(task, indent=1).encode())
        elif differing := [name for name in task if found.get(name) != task[name]]:
            raise ModelError(
                f"sweep: store '{self.path}' is of another sweep, with other "
                f"{', '.join(differing)}; take another directory, or remove this one"
            )

    def _manifest(self) -> dict[str, Any] | None:
        file = self.path / "manifest.json"
        if self.path.exists() and not self.path.is_dir():
            raise ModelError(f"sweep: store: expected a directory, found the file '{self.path}'")
        if not file.exists():
            if self.path.is_dir() and any(p.suffix != ".part" for p in self.path.iterdir()):
                raise ModelError(f"sweep: store '{self.path}' has files, but no manifest.json")
            return None
        try:
            read = json.loads(file.read_bytes())
            if isinstance(read, dict) and read.get("chunk", 0) >= 1:
                return read
        except (ValueError, TypeError):
            pass
        raise ModelError(f"sweep: store: '{file}' is damaged; remove the directory")

    def cuts(self, runs: int) -> list[tuple[int, int]]:
        """The first row of each chunk, and the one after its last."""
        return [(first, min(first + self.chunk, runs)) for first in range(0, runs, self.chunk)]

    def _file(self, number: int) -> Path:
        return self.path / f"chunk-{number:06d}.pickle"

    def load(self, number: int, runs: int) -> Columns | None:
        """A finished chunk. None if it is missing or damaged: then it is run again."""
        try:
            data = self._file(number).read_bytes()
        except FileNotFoundError:
            return None
        if hashlib.sha256(data[DIGEST:]).digest() != data[:DIGEST]:
            return None
        columns: Columns = pickle.loads(data[DIGEST:])
        return columns if len(columns["status"]) == runs else None

    def save(self, number: int, columns: Columns) -> None:
        data = pickle.dumps(columns, protocol=5)
        _write(self._file(number), hashlib.sha256(data).digest() + data)


def _write(file: Path, data: bytes) -> None:
    """The whole file or nothing of it: a process that is killed leaves a file `.part`."""
    part = file.with_name(f"{file.name}.{os.getpid()}.part")
    with open(part, "wb") as opened:
        opened.write(data)
        opened.flush()
        os.fsync(opened.fileno())
    os.replace(part, file)


def _task(job: Job, table: Table) -> dict[str, str]:
    """A digest of each thing on which the results depend."""
    options = {k: v for k, v in vars(job.options).items() if k != "progress"}
    return {
        "system": _digest(_system(job)),
        "values": _digest([(name, _exact(c)) for name, c in table.columns.items()]),
        "t_span": _digest(job.span),
        "options": _digest(options),
        "recorded_signals": _digest([(n, _port(p)) for n, p in job.signals.items()]),
        "context": _digest(repr(_context(job))),
        "reduce": _digest(_code(job.reduce)),
        "saltus": _core.__version__,
    }


def _digest(value: object) -> str:
    return hashlib.sha256(ADDRESS.sub("", repr(value)).encode()).hexdigest()


def _exact(column: Any) -> object:
    if isinstance(column, np.ndarray):
        return column.dtype.str, column.shape, column.tobytes().hex()
    return [_exact(v) if isinstance(v, np.ndarray) else v for v in column]


def _system(job: Job) -> object:
    """The values and names of all blocks, their classes and wires; the code of a factory."""
    if not isinstance(job.system, System):
        return _code(job.system)
    begin = job.system.create_context(job.span[0])
    return core_context(begin).to_json(), job.system.to_dot(), _blocks(job.system)


def _blocks(system: Any) -> list[object]:
    """The classes of a system and of its blocks, and their attributes that are plain values."""
    inner = getattr(system, "blocks", None) or ()
    blocks = inner.values() if isinstance(inner, dict) else inner
    own = {name: _plain(v) for name, v in sorted(getattr(system, "__dict__", {}).items())}
    return [_code(type(system)), own, *(_blocks(b) for b in blocks if b is not system)]


def _plain(value: object) -> object:
    if isinstance(value, np.ndarray):
        return _exact(value)
    if isinstance(value, (bool, int, float, complex, str, np.number)):
        return repr(value)
    if isinstance(value, (list, tuple)):
        return [_plain(v) for v in value]
    if isinstance(value, dict):
        return [(str(k), _plain(v)) for k, v in value.items()]
    return type(value).__qualname__


def _context(job: Job) -> str | None:
    return None if job.context is None else core_context(job.context).to_json()


def _port(port: OutputPort | str) -> str:
    return port if isinstance(port, str) else repr(port)


def _code(function: Any) -> object:
    """The name of a function or a class, and its source where Python finds it."""
    if function is None:
        return None
    name = getattr(function, "__qualname__", type(function).__qualname__)
    try:
        return name, inspect.getsource(function)
    except (TypeError, OSError):  # compiled, or typed at a prompt
        return name, ""
