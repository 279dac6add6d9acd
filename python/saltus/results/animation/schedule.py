"""The schedule of a film: which time, and which side of an event, each frame shows.

The place of a time t in the film is tau(t) = integral of ds / (speed * slow(s)) from the begin of
the run to t. Frame k is shown at k / fps seconds of the film.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from saltus.errors import ModelError
from saltus.results.events import EventLog

__all__ = ["MOST", "Schedule", "schedule_of", "slow_spans"]

MOST = 20_000
"""frames; a film of eleven minutes, and more than a page or a GIF can hold"""
LATE = 1e-9  # [frames] the rounding of tau, so that a film of exactly n frames has n frames


@dataclass(frozen=True)
class Schedule:
    """The frames of a film."""

    times: np.ndarray
    """[s] of the run, for each frame; never decreases"""
    left: np.ndarray
    """whether the frame shows the values before the event of its time, x-"""
    events: tuple[float, ...]
    """[s] the events with a frame for x- and a frame for x+"""
    crowded: int
    """the number of instants without frames of their own: others were closer than two frames"""

    def __len__(self) -> int:
        return len(self.times)


def slow_spans(
    log: EventLog, slow_motion: Mapping[str, float], window: float
) -> list[tuple[float, float, float]]:
    """(begin, end, factor) of the times around events that the film shows slowly."""
    spans = []
    for name, factor in slow_motion.items():
        if not (_is_number(factor) and 0.0 < factor <= 1.0):
            raise ModelError(
                f"animate: slow_motion[{name!r}]: expected a factor above 0 and up to 1, by which "
                f"the film is slower there, found {factor!r}"
            )
        spans += [(t - window, t + window, float(factor)) for t in log.times(name)]
    return spans


def schedule_of(
    span: tuple[float, float],
    instants: np.ndarray,
    speed: float,
    fps: float,
    slow: list[tuple[float, float, float]],
) -> Schedule:
    """The frames for a run over `span` with events at `instants` [s], in order."""
    knots, places = _warp(span, speed, slow)
    count = int(np.floor(places[-1] * fps + LATE)) + 1
    if count > MOST:
        raise ModelError(
            f"animate: {count} frames for {span[1] - span[0]:g} s at speed {speed:g} and {fps:g} "
            f"frames a second; expected at most {MOST}. Give a higher speed or fewer fps"
        )
    count = max(count, 2 if len(instants) else 1)  # an event needs two
    times = np.interp(np.arange(count) / fps, places, knots)
    times[-1] = span[1] if count > 1 else span[0]
    return _with_instants(times, instants, np.interp(instants, knots, places) * fps)


def _warp(
    span: tuple[float, float], speed: float, slow: list[tuple[float, float, float]]
) -> tuple[np.ndarray, np.ndarray]:
    """Times of the run and their places in the film [s], linear between them."""
    edges = [edge for begin, end, _ in slow for edge in (begin, end)]
    knots = np.unique(np.clip([*span, *edges], *span))
    middles = 0.5 * (knots[1:] + knots[:-1])
    factors = np.ones(len(middles))
    for begin, end, factor in slow:  # where two overlap, the slower one
        within = slice(*np.searchsorted(middles, [begin, end]))
        factors[within] = np.minimum(factors[within], factor)
    places = np.concatenate([[0.0], np.cumsum(np.diff(knots) / (speed * factors))])
    return knots, places


def _with_instants(times: np.ndarray, instants: np.ndarray, places: np.ndarray) -> Schedule:
    """Moves the frame before each instant to its x-, and the frame after it to its x+.

    No frame is added, so the film keeps its clock: each frame is at most one frame off, or two
    after the first, which always shows the start. Instants within one frame share its two: x- of
    the first, x+ of the last. Of instants closer than two frames the first has frames of its own.
    """
    times, left = times.copy(), np.zeros(len(times), dtype=bool)
    shown: list[float] = []
    frames = np.floor(places + LATE).astype(int)
    frames[instants > times[0]] = np.maximum(frames[instants > times[0]], 1)  # 0 shows the start
    frames = np.clip(frames, 0, max(len(times) - 2, 0))
    free, crowded = 0, 0
    for frame in np.unique(frames):
        here = instants[frames == frame]
        if frame < free:
            crowded += len(here)
            continue
        times[frame], left[frame], times[frame + 1] = here[0], True, here[-1]
        shown += [float(here[0])] if here[0] == here[-1] else [float(here[0]), float(here[-1])]
        crowded += max(len(here) - 2, 0)
        free = frame + 2
    return Schedule(times, left, tuple(shown), crowded)


def _is_number(value: object) -> bool:
    return isinstance(value, (int, float, np.number)) and not isinstance(value, bool)
