"""`first_arc`, which finds discrete states that keep the time of an event.

Such an entry z never returns, but the time since the event, t - z, may. It is known by what it
does, not by a declaration: at the end of an arc it has the time of an event of this arc, and where
the same arc begins `a` seconds later, with these entries `a` larger, it ends `a` larger.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from saltus.orbits.arc import Arc
from saltus.orbits.closing import Closing

__all__ = ["first_arc"]

SAME = 1e-6
"""the part of the shift by which the ends of two runs may differ: far above the errors of event
times, and far below the shift
"""


def first_arc(closing: Closing, parameters: Sequence[str] = ()) -> Arc:
    """The arc from the present start, with the states of `closing` that keep a time known."""
    arc = closing.at(closing.unknowns, parameters)
    stamps = _stamps(closing, arc)
    if np.array_equal(stamps, closing.stamps):
        return arc
    closing.take_stamps(stamps)
    return closing.at(closing.unknowns, parameters)


def _stamps(closing: Closing, arc: Arc) -> np.ndarray:
    """(n,) which states keep the time of an event.

    An entry that ends with one value at both times is none: a count may have the value of a time.
    """
    none = np.zeros(len(closing.states), dtype=bool)
    stamps = none | _times_of_events(closing, arc)
    if stamps.any():
        stamps &= _moved(closing, arc, none) != 0.0
    while stamps.any():
        kept = stamps & (np.abs(_moved(closing, arc, stamps) - 1.0) <= SAME)
        if np.array_equal(kept, stamps):
            break
        stamps = kept
    return np.asarray(stamps)


def _times_of_events(closing: Closing, arc: Arc) -> np.ndarray:
    found = np.isin(closing.states.of(arc.final), [event.time for event in arc.results.events])
    found[: len(closing.states.continuous)] = False
    return np.asarray(found)


def _moved(closing: Closing, arc: Arc, stamps: np.ndarray) -> np.ndarray:
    """(n,) how far the ends move with the start, as part of its shift in time; nan if the run
    fails: a time that did not move with the start may lead anywhere.
    """
    try:
        other = closing.again(arc, stamps)
    except Exception:
        return np.full(len(stamps), np.nan)
    ends = [closing.states.of(each.final) for each in (arc, other)]
    return np.asarray((ends[1] - ends[0]) / (other.begin.time - arc.begin.time))
