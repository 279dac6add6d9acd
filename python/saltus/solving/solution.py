"""`Solution`: results of `saltus.solve`, with the names SciPy gives them too."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from saltus.errors import ModelError
from saltus.results import Results
from saltus.results.elsewhere import INSTEAD
from saltus.results.record import FIRINGS, KINDS, KeptRun, Record
from saltus.results.saving import save
from saltus.solving.form import PLAIN, Form
from saltus.solving.formed import formed
from saltus.system import System

__all__ = ["BLOCK", "Known", "Solution"]

BLOCK = "solve"  # the name of the block that `solve` makes
WELL = {
    "reached_end": "the end of the span was reached",
    "terminal": "a terminal event ended the run",
    "zeno_stop": "events accumulated, and their guard says to stop there",
}


@dataclass(frozen=True)
class Known:
    """The record that a solution keeps of the call of `solve` that made it."""

    names: list[str] | None = None
    """of the events; None if there is no argument `events`"""
    form: Form = PLAIN
    constant_jacobian: bool = False


UNKNOWN = Known()


OF_SOLUTION = {
    **dict.fromkeys(("ts", "times"), "the times of the rows are solution.t"),
    **dict.fromkeys(("x", "xs", "ys", "state", "states"), "the states are solution.y"),
}
"""names that are tried -> where it is here"""


class Solution(Results):
    """`Results` that have the names of `scipy.integrate.solve_ivp` too.

    Attributes
    ----------
    t : ndarray, shape (rows,)
        [s] the same as `time`. Each event that changed something has two rows, one before and one
        after it, unless `t_eval` was given.
    y : ndarray, shape (n, rows)
        The same as ``outputs["x"].T``.
    t_events : list of ndarray, or None
        [s] For each guard of `events` the times at which it fired, or for a guard with a delay those
        of its effects.
    y_events : list of ndarray, or None
        For each guard the states before its events, shape (count, n), or (0,) as SciPy has it if
        there is none; the states after them are in `events`.
    sol : callable, or None
        With ``dense_output=True``: ``sol(t)`` is the state, shape (n,) or (n, len(t)).
    success : bool
        Whether the status is 'reached_end', 'terminal' or 'zeno_stop'.
    message : str
        How the run ended, in words.
    nfev, njev, nlu : int
        The numbers of calls of `f`, of computed Jacobians (0 if a constant Jacobian was given), and
        of factorisations.
    system : LeafSystem
        The system of the run; `saltus.simulate` runs it too. None after loading from a file. It
        and `context` have the engine's form: times s = -t for a run back in time, and the real and
        imaginary parts of complex states.

    Examples
    --------
    >>> import saltus
    >>> solution = saltus.solve(lambda t, x: -x, (0, 1), [1.0])
    >>> solution.success, solution.y.shape == (1, len(solution.t))
    (True, True)
    """

    def __init__(
        self,
        core: Record,
        raised: BaseException | None = None,
        asks: Any = None,
        known: Known = UNKNOWN,
        system: System | None = None,
        fixed_jacobian: bool = False,
    ):
        self._known = known
        self._engine = core
        super().__init__(formed(core, known.form), raised, asks)
        self.system = system

    def _elsewhere(self) -> dict[str, str]:
        return INSTEAD | OF_SOLUTION

    @cached_property
    def message(self) -> str:
        """How the run ended, in words."""
        return self._core.message or WELL.get(self.status, "")

    @property
    def t(self) -> np.ndarray:
        """[s] The times of the rows."""
        return self.time

    @property
    def y(self) -> np.ndarray:
        """The states, shape (n, rows)."""
        return np.transpose(self.outputs["x"])

    @property
    def _ended_at(self) -> float:
        """[s] The time of the end, also where nothing was recorded."""
        t: float = self._known.form.time(self.context.time)
        return t

    @property
    def success(self) -> bool:
        """Whether the run came to its end."""
        return self.status in WELL

    @property
    def t_events(self) -> list[np.ndarray] | None:
        """[s] The times of each event, in the order of `events`; None without events."""
        if self._known.names is None:
            return None
        return [self._times(name) for name in self._known.names]

    @property
    def y_events(self) -> list[np.ndarray] | None:
        """The states at each event; None without events."""
        if self._known.names is None:
            return None
        return [np.array([e.before for e in self._fired(name)]) for name in self._known.names]

    @property
    def sol(self) -> Callable[[ArrayLike], np.ndarray] | None:
        """The dense output, a function of t; None if it was not kept."""
        return self._state_at if self.dense else None

    @property
    def nfev(self) -> int:
        """Calls of the right-hand side."""
        return self.statistics.right_hand_side_calls

    @property
    def njev(self) -> int:
        """Jacobians computed; 0 if `jacobian` was a matrix."""
        return 0 if self._known.constant_jacobian else self.statistics.jacobian_calls

    @property
    def nlu(self) -> int:
        """Factorisations of a matrix."""
        return self.statistics.linear_setups

    def _times(self, name: str) -> np.ndarray:
        form = self._known.form
        times = self.events.times(f"{BLOCK}.{name}")  # the name of a guard may look like a path
        in_order: np.ndarray = form.time(np.sort(form.time(times)))
        return in_order

    def _fired(self, name: str) -> list[Any]:
        return [e for e in self.events if e.name == name and e.kind in FIRINGS]

    def _state_at(self, t: ArrayLike) -> np.ndarray:
        begin, end = self.span
        if begin == end:  # the constant state of a run of no length
            t = np.full(np.shape(t), begin)
        return np.moveaxis(self(t).continuous_state, -1, 0)

    def save(self, path: str | PathLike[str]) -> None:
        save(KeptRun.of(self._engine), path, self._kind())

    save.__doc__ = Results.save.__doc__

    def _kind(self) -> dict[str, Any]:
        known = self._known
        return {
            "kind": "Solution",
            "guards": known.names,
            "backward": known.form.backward,
            "complex": known.form.is_complex,
            "constant_jacobian": known.constant_jacobian,
        }

    def __reduce__(self) -> tuple[Any, ...]:
        kept = KeptRun.of(self._engine)
        return Solution, (kept, None, None, self._known), self._failure()


def _loaded(run: KeptRun, header: dict[str, Any]) -> Solution:
    """The solution in a file. A file of an earlier version does not contain its form."""
    names = header["guards"]
    if names is not None and not (
        isinstance(names, list) and all(isinstance(name, str) for name in names)
    ):
        raise ModelError(f"'guards' are {names!r}, expected names or null")
    if "x" not in run.outputs or run.outputs["x"].ndim != 2:
        raise ModelError("a solution has the state in the output 'x', a row for each time")
    form = Form(bool(header.get("backward")), bool(header.get("complex")))
    return Solution(run, known=Known(names, form, bool(header.get("constant_jacobian"))))


KINDS["Solution"] = _loaded
