"""The store of a sweep: a directory of chunks of rows, from which an interrupted sweep goes on."""

from __future__ import annotations

import hashlib
import json
import os
import pickle
from pathlib import Path
from typing import Any

from saltus.ensemble.columns import Columns
from saltus.ensemble.runs import Runs
from saltus.ensemble.table import Table
from saltus.errors import ModelError

__all__ = ["Store"]

FORMAT = 1
DIGEST = 32  # [bytes] the SHA-256 of a chunk, before its pickle
CHUNKS = 64  # without `chunk`, a sweep has about as many parts


class Store:
    """Files `chunk-000000.pickle` of columns, and `manifest.json`, which says of which sweep."""

    def __init__(self, path: str | os.PathLike[str], job: Runs, table: Table, chunk: int | None):
        if not isinstance(path, (str, os.PathLike)):
            raise ModelError(f"sweep: store: expected the path of a directory, found {path!r}")
        self.path = Path(path)
        found = self._manifest()
        usual = -(-table.runs // CHUNKS) if found is None else int(found["chunk"])
        self.chunk = usual if chunk is None else chunk
        task = {**job.fingerprint(table), "format": FORMAT, "chunk": self.chunk}
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
                raise ModelError(
                    f"sweep: store '{self.path}' has files, but no manifest.json, so it is no "
                    "store; take an empty directory, or one that does not exist"
                )
            return None
        try:
            read = json.loads(file.read_bytes())
        except ValueError:
            read = None
        if isinstance(read, dict) and isinstance(read.get("chunk"), int) and read["chunk"] >= 1:
            return read
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
