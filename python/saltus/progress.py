"""The progress of a run: a bar, a line, or a function of the user."""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable
from types import TracebackType
from typing import Any, NamedTuple

from saltus.errors import ModelError

__all__ = ["Progress", "Reporter", "reporter_of"]


class Progress(NamedTuple):
    """The progress of a run: the argument of ``progress=function``, ten times a second at most.

    Examples
    --------
    >>> from saltus import Progress
    >>> now = Progress(time=3.0, begin=0.0, end=12.0, events=5, wall_time=0.5)
    >>> now.fraction, now.rate
    (0.25, 6.0)
    """

    time: float
    """[s] simulated time"""
    begin: float
    """[s] simulated time at which the run began"""
    end: float
    """[s] simulated time at which it will end"""
    events: int
    """resets, updates and mode changes so far"""
    wall_time: float
    """[s] since the run was started"""

    @property
    def fraction(self) -> float:
        """The part of the span that is done, 0 to 1."""
        length = self.end - self.begin
        if length == 0.0:
            return 1.0
        return (self.time - self.begin) / length if math.isfinite(length) else 0.0

    @property
    def rate(self) -> float:
        """Simulated seconds in a second."""
        return (self.time - self.begin) / self.wall_time if self.wall_time > 0.0 else 0.0

    def __str__(self) -> str:
        share = f" ({100 * self.fraction:.0f} %)" if math.isfinite(self.end) else ""
        return (
            f"t = {self.time:.4g} of {self.end:.4g} s{share}, {self.rate:.3g} s/s, "
            f"{self.events} events"
        )


class _Bar:
    """The bar of tqdm, on the terminal or in a notebook."""

    FORMAT = "{l_bar}{bar}| {n:.4g}/{total:.4g} s [{elapsed}<{remaining}, {rate_fmt}{postfix}]"
    ENDLESS = "t = {n:.4g} s [{elapsed}, {rate_fmt}{postfix}]"

    def __init__(self, now: Progress) -> None:
        from tqdm.auto import tqdm  # type: ignore[import-untyped,import-not-found,unused-ignore]

        length = now.end - now.begin
        self._begin = now.begin
        self._bar = tqdm(
            total=length if math.isfinite(length) else None,
            unit=" s",
            mininterval=0.0,
            bar_format=self.FORMAT if math.isfinite(length) else self.ENDLESS,
        )

    def show(self, now: Progress) -> None:
        self._bar.set_postfix_str(f"{now.events} events", refresh=False)
        self._bar.update(now.time - self._begin - self._bar.n)

    def close(self) -> None:
        self._bar.refresh()
        self._bar.close()


class _Line:
    """One line on stderr that is written anew."""

    def __init__(self, now: Progress) -> None:
        self._width = 0

    def show(self, now: Progress) -> None:
        text = str(now)
        sys.stderr.write(f"\r{text:<{self._width}}")
        sys.stderr.flush()
        self._width = len(text)

    def close(self) -> None:
        sys.stderr.write("\n")
        sys.stderr.flush()


class _Function:
    """The function of the user."""

    def __init__(self, function: Callable[[Progress], object]) -> None:
        self._function = function

    def show(self, now: Progress) -> None:
        self._function(now)

    def close(self) -> None:
        pass


def _display(now: Progress) -> _Bar | _Line:
    try:
        return _Bar(now)
    except ImportError:
        return _Line(now)


class Reporter:
    """Shows the progress of one stretch of a run after the other."""

    def __init__(self, wanted: bool | Callable[[Progress], object]) -> None:
        self._wanted = wanted
        self._display: Any = None

    def over(self, begin: float, end: float, events: int) -> Reporter:
        """A context manager for a stretch of the run from begin to end [s]."""
        self._begin, self._end, self._events = begin, end, events
        return self

    def __enter__(self) -> Reporter:
        self._started = time.perf_counter()
        now = self._now(self._begin, self._events)
        function = None if self._wanted is True else self._wanted
        self._display = _Function(function) if callable(function) else _display(now)
        return self

    def __call__(self, t: float, events: int) -> None:
        self._display.show(self._now(t, events))

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._display.close()
        self._display = None

    def _now(self, t: float, events: int) -> Progress:
        spent = time.perf_counter() - self._started
        return Progress(t, self._begin, self._end, events, spent)


def reporter_of(progress: object) -> Reporter | None:
    """The reporter that the option asks for, or None."""
    if progress is None or progress is False:
        return None
    if progress is True or callable(progress):
        return Reporter(progress)
    raise ModelError(f"option progress: expected True, False or a function, found {progress!r}")
