"""Object code in files, if the user names a directory."""

from __future__ import annotations

import contextlib
import hashlib
import os
import tempfile
from pathlib import Path

__all__ = ["cache_directory", "load", "store"]

VARIABLE = "SALTUS_JIT_CACHE"
"""the environment variable that names the directory until the user sets another"""

_directory: Path | None = Path(os.environ[VARIABLE]) if os.environ.get(VARIABLE) else None


def cache_directory(path: str | os.PathLike[str] | None) -> None:
    """Keep machine code in this directory, so that the next process need not compile it.

    It is used for systems that run as machine code, see the option `machine_code`. Files belong to
    one version of llvmlite and one kind of processor; other versions and processors ignore them,
    and damaged files are written anew. Whoever can write to the directory can run code in your
    process, so name a directory of your own.

    Parameters
    ----------
    path : path or None
        The directory, which is made when it is needed. With None nothing is kept. Before the first
        call the environment variable ``SALTUS_JIT_CACHE`` names it.

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
    """Writes object code. If that is impossible, nothing is kept."""
    if _directory is None:
        return
    with contextlib.suppress(OSError):
        _directory.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=_directory)
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(_checksum(key, code) + code)
            os.replace(name, _file(_directory, key))  # another process sees the whole file or none
        except BaseException:
            os.unlink(name)
            raise


def _checksum(key: str, code: bytes) -> bytes:
    """The checksum covers the key too, so a file under another name counts as damaged."""
    return hashlib.sha256(key.encode() + code).digest()


def _file(directory: Path, key: str) -> Path:
    return directory / f"{key}.code"
