"""The progress of a fit: a line on stderr, or a function of the user."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import NamedTuple

from saltus.errors import ModelError

__all__ = ["FitProgress", "Shown"]

NOTED = 0.1  # [s] the time from one report to the next


class FitProgress(NamedTuple):
    """The progress of a fit: the argument of ``progress=function``, ten times a second at most.

    Examples
    --------
    >>> print(saltus.FitProgress(7, 0.5, {"e": 0.9}, 0, 1, 4, 1.2))
    start 2 of 4, 7 evaluations, 0 failed, least sum of squares 0.5
    """

    evaluations: int
    """runs of all experiments so far"""
    sum_of_squares: float
    """the least sum of the squares of the residuals so far; inf if there is none"""
    parameters: dict[str, float]
    """where it was found, by name"""
    failures: int
    """evaluations that failed"""
    start: int
    """the number of the present start, from 0"""
    starts: int
    wall_time: float
    """[s] since the fit began"""

    def __str__(self) -> str:
        several = f"start {self.start + 1} of {self.starts}, " if self.starts > 1 else ""
        return (
            f"{several}{self.evaluations} evaluations, {self.failures} failed, least sum of "
            f"squares {self.sum_of_squares:.6g}"
        )


class Shown:
    """Shows the progress to the user, and at the end once more."""

    def __init__(self, wanted: object):
        if not (isinstance(wanted, bool) or callable(wanted) or wanted is None):
            raise ModelError(f"fit: progress: expected True, False or a function, found {wanted!r}")
        self.wanted = wanted
        self._next, self._width = 0.0, 0

    def __call__(self, now: Callable[[], FitProgress], last: bool = False) -> None:
        """Shows `now()`, if it is time for it."""
        if not self.wanted or (time.monotonic() < self._next and not last):
            return
        self._next = time.monotonic() + NOTED
        if callable(self.wanted):
            self.wanted(now())
            return
        text = str(now())
        sys.stderr.write(f"\r{text:<{self._width}}" + "\n" * last)
        sys.stderr.flush()
        self._width = len(text)
