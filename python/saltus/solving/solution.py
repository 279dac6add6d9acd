"""`Solution`: results of `saltus.solve`, with the names SciPy gives them too."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from saltus.errors import ModelError
from saltus.results import Results
from saltus.results.record import FIRINGS, KINDS, KeptRun, Record
from saltus.system import System

__all__ = ["Solution"]

BLOCK = "solve"  # the name of the block that `solve` makes
WELL = {
    "reached_end": "the end of the span was reached",
    "terminal": "a terminal event ended the run",
    "zeno_stop": "events accumulated, and their guard says to stop there",
}


class Solution(Results):
    """`Results`, under the names of `scipy.integrate.solve_ivp` too.

    Attributes
    ----------
    t : ndarray, shape (rows,)
        [s] the same as `time`. Each event that changed something has two rows, one before and one
        after it, unless `t_eval` was given.
    y : ndarray, shape (n, rows)
        The same as ``outputs["x"].T``.
    t_events : list of ndarray, or None
        [s] for each guard of `events` when it fired.
    y_events : list of ndarray, or None
        For each guard the states before its events, shape (count, n); those after them are in
        `events`.
    sol : callable, or None
        With ``dense_output=True``: ``sol(t)`` is the state, shape (n,) or (n, len(t)).
    success : bool
        Whether the status is 'reached_end', 'terminal' or 'zeno_stop'.
    message : str
        How the run ended, in words.
    nfev, njev, nlu : int
        Calls of `f` and `jacobian`, and factorisations.
    system : LeafSystem
        The system of the run; `saltus.simulate` runs it too. None after loading from a file.

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
        names: Sequence[str] | None = None,
        system: System | None = None,
        fixed_jacobian: bool = False,
    ):
        super().__init__(core, raised, asks)
        self.system = system
        self._fixed_jacobian = fixed_jacobian  # a matrix, so that no Jacobian was computed
        self._names = None if names is None else list(names)
        self.message = self.message or WELL.get(self.status, "")

    @property
    def t(self) -> np.ndarray:
        """[s] The times of the rows."""
        return self.time

    @property
    def y(self) -> np.ndarray:
        """The states, shape (n, rows)."""
        return np.transpose(self.outputs["x"])

    @property
    def success(self) -> bool:
        """Whether the run came to its end."""
        return self.status in WELL

    @property
    def t_events(self) -> list[np.ndarray] | None:
        """[s] The times of each event, in the order of `events`; None without events."""
        if self._names is None:
            return None
        return [self._times(name) for name in self._names]

    @property
    def y_events(self) -> list[np.ndarray] | None:
        """The states at each event; None without events."""
        if self._names is None:
            return None
        n = self.outputs["x"].shape[1]
        return [
            np.array([e.before for e in self._fired(name)]).reshape(-1, n) for name in self._names
        ]

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
        return 0 if self._fixed_jacobian else self.statistics.jacobian_calls

    @property
    def nlu(self) -> int:
        """Factorisations of a matrix."""
        return self.statistics.linear_setups

    def _times(self, name: str) -> np.ndarray:
        return self.events.times(f"{BLOCK}.{name}")  # a guard's own name may look like a path

    def _fired(self, name: str) -> list[Any]:
        return [e for e in self.events if e.name == name and e.kind in FIRINGS]

    def _state_at(self, t: ArrayLike) -> np.ndarray:
        return np.moveaxis(self(t).continuous_state, -1, 0)

    def _kind(self) -> dict[str, Any]:
        return {
            "kind": "Solution",
            "guards": self._names,
            "fixed_jacobian": self._fixed_jacobian,
        }

    def __reduce__(self) -> tuple[Any, ...]:
        kept = KeptRun.of(self._core)
        return (
            Solution,
            (kept, None, None, self._names, None, self._fixed_jacobian),
            self._failure(),
        )


def _loaded(run: KeptRun, header: dict[str, Any]) -> Solution:
    names = header["guards"]
    if names is not None and not (
        isinstance(names, list) and all(isinstance(name, str) for name in names)
    ):
        raise ModelError(f"'guards' are {names!r}, expected names or null")
    if "x" not in run.outputs or run.outputs["x"].ndim != 2:
        raise ModelError("a solution has the state in the output 'x', a row for each time")
    return Solution(
        run, names=names, fixed_jacobian=bool(header.get("fixed_jacobian", False))
    )


KINDS["Solution"] = _loaded
