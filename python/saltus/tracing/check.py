"""The check: tape and function are compared at random points before the tape is trusted."""

from __future__ import annotations

import functools
import itertools
import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from saltus.tracing.arguments import Point, Result, call, plain_arguments, plain_numbers
from saltus.tracing.refusal import Refusal
from saltus.tracing.rounding import ULPS, Bounds
from saltus.tracing.signature import Shape, Signature

__all__ = ["Check"]

Numbers = NDArray[np.float64]

SCALES = (0.0, 1e-3, 0.03, 0.3, 1.0, 1.0, 1.0, 3.0, 10.0, 100.0, 1e-6, 1e4)
"""how far from the start values, absolutely and relatively, the points lie"""
TIMES = (0.0, 0.013, 0.7, 1.0, 1.9, 2.5, 0.31, 5.3, 12.0, 97.0, 0.11, 1003.0)
FEWEST = 3  # points where the function gives finite numbers
QUICK = 2.0 * ULPS


@functools.lru_cache(maxsize=64)
def _draws(count: int) -> Numbers:
    """`count` numbers between -2 and 2 for each point, the same in every process."""
    draws = np.random.default_rng(20_405).uniform(-2.0, 2.0, (len(SCALES), count))
    draws.flags.writeable = False
    return draws


def _near(start: Numbers, draws: Numbers) -> Numbers:
    """A row of values for each point."""
    scales = np.array(SCALES)[:, None]
    return start + scales * draws * np.where(scales < 1.0, np.maximum(1.0, np.abs(start)), 1.0)


def points(signature: Signature, reads_mode: bool) -> list[Point]:
    """Values near the start values of the block and far from them, of both signs."""
    x, z, p = signature.start("x"), signature.start("z"), signature.parameter_values()
    widths = [math.prod(shape) for shape in signature.input_shapes]
    draws = _draws(x.size + z.size + p.size + sum(widths))
    ends = list(itertools.accumulate([x.size, z.size, p.size, *widths], initial=0))
    dx, dz, dp, *du = (draws[:, i:j] for i, j in itertools.pairwise(ends))
    scales = np.array(SCALES)[:, None]
    xs, zs = _near(x, dx), _near(z, dz)
    # parameters often have a sign and a size that matter
    ps = p * (1.0 + np.minimum(scales, 0.3) * dp)
    us = [np.where(scales == 0.0, 1.0, scales) * part for part in du]
    modes = (signature.mode, *signature.modes) if reads_mode else (signature.mode,)
    return [
        Point(t, xs[i], zs[i], modes[i % len(modes)], i % 3, ps[i], [u[i] for u in us])
        for i, t in enumerate(TIMES)
    ]


def _called(signature: Signature, function: Callable[..., Any], at: Point) -> Any:
    """The result of the function itself, or None if it raises."""
    arguments, options = plain_arguments(signature, at)
    try:
        returned = call(signature, function, arguments, options, _unwritten)
        numbers, written = plain_numbers(signature, returned)
    except Exception:
        return None
    return (numbers, written)


def _unwritten(shape: Shape) -> Numbers:
    return np.full(shape, np.nan)


def _describe(at: Point, called: float, taped: float, i: int) -> str:
    return (
        f"the check failed: at t = {at.time:g}, x = {at.x.tolist()} entry {i} of the result is "
        f"{called!r} called and {taped!r} traced"
    )


class Check:
    """The comparison of a tape with its function."""

    def __init__(self, tape: Any, result: Result, bounds: Any):
        self.tape = tape
        self.result = result
        self.bounds = bounds
        """points -> Bounds"""

    def run(self, signature: Signature, few: bool = False) -> int:
        """Raise a Refusal if the tape and the function differ around the start values; return the
        number of points at which they were compared. With `few` a third of the points is used, if
        that is enough.
        """
        at = points(signature, "mode" in self.tape.reads)
        if few and (compared := self._compared(signature, at[::3])) >= FEWEST:
            return compared
        finite = self._compared(signature, at)
        if finite < FEWEST:
            raise Refusal(
                f"could be compared at {finite} of {len(at)} points only, as the function raises "
                "or is not finite at the others; start the block where it is defined"
            )
        return finite

    def _compared(self, signature: Signature, at: list[Point]) -> int:
        """The number of points at which both are finite, and equal."""
        function = signature.function
        if signature.owner is not None:
            function = functools.partial(function, signature.owner)
        kept, called, taped = [], [], []
        for point in at:
            found = _called(signature, function, point)
            if found is None:
                continue
            numbers, written = found
            self._require_same_form(numbers, written)
            kept.append(point)
            called.append(numbers)
            taped.append(self.tape(*point.as_tape_takes()))
        if not kept:
            return 0
        self._compare(kept, np.array(called), np.array(taped))
        return int(np.isfinite(called).all(axis=1).sum())

    def _require_same_form(self, numbers: Numbers, written: str) -> None:
        if numbers.size != len(self.result.numbers) or written != self.result.written:
            raise Refusal(
                f"returned {len(self.result.numbers)} numbers traced and {numbers.size} called; "
                "its result must not depend on types or on global state"
            )

    def _compare(self, at: list[Point], called: Numbers, taped: Numbers) -> None:
        apart = np.abs(called - taped)
        largest = np.maximum(np.abs(called), np.abs(taped))
        same = (called == taped) | (apart <= QUICK * largest) | np.isnan(called)
        columns = np.flatnonzero(~same.all(axis=0))
        if columns.size == 0:
            return
        bounds: Bounds = self.bounds(at)
        for column in columns:
            _, bound = bounds.of(self.result.numbers[column])
            for row in np.flatnonzero(~same[:, column]):
                values = float(called[row, column]), float(taped[row, column])
                self._require_rounding(at[row], int(column), *values, float(bound[row]))

    @staticmethod
    def _require_rounding(at: Point, column: int, called: float, taped: float, bound: Any) -> None:
        room = 2.0 * bound  # each of the two has this error
        if not np.isfinite(room) or (np.isfinite(taped) and abs(called - taped) <= room):
            return  # where rounding decides between branches, the point says nothing
        raise Refusal(_describe(at, called, taped, column))
