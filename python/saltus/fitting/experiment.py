"""`Experiment`: the data of one run, with the values under which they were measured."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from saltus import _core
from saltus.errors import ModelError

__all__ = ["EventTimes", "Experiment", "experiments_of"]


@dataclass(frozen=True)
class EventTimes:
    """Measured times of an event, as data of `fit` under the name of the event.

    The k-th time belongs to the k-th event of the run; more events of the run do not count. An
    event that the run does not have is taken at the end of the run, so that the residual is
    continuous where an event leaves the run; or at the predicted Zeno time, if the events
    accumulated there. At the end of the run it has no derivative, and `warnings` of the fit name it.

    Parameters
    ----------
    times : array
        [s] increasing; nan for an event that was not seen.
    sigma : float or array
        [s] the standard deviation of each time.
    kind : str, optional
        The kind of the event, as in `EventLog.times`; of 'zeno_enter' the data are the predicted
        times at which infinitely many events would have happened.

    Raises
    ------
    ModelError
        If the times do not increase, or a standard deviation is not positive.

    Examples
    --------
    >>> saltus.EventTimes([1.43, 3.99], sigma=0.01).times
    array([1.43, 3.99])
    """

    times: ArrayLike
    sigma: ArrayLike | None = None
    kind: str | None = None

    def __post_init__(self) -> None:
        times = _array("event times", self.times)
        if times.ndim != 1:
            raise ModelError(
                f"event times: expected a list of times, found the shape {times.shape}"
            )
        if np.any(np.diff(times[np.isfinite(times)]) < 0.0):
            raise ModelError("event times: expected increasing times; sort them")
        object.__setattr__(self, "times", times)
        deviations = _array("event times: sigma", 1.0 if self.sigma is None else self.sigma)
        if (deviations <= 0.0).any() or (deviations.ndim == 0 and np.isnan(deviations)):
            raise ModelError(
                f"event times: sigma: expected standard deviations above 0 s, found {self.sigma!r}"
            )


@dataclass(frozen=True)
class Experiment:
    """Data of one run, and the values under which they were measured.

    Parameters
    ----------
    data : dict, pandas.DataFrame or xarray.Dataset
        The data, as for `fit`.
    sigma : float or dict, optional
        The standard deviations of this experiment, as for `fit`.
    context : Context, optional
        The values at the begin of the run; by default that of `fit`.
    values : dict
        Values of parameters and start values that hold in this experiment, ``{"x[0]": 2.0}``.
    free : dict
        Parameters and start values that are fitted for this experiment alone, as the `parameters`
        of `fit`; their names in the result begin with that of the experiment: ``"drop 2: x[0]"``.
    t_span : (float, float), optional
        [s] begin and end of the run; by default those of `fit`.
    name : str
        The name in the result; by default 'run 1', 'run 2', ...

    Examples
    --------
    >>> drop = saltus.Experiment({"time": [0.1, 0.2], "y": [0.95, 0.8]}, values={"x[0]": 1.0})
    >>> drop.values
    {'x[0]': 1.0}
    """

    data: Any
    sigma: Any = None
    context: _core.Context | None = None
    values: Mapping[str, float] = field(default_factory=dict)
    free: Mapping[str, Any] = field(default_factory=dict)
    t_span: tuple[float, float] | None = None
    name: str = ""


def experiments_of(data: Any) -> list[Experiment]:
    """One experiment for each data set."""
    single = not isinstance(data, (list, tuple))
    given = [data] if single else list(data)
    if not given:
        raise ModelError("fit: data: expected at least one data set, found none")
    found = [each if isinstance(each, Experiment) else Experiment(each) for each in given]
    named = [_with_name(each, f"run {k + 1}") for k, each in enumerate(found)]
    names = [each.name for each in named]
    if len(set(names)) < len(names):
        raise ModelError(f"fit: two experiments have one name; expected different ones: {names}")
    return named


def _with_name(experiment: Experiment, name: str) -> Experiment:
    if experiment.name:
        return experiment
    parts = {key: getattr(experiment, key) for key in experiment.__dataclass_fields__}
    return Experiment(**{**parts, "name": name})


def _array(what: str, values: ArrayLike) -> np.ndarray:
    """A copy as numbers; nan is allowed, infinite numbers are not."""
    try:
        array = np.array(values, dtype=float)
    except (TypeError, ValueError):
        raise ModelError(f"{what}: expected numbers, found {values!r}") from None
    if np.isinf(array).any():
        raise ModelError(f"{what}: found an infinite number; write nan for a missing value")
    return array
