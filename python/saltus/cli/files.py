"""Names of files on the command line: a suffix that promises another format is refused."""

from __future__ import annotations

from pathlib import Path

from saltus.errors import ModelError

__all__ = ["require_picture", "require_suffix"]


def require_suffix(flag: str, path: Path | None, *suffixes: str) -> None:
    """ModelError for a suffix that is not one of these. A name without a suffix is accepted."""
    if path is None or path.suffix.lower() in ("", *suffixes):
        return
    expected = " or ".join(suffixes)
    raise ModelError(
        f"{flag}: expected a name that ends in {expected}, the format of the file, found '{path}'"
    )


def require_picture(flag: str, path: Path | None) -> None:
    """ModelError for a suffix of no format that matplotlib writes."""
    if path is None:
        return
    from matplotlib.backend_bases import FigureCanvasBase

    known = sorted(f".{suffix}" for suffix in FigureCanvasBase.get_supported_filetypes())
    if path.suffix.lower() not in known:
        raise ModelError(
            f"{flag}: expected a name that ends in one of {', '.join(known)}, found '{path}'"
        )
