"""Object code in files, if the user says where."""

from __future__ import annotations

import contextlib
import hashlib
import os
import tempfile
from pathlib import Path

__all__ = ["cache_directory", "load", "store"]

VARIABLE = "SALTUS_JIT_CACHE"
"""the environment variable that names the directory at first"""

_directory: Path | None = Path(os.environ[VARIABLE]) if os.environ.get(VARIABLE) else None


def cache_directory(path: str | os.PathLike[str] | None) -> None:
    """Keep machine code in this directory, so that the next process need not compile it.

    It is used for systems that run as machine code, see the option `machine_code`. Files belong to
    one version of llvmlite and one kind of processor; others ignore them, and damaged ones are
    written anew. Whoever can write there can run code in your process: name a directory of your
    own.

    Parameters
    ----------
    path : path or None
        The directory, which is made when it is needed; None: nothing is kept. Before the first
        call the environment variable ``SALTUS_JIT_CACHE`` says it.

    Examples
    --------
    >>> import saltus.jit
    >>> saltus.jit.cache_directory("saltus-code")
    >>> saltus.jit.cache_directory(None)
    """
    global _directory
    _directory = None if path is None else Path(path)


def load(key: str) -> bytes | None:
    """The object code of a key; None if there is none, or if its file is damaged."""
    if _directory is None:
        return None
    try:
        data = _file(_directory, key).read_bytes()
    except OSError:
        return None
    check, code = data[:32], data[32:]
    return code if check == _checksum(key, code) else None


def store(key: str, code: bytes) -> None:
    """Writes object code; where that is impossible, nothing is kept."""
    if _directory is None:
        return
    with contextlib.suppress(OSError):
        _directory.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=_directory)
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(_checksum(key, code) + code)
            os.replace(name, _file(_directory, key))  # another process sees all of it or nothing
        except BaseException:
            os.unlink(name)
            raise


def _checksum(key: str, code: bytes) -> bytes:
    """Of the key too: a file under another name is damaged."""
    return hashlib.sha256(key.encode() + code).digest()


def _file(directory: Path, key: str) -> Path:
    return directory / f"{key}.code"
