"""`Formed`: the record of a run with the times and the states of the user."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from saltus import _core
from saltus.errors import ModelError
from saltus.results.record import Columns, Record
from saltus.solving.form import Form

__all__ = ["formed"]


def formed(record: Record, form: Form) -> Record:
    """The record of a run in that form, as its user sees it."""
    return record if form.plain else Formed(record, form)


class Formed:
    """A record whose run goes back in time, or whose state is complex. Its context is that of the
    engine.
    """

    def __init__(self, record: Record, form: Form):
        self._record = record
        self._form = form
        self.dense: bool = record.dense
        # The functions of a user are one leaf, so there is one island.
        self.apart = False
        self.islands: list[tuple[Any, ...]] = []

    @property
    def time(self) -> np.ndarray:
        time: np.ndarray = self._form.time(self._record.time)
        return time

    @property
    def jump(self) -> np.ndarray:
        return self._record.jump

    @property
    def outputs(self) -> Columns:
        return self._states(self._record.outputs)

    @property
    def context(self) -> _core.Context:
        return self._record.context

    @property
    def status(self) -> str:
        return self._record.status

    @property
    def block(self) -> str:
        return self._record.block

    @property
    def sensitivities(self) -> dict[str, Any] | None:
        if self._record.sensitivities is None:
            return None
        raise ModelError(
            "sensitivity: a run back in time, or with complex states, has no derivatives; use a "
            "run forwards with real states"
        )

    @property
    def event_count(self) -> int:
        return self._record.event_count

    @property
    def event_names(self) -> list[str]:
        return self._record.event_names

    @property
    def message(self) -> str:
        """The engine's message counts s."""
        message = self._record.message
        if not (self._form.backward and message):
            return message
        t = self._form.time(self._record.context.time)
        return f"t = {t} s, on the way back (below, t is -1 times that): {message}"

    @property
    def statistics(self) -> dict[str, Any]:
        counts = dict(self._record.statistics)
        counts["stretches"] = [
            (method, self._form.time(begin), self._form.time(end), steps)
            for method, begin, end, steps in counts["stretches"]
        ]
        return counts

    @property
    def span(self) -> tuple[float, float]:
        begin, end = self._record.span
        return self._form.time(begin), self._form.time(end)

    @property
    def joints(self) -> np.ndarray:
        joints: np.ndarray = self._form.time(self._record.joints)
        return joints

    def event(self, index: int, /) -> tuple[Any, ...]:
        t, jump, kind, direction, block, name, predicted, before, after, *rest = self._record.event(
            index
        )
        change = self._form.state(before), self._form.state(after)
        t, predicted = self._form.time(t), self._form.time(predicted)
        return t, jump, kind, direction, block, name, predicted, *change, *rest

    def event_times(self, name: str, kind: str | None, /) -> np.ndarray:
        times: np.ndarray = self._form.time(self._record.event_times(name, kind))
        return times

    def at(self, times: Sequence[float], left: bool, /) -> tuple[np.ndarray, Columns]:
        state, outputs = self._record.at([self._form.time(t) for t in times], left)
        return self._form.state(state), self._states(outputs)

    def sensitivities_at(self, times: Sequence[float], left: bool, /) -> tuple[np.ndarray, Columns]:
        return self._record.sensitivities_at(times, left)  # `sensitivities` raised before

    def _states(self, columns: Columns) -> Columns:
        return {name: self._form.state(column) for name, column in columns.items()}
