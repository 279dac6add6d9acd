"""The one caller that a simulator has at a time."""

from __future__ import annotations

import threading
from types import TracebackType

from saltus import _core
from saltus.errors import Error

__all__ = ["Turn"]


class Turn:
    """`with turn.of(call, run):` has the run for itself; another call meanwhile is an `Error`."""

    __slots__ = ("_lock", "_user")

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._user = 0  # the thread that has the turn

    def of(self, call: str, run: _core.Simulator) -> Turn:
        """Takes the turn, which the end of the `with` block gives back."""
        if not self._lock.acquire(blocking=False):
            self._refuse(call, run)
        self._user = threading.get_ident()
        return self

    def __enter__(self) -> None:
        pass

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._lock.release()

    def require_idle(self, call: str, run: _core.Simulator) -> None:
        """Refuses a call that reads values which a call under way changes."""
        if self._lock.locked():
            self._refuse(call, run)

    def _refuse(self, call: str, run: _core.Simulator) -> None:
        own = self._user == threading.get_ident()
        who = "by a callback of the run itself" if own else "while another thread uses it"
        raise Error(
            f"t = {run.time} s: {call} of a simulator was called {who}; expected one call at a "
            "time: use a simulator of its own for each caller"
        )
