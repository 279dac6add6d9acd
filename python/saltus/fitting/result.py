"""`FitResult`: fitted parameters, and how well the data determine them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from saltus import _core
from saltus.errors import ModelError
from saltus.fitting.plot import plot
from saltus.fitting.text import as_html, as_text
from saltus.results import Results
from saltus.results.record import same
from saltus.results.tables import extra

if TYPE_CHECKING:
    import pandas  # type: ignore[import-untyped,import-not-found,unused-ignore]

__all__ = ["Compared", "FitResult", "Start"]


class Compared(NamedTuple):
    """The data of one name in one experiment, beside the values of the fitted run."""

    experiment: str
    name: str
    entry: np.ndarray
    """the entry of the signal, or the number of the event, of each value"""
    is_event: bool
    time: np.ndarray
    """[s]"""
    data: np.ndarray
    model: np.ndarray
    residual: np.ndarray
    """(model - data) / sigma"""

    def __eq__(self, other: object) -> bool:
        return isinstance(other, tuple) and same(tuple(self), tuple(other))

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __hash__(self) -> int:
        return hash((self.experiment, self.name))


class Start(NamedTuple):
    """The outcome of one start of a fit."""

    start: dict[str, float]
    """the parameters at which it began, by name"""
    parameters: dict[str, float]
    """those at which it ended"""
    cost: float
    status: str
    message: str
    evaluations: int


@dataclass(frozen=True, eq=False, repr=False)
class FitResult:
    """What `saltus.fit` found.

    Examples
    --------
    >>> ball = saltus.scene("bouncing-ball")
    >>> impacts = {"bounce": saltus.EventTimes([1.428, 3.998, 6.311])}
    >>> found = saltus.fit(ball.system, impacts, {"e": (0.1, 1.0)}, context=ball.context)
    >>> found.success, round(found.parameters["e"], 3)
    (True, 0.9)
    """

    parameters: dict[str, float]
    """the fitted values, by name"""
    covariance: np.ndarray
    """of the parameters, in their order; a parameter that the data do not determine has the
    variance inf, and nan beside it
    """
    residuals: np.ndarray
    """(model - data) / sigma, in the order of `compared`"""
    jacobian: np.ndarray
    """the derivatives of the residuals by the parameters: (data, parameters)"""
    cost: float
    """half the sum of the squares of the residuals, or of their losses"""
    status: str
    """'converged', 'max_nfev' (it may be run on), 'stalled' (no shorter step helped, and the
    gradient is not zero: the cost jumps there) or 'interrupted'
    """
    message: str
    """the reason for the status"""
    warnings: tuple[str, ...]
    """what to know before the values are used; empty if all is well"""
    runs: tuple[Results, ...]
    """the run of each experiment with the fitted values, with its steps, events and dense output"""
    contexts: tuple[_core.Context, ...]
    """the values at the begin of these runs"""
    compared: tuple[Compared, ...]
    """data and model, for each signal and event of each experiment"""
    missing: int
    """the number of data that were nan, and so did not count"""
    evaluations: int
    """points at which all experiments were run, in all starts; those of differences do not count"""
    failures: int
    """evaluations that failed, and shortened a step"""
    first_failure: str
    """the message of the first of them"""
    starts: tuple[Start, ...]
    """every start; the fit is the best of them"""
    wall_time: float
    """[s]"""
    _coordinates: Any
    _quantile: Any
    _covariance_inner: np.ndarray

    @property
    def success(self) -> bool:
        """Whether the fit has converged."""
        return self.status == "converged"

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the parameters, in the order of `covariance` and `jacobian`."""
        return tuple(self.parameters)

    @cached_property
    def values(self) -> np.ndarray:
        """The fitted values in the order of `names`."""
        return np.array(list(self.parameters.values()))

    @cached_property
    def standard_errors(self) -> dict[str, float]:
        """The standard error of each parameter, by name; inf if the data do not determine it."""
        errors = np.sqrt(np.diag(self.covariance))
        return dict(zip(self.names, errors.tolist(), strict=True))

    @cached_property
    def correlation(self) -> np.ndarray:
        """The correlation of the parameters, in their order; nan where there is none."""
        errors = np.array(list(self.standard_errors.values()))
        with np.errstate(invalid="ignore", divide="ignore"):
            found: np.ndarray = self.covariance / np.outer(errors, errors)
        return found

    def confidence(self, level: float = 0.95) -> dict[str, tuple[float, float]]:
        """The confidence interval of each parameter, by name: value ± t · standard error.

        t is the quantile of Student's distribution with n - p degrees of freedom, or with
        ``absolute_sigma=True`` that of the normal distribution. With ``log=True`` the interval is
        that of the logarithm. It belongs to the linearised model: bounds do not enter it.

        Parameters
        ----------
        level : float
            The probability with which such intervals have the true value, between 0 and 1.

        Raises
        ------
        ModelError
            If the level is not between 0 and 1.

        Examples
        --------
        >>> ball = saltus.scene("bouncing-ball")
        >>> impacts = {"bounce": saltus.EventTimes([1.428, 3.998, 6.311])}
        >>> found = saltus.fit(ball.system, impacts, ["e"], context=ball.context)
        >>> low, high = found.confidence(0.95)["e"]
        >>> low < 0.9 < high
        True
        """
        if not 0.0 < level < 1.0:
            raise ModelError(f"confidence: expected a level between 0 and 1, found {level!r}")
        half = self._quantile((1.0 + level) / 2.0) * np.sqrt(np.diag(self._covariance_inner))
        inner = self._coordinates.inner(self.values)
        ends = [self._coordinates.outer(inner + sign * half).tolist() for sign in (-1.0, 1.0)]
        return dict(zip(self.names, zip(*ends, strict=True), strict=True))

    def plot(self, *names: str, axes: Any = None) -> Any:
        """Draws data and fitted runs, and the residuals below them. Needs matplotlib.

        Parameters
        ----------
        *names : str
            The signals and events; by default all.
        axes : array of matplotlib Axes, optional
            The axes to draw into: two rows, a column for each name.

        Returns
        -------
        ndarray of Axes
            (2, names): fit and residuals.

        Raises
        ------
        ModelError
            If a name is unknown.

        Examples
        --------
        >>> ball = saltus.scene("bouncing-ball")
        >>> impacts = {"bounce": saltus.EventTimes([1.428, 3.998, 6.311])}
        >>> found = saltus.fit(ball.system, impacts, ["e"], context=ball.context)
        >>> found.plot().shape
        (2, 1)
        """
        return plot(self.compared, self.runs, names, axes)

    def to_pandas(self) -> pandas.DataFrame:
        """A row for each value of the data: experiment, name, entry, time, data, model, residual.
        Needs pandas.

        Examples
        --------
        >>> ball = saltus.scene("bouncing-ball")
        >>> impacts = {"bounce": saltus.EventTimes([1.428, 3.998, 6.311])}
        >>> found = saltus.fit(ball.system, impacts, ["e"], context=ball.context)
        >>> len(found.to_pandas())
        3
        """
        library = extra("pandas", "to_pandas")
        columns = ("entry", "time", "data", "model", "residual")
        frames = [
            library.DataFrame(
                {"experiment": each.experiment, "name": each.name}
                | {column: getattr(each, column) for column in columns}
            )
            for each in self.compared
        ]
        frame: pandas.DataFrame = library.concat(frames, ignore_index=True)
        return frame

    def __repr__(self) -> str:
        return as_text(self)

    def _repr_html_(self) -> str:
        return as_html(self)
