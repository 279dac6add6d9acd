"""The event log: every event of a run, as a table."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, overload

import numpy as np

from saltus import _core
from saltus._porting import missing
from saltus.errors import ModelError
from saltus.results.record import FIRINGS, same
from saltus.results.tables import extra

if TYPE_CHECKING:
    import pandas  # type: ignore[import-untyped,import-not-found,unused-ignore]

    from saltus.results.record import Record

__all__ = ["Event", "EventLog"]

SHOWN = 20
QUEUED = ("scheduled", "cancelled", "executed")
KINDS = ["zero_crossing", "time", "zeno_enter", "zeno_release", "terminal", *QUEUED]


OF_EVENT = {
    "t": "it is event.time",
    **dict.fromkeys(("x", "y", "state", "states"), "it is event.before and event.after"),
}
OF_LOG = {
    **dict.fromkeys(("t", "time"), "the times are events.times('name')"),
    **dict.fromkeys(("name", "names", "kind"), "each event has its own: events[0].name"),
    **dict.fromkeys(("df", "to_dataframe"), "it is events.to_pandas()"),
}
"""names that are tried -> where it is here"""


class Event(NamedTuple):
    """One event of a run. Two events are equal if all their values are; nan is equal to nan here.

    Examples
    --------
    >>> import saltus
    >>> event = saltus.scene("bouncing-ball").simulate().events[0]
    >>> bool(event.before[1] < 0 < event.after[1])
    True
    """

    time: float
    """[s]"""
    jump: int
    """the number of passes with a change up to the event; it orders events of one time"""
    kind: str
    """'zero_crossing', 'time', 'zeno_enter', 'zeno_release' or 'terminal'; of a queued zero
    crossing 'scheduled', 'cancelled' or 'executed'
    """
    direction: int
    """+1: its guard was rising, -1: falling, 0: no guard"""
    block: str
    """path of its block"""
    name: str
    """the declared name"""
    predicted: float
    """[s] for 'zeno_enter' the time at which infinitely many resets would have happened; for a
    queued zero crossing the time at which its execution is due; otherwise nan
    """
    before: np.ndarray
    """continuous state of the block before it"""
    after: np.ndarray
    """and after it"""
    entry: int
    """the index of the guard that fired in a vector of guards; 0 for a single guard"""
    rests: tuple[int, ...] = ()
    """the entries of the block's continuous state that rest from a 'zeno_enter' on"""

    @property
    def due(self) -> float:
        """[s] When the execution of a queued zero crossing is due; nan for any other event."""
        return self.predicted if self.kind in QUEUED else float("nan")

    def __eq__(self, other: object) -> bool:
        return isinstance(other, tuple) and same(tuple(self), tuple(other))

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __hash__(self) -> int:
        return hash((self.jump, self.kind, self.block, self.name, self.entry))


if not TYPE_CHECKING:  # a type checker knows the names that are there; a NamedTuple has no "if"
    Event.__getattr__ = lambda self, name: missing(self, name, OF_EVENT)


class EventLog(Sequence[Event]):
    """Every event of a run, in order: a sequence of `Event`. A slice of it is a log again. Two logs
    are equal if their events are.

    Examples
    --------
    >>> import saltus
    >>> results = saltus.scene("bouncing-ball").simulate()
    >>> first = results.events[0]
    >>> first.kind, first.name
    ('zero_crossing', 'bounce')
    >>> len(results.events[:3])
    3
    """

    def __init__(self, record: Record, rows: range | None = None):
        self._record = record
        self._rows = range(record.event_count) if rows is None else rows

    def __len__(self) -> int:
        return len(self._rows)

    @overload
    def __getitem__(self, index: int) -> Event: ...
    @overload
    def __getitem__(self, index: slice) -> EventLog: ...
    def __getitem__(self, index: int | slice) -> Event | EventLog:
        if isinstance(index, slice):
            return EventLog(self._record, self._rows[index])
        if not -len(self) <= index < len(self):
            raise IndexError(f"event {index} of {len(self)}")
        return Event(*self._record.event(self._rows[index]))

    def __iter__(self) -> Iterator[Event]:
        return (Event(*self._record.event(row)) for row in self._rows)

    if not TYPE_CHECKING:  # a type checker knows the names that are there

        def __getattr__(self, name: str) -> Any:
            return missing(self, name, OF_LOG)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, EventLog) and same(tuple(self), tuple(other))

    def __hash__(self) -> int:
        return hash(tuple(self[:1]))

    def times(self, name: str | None = None, kind: str | None = None) -> np.ndarray:
        """The times of the events of one name and kind.

        Parameters
        ----------
        name : str
            The name of the event, with or without that of its block: 'bounce' or 'ball.bounce'; all
            events if it is left out. A name that is the path of an event means this event.
        kind : str, optional
            'zero_crossing', 'time', 'zeno_enter', 'zeno_release', 'terminal', 'scheduled',
            'cancelled' or 'executed'; by default the four kinds in which an event had its effect: a
            zero crossing, the event that ended the run, a time event, an execution.

        Returns
        -------
        ndarray
            [s] increasing; empty if there was none.

        Raises
        ------
        ModelError
            If the kind does not exist, or if no event of the system has the name; the message has
            the nearest name.

        Examples
        --------
        >>> import saltus
        >>> results = saltus.scene("bouncing-ball").simulate()
        >>> results.events.times("bounce").size > 0
        True
        """
        if kind is not None and kind not in KINDS:
            raise ModelError(f"unknown kind of event {kind!r}{_core.known_names(str(kind), KINDS)}")
        kinds = FIRINGS if kind is None else (kind,)
        if name is None:
            return np.array([e.time for e in self if e.kind in kinds])
        if not isinstance(name, str):
            raise TypeError(f"expected the name of an event, such as 'ball.bounce', found {name!r}")
        times = self._record.event_times(name, kind)  # refuses an unknown name
        if self._rows == range(self._record.event_count):
            return times
        path = name in self._record.event_names
        return np.array(
            [e.time for e in self if e.kind in kinds and name == (_path(e) if path else e.name)]
        )

    def dt_dp(self, name: str | None = None, kind: str | None = None) -> np.ndarray:
        """The derivative of each event time by the parameters of the option `sensitivity`.

        Parameters
        ----------
        name : str
            As in `times`.
        kind : str, optional
            As in `times`. Of 'zeno_enter' it is the derivative of `predicted`, the time at which
            infinitely many resets would have happened.

        Returns
        -------
        ndarray
            [s per unit of the parameter] A row for each event, a column for each parameter; nan
            where the derivative does not exist, see `Results.sensitivity_gaps`.

        Raises
        ------
        ModelError
            For a run without the option `sensitivity`, and as `times` does.

        Examples
        --------
        >>> import saltus
        >>> results = saltus.scene("bouncing-ball").simulate(sensitivity=["e"])
        >>> results.events.dt_dp("bounce").shape == (results.events.times("bounce").size, 1)
        True
        """
        wanted = self.times(name, kind)  # refuses an unknown name or kind
        found = self._record.sensitivities
        if found is None:
            raise ModelError(
                "dt_dp: this run has no derivatives; ask for them with sensitivity=['e', ...]"
            )
        kinds = FIRINGS if kind is None else (kind,)
        path = name in self._record.event_names
        chosen = [
            row
            for row, e in zip(self._rows, self, strict=True)
            if e.kind in kinds and (name is None or name == (_path(e) if path else e.name))
        ]
        assert len(chosen) == len(wanted)
        return np.array(found["predicted" if kind == "zeno_enter" else "event_times"][chosen])

    def to_pandas(self) -> pandas.DataFrame:
        """A row for each event, a column for each field of `Event`. Needs pandas.

        Examples
        --------
        >>> import saltus
        >>> frame = saltus.scene("bouncing-ball").simulate().events.to_pandas()
        >>> frame.columns[:3].tolist()
        ['time', 'jump', 'kind']
        """
        pandas = extra("pandas", "to_pandas")

        return pandas.DataFrame(list(self), columns=list(Event._fields))

    def __repr__(self) -> str:
        lines = [f"  {t:<22} {j:>5}  {k:<13}  {n}" for t, j, k, n in map(_cells, self[:SHOWN])]
        head = [f"  {'time [s]':<22} {'jump':>5}  {'kind':<13}  event"] if lines else []
        more = [f"  ... and {len(self) - SHOWN} more"] if len(self) > SHOWN else []
        return "\n".join([f"{len(self)} event{'s' * (len(self) != 1)}", *head, *lines, *more])

    def _repr_html_(self) -> str:
        titles = ("time [s]", "jump", "kind", "event", "before → after")
        head = "".join(f"<th>{title}</th>" for title in titles)
        rows = "".join(_html_row((*_cells(e), _change(e))) for e in self[:SHOWN])
        more = f"<p>... and {len(self) - SHOWN} more</p>" if len(self) > SHOWN else ""
        title = f"<p><b>{len(self)} events</b></p>"
        return f"{title}<table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>{more}"


def _html_row(cells: tuple[str, ...]) -> str:
    import html  # which few scripts need

    return "<tr>" + "".join(f"<td>{html.escape(cell)}</td>" for cell in cells) + "</tr>"


def _path(event: Event) -> str:
    return f"{event.block}.{event.name}"


def _cells(event: Event) -> tuple[str, str, str, str]:
    return f"{event.time:.17g}", str(event.jump), event.kind, _path(event)


def _change(event: Event) -> str:
    def short(x: np.ndarray) -> str:
        return np.array2string(x, precision=4, threshold=6)

    return f"{short(event.before)} → {short(event.after)}"
