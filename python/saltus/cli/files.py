"""Names of files on the command line, which are checked before the work: the suffix, the folder."""

from __future__ import annotations

import os
from pathlib import Path

from saltus.errors import ModelError

__all__ = ["require_picture", "require_suffix"]


def require_suffix(flag: str, path: Path | None, *suffixes: str) -> None:
    """ModelError for a suffix that is not one of these, and for a file that cannot be written. A
    name without a suffix is accepted.
    """
    if path is None:
        return
    _require_writable(flag, path)
    if path.suffix.lower() in ("", *suffixes):
        return
    expected = " or ".join(suffixes)
    raise ModelError(
        f"{flag}: expected a name that ends in {expected}, the format of the file, found '{path}'"
    )


def require_picture(flag: str, path: Path | None) -> None:
    """ModelError for a suffix of no format that matplotlib writes, and for a file that cannot be
    written.
    """
    if path is None:
        return
    _require_writable(flag, path)
    from matplotlib.backend_bases import FigureCanvasBase

    known = sorted(f".{suffix}" for suffix in FigureCanvasBase.get_supported_filetypes())
    if path.suffix.lower() not in known:
        raise ModelError(
            f"{flag}: expected a name that ends in one of {', '.join(known)}, found '{path}'"
        )


def _require_writable(flag: str, path: Path) -> None:
    if path.is_dir():
        raise ModelError(f"{flag}: expected the name of a file, found the folder '{path}'")
    if not path.parent.is_dir():
        raise ModelError(f"{flag}: '{path}': there is no folder '{path.parent}'; make it")
    place = path if path.exists() else path.parent
    if not os.access(place, os.W_OK):
        raise ModelError(f"{flag}: '{place}' is not writable; choose another name")
