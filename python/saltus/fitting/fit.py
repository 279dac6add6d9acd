"""`fit`: parameters and start values of a system from measured data."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields, replace
from typing import Any

import numpy as np

from saltus import _core
from saltus._porting import OPTIONS, refuse
from saltus._signals import named, signals_of
from saltus.errors import ModelError
from saltus.fitting.bound import bound
from saltus.fitting.coordinates import Coordinates, places_of
from saltus.fitting.experiment import experiments_of
from saltus.fitting.optimize import Optimizer
from saltus.fitting.problem import Problem
from saltus.fitting.progress import Shown
from saltus.fitting.report import result_of
from saltus.fitting.result import FitResult
from saltus.fitting.starts import starts_of
from saltus.fitting.trial import Trial
from saltus.fitting.uncertainty import require_loss
from saltus.options import SimulatorOptions
from saltus.results.tables import extra
from saltus.system import OutputPort, System

__all__ = ["fit"]

OWN = {
    "recorded_signals": "the data name the signals; signals={...} gives them ports",
    "save_at": "the data give the times",
    "save_steps": "the data give the times",
    "event_rows": "the data give the times",
    "record_events": "the data give the events",
    "dense_output": "the runs of the result have it",
    "sensitivity": "the parameters give it",
    "throw": "failures of runs do not end a fit",
}
"""options of a run that a fit sets itself"""
TIGHT = SimulatorOptions(rtol=1e-8, atol=1e-10)
"""the options of the runs by default: tolerances below the changes that end a fit"""


def fit(
    system: System,
    data: Any,
    parameters: Mapping[str, Any] | Sequence[str],
    *,
    context: _core.Context | None = None,
    t_span: tuple[float, float] | None = None,
    signals: Mapping[str, OutputPort | str] | Sequence[str] | None = None,
    sigma: float | Mapping[str, Any] | None = None,
    absolute_sigma: bool = False,
    loss: str | Callable[[np.ndarray], np.ndarray] = "linear",
    f_scale: float = 1.0,
    starts: int = 1,
    seed: int = 0,
    max_nfev: int | None = None,
    ftol: float | None = 1e-8,
    xtol: float | None = 1e-8,
    gtol: float | None = None,
    progress: bool | Callable[[Any], object] = False,
    options: SimulatorOptions | None = None,
    **option_overrides: Any,
) -> FitResult:
    """Parameters and start values of a system from measured data, by least squares.

    It finds the p within the bounds with the least ½ Σ r_i(p)², r_i = (model_i(p) - data_i) /
    sigma_i, by `scipy.optimize.least_squares` (method 'trf': Branch, Coleman and Li, SIAM J. Sci.
    Comput. 21, 1999). The Jacobian dr/dp comes from the option `sensitivity` of the same run, also
    through events and for event times.

    Parameters
    ----------
    system : System
        The system. It never changes.
    data : dict, pandas.DataFrame, xarray.Dataset, Experiment, or a list of them
        A dict has ``"time"`` [s] and for each signal a value or a vector at each time; under the
        name of an event it has `EventTimes`. A DataFrame has a column or an index 'time', a Dataset
        a coordinate. A signal is the name of an output, its path "ball.y", a name of `signals`, or
        an entry "state[0]" of a vector. nan is a missing value. At the time of an event a signal
        has its value after the event. A list has one data set for each run; `Experiment` adds its
        own context, values and parameters.
    parameters : dict or list of str
        The names, as in `sweep`: ``"e"``, ``"ball.e"``, ``"x[0]"``; in a dict with a start value,
        with bounds ``(lower, upper)``, with a `Free`, which has both, or with None. A start that is
        not given is that of the context, if it is within the bounds, or else their middle.
    context : Context, optional
        The other values, at the time at which the run begins; by default those of the blocks.
    t_span : (float, float), optional
        [s] Begin and end of the run. By default it begins at the time of the context and ends at
        the last time of the data, or with event times at twice the time to the last of them.
    signals : mapping of str to OutputPort or str, optional
        Names of signals in the data that are no names of outputs.
    sigma : float or dict, optional
        The standard deviation of the data: a number for all signals, or by the names of signals and
        events a number or an array like the data. The weight of a value is 1 / sigma²; 1 by
        default.
    absolute_sigma : bool
        The values of `sigma` are known as numbers. By default only their ratios count, and the
        covariance is scaled by Σ r² / (n - p), as in `scipy.optimize.curve_fit`.
    loss, f_scale
        As in `least_squares`: 'linear', 'soft_l1', 'huber', 'cauchy', 'arctan' or a function; the
        residual at which it begins to count less, in units of `sigma`.
    starts : int
        The number of starts; those after the first are drawn by a Latin hypercube within the
        bounds, by the number `seed`. The best is the result.
    seed : int
        The seed of the drawn starts.
    max_nfev : int, optional
        The number of evaluations of each start; by default 100 for each parameter.
    ftol, xtol, gtol
        When a fit has converged, as in `least_squares`; xtol is relative to the size of each
        parameter at the start. gtol has the unit of the data, so there is none by default.
    progress : bool or callable
        True shows a line on stderr; a function is called with a `FitProgress`.
    options : SimulatorOptions, optional
        The options of each run; any option can also be given by name, such as ``rtol=1e-10``. The
        default of `fit` is ``rtol=1e-8, atol=1e-10``.

    Returns
    -------
    FitResult
        Its `status` says whether the fit converged. A run that fails at the values of a step makes
        the step shorter, and is counted in `failures`. Where a run has no derivative, differences
        of runs take its place, and `warnings` says so.

    Raises
    ------
    ModelError
        Before any run: for unknown parameters, signals, events and options (the message has the
        nearest name), data outside of the run or of the wrong shape, fewer data than parameters, a
        start outside of its bounds.
    SimulationError
        If the run with the start values fails; its attribute ``results`` has the run until then.
    ImportError
        If SciPy is not installed.
    KeyboardInterrupt
        After Ctrl-C. Its attribute ``results`` has the best values so far, as a `FitResult`.

    Examples
    --------
    >>> import numpy as np
    >>> ball = saltus.scene("bouncing-ball")
    >>> t = np.linspace(0.1, 3.0, 30)
    >>> run = ball.simulate(save_at=t, event_rows=False)
    >>> data = {"time": t, "state[0]": run["y"][:, 0]}
    >>> found = saltus.fit(
    ...     ball.system,
    ...     data,
    ...     {"g": (1.0, 20.0), "e": saltus.Free(0.7, 0.1, 1.0)},
    ...     context=ball.context,
    ...     signals={"state": "ball:y"},
    ... )
    >>> found.status, {name: round(value, 4) for name, value in found.parameters.items()}
    ('converged', {'g': 9.81, 'e': 0.9})
    """
    extra("scipy", "fit")
    optimize = _scipy_optimize()
    if not isinstance(system, System):
        raise ModelError(f"fit: expected a system, found {system!r}")
    shown = Shown(progress)
    require_loss(loss)
    run_options = _options(options, option_overrides)
    given = named(signals) if signals is not None else dict(signals_of(system, None))
    experiments = experiments_of(data)
    found = [bound(system, each, context, t_span, given) for each in experiments]
    places = places_of(system, parameters, experiments, [each.context for each in found])
    coordinates = Coordinates(places)
    trials = [
        Trial(system, each, [p.name for p in places if p.run in (None, k)], sigma, run_options)
        for k, each in enumerate(found)
    ]
    _require_enough(trials, coordinates, absolute_sigma)
    rtol = float(np.min(np.asarray(run_options.rtol, dtype=float)))
    problem = Problem(trials, coordinates, rtol)
    settings = {
        "loss": loss,
        "f_scale": _positive("f_scale", f_scale),
        "max_nfev": max_nfev,
        "ftol": ftol,
        "xtol": xtol,
        "gtol": gtol,
    }
    optimizer = Optimizer(problem, optimize.least_squares, settings, shown, run_options.interrupt)
    begin = starts_of(coordinates, starts, seed)
    make = functools.partial(result_of, problem, loss, float(f_scale), bool(absolute_sigma))
    return optimizer.run(begin, make)


def _scipy_optimize() -> Any:
    import scipy.optimize

    return scipy.optimize


def _options(options: SimulatorOptions | None, overrides: dict[str, Any]) -> SimulatorOptions:
    """The options of a run. ModelError for those that a fit sets."""
    for name in overrides:
        if name in OWN:
            raise ModelError(f"fit: option {name}: {OWN[name]}; remove it")
    if options is None:
        options = TIGHT
    if not isinstance(options, SimulatorOptions):
        raise ModelError(f"fit: expected SimulatorOptions, found {options!r}")
    refuse("fit", overrides, (field.name for field in fields(options)), OPTIONS)
    return replace(options, **overrides)


def _require_enough(
    trials: Sequence[Trial], coordinates: Coordinates, absolute_sigma: bool
) -> None:
    count = sum(len(trial.data) for trial in trials)
    missing = sum(trial.missing for trial in trials)
    needed = len(coordinates.places)
    if count < needed:
        said = f", without {missing} that are nan" if missing else ""
        raise ModelError(
            f"fit: expected at least {needed} data, as many as parameters "
            f"({', '.join(coordinates.labels)}), found {count}{said}; give more data, or fix "
            "parameters in the context"
        )
    lacking = sorted({name for trial in trials for name in trial.without_sigma})
    if absolute_sigma and lacking:
        raise ModelError(
            "fit: absolute_sigma=True needs the standard deviation of all data; "
            f"sigma has none of {', '.join(map(repr, lacking))}"
        )


def _positive(name: str, value: float) -> float:
    if not (isinstance(value, (int, float)) and 0.0 < value < math.inf):
        raise ModelError(f"fit: {name}: expected a number above 0, found {value!r}")
    return float(value)
