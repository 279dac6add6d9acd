"""Refusals: tracing ends with one sentence, the place in the user's source and a remedy."""

from __future__ import annotations

import linecache
import os
import sys
from types import FrameType, TracebackType
from typing import NoReturn

__all__ = ["MARK", "Refusal", "raised_at", "refuse"]

MARK = "__saltus_traced__"
"""a global that only the copies of the user's functions have"""


class Refusal(BaseException):
    """Carries the reason out of the user's function.

    It is no `Exception`, so an `except Exception` on the way does not swallow it.
    """

    by_check = False
    """whether a tape was made before"""


def refuse(what: str, remedy: str = "") -> NoReturn:
    """Raise a `Refusal`: `what`, the line of the user's function that led here, `remedy`."""
    place = here()
    raise Refusal(what + (f" at {place}" if place else "") + (f"; {remedy}" if remedy else ""))


def _text(frame: FrameType, line: int) -> str:
    name = frame.f_code.co_filename
    source = linecache.getline(name, line, frame.f_globals).strip()
    place = f"{os.path.basename(name)}:{line}"
    return f"{place} (`{source}`)" if source else place


def here() -> str:
    """The innermost line of a traced function that is running now, such as "ball.py:31 (`...`)"."""
    frame: FrameType | None = sys._getframe(1)
    while frame is not None:
        if MARK in frame.f_globals:
            return _text(frame, frame.f_lineno)
        frame = frame.f_back
    return ""


def raised_at(traceback: TracebackType | None) -> str:
    """The innermost line of a traced function an exception went through."""
    place = ""
    while traceback is not None:
        if MARK in traceback.tb_frame.f_globals:
            place = _text(traceback.tb_frame, traceback.tb_lineno)
        traceback = traceback.tb_next
    return place
