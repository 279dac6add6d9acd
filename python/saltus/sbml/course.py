"""`time_course`: the table of a case of the SBML test suite."""

from __future__ import annotations

import numbers
import os
from collections.abc import Sequence
from typing import Any

import numpy as np

from saltus.errors import ModelError
from saltus.results import Results
from saltus.sbml.formula import evaluated
from saltus.sbml.reading import model_of
from saltus.sbml.system import Model, model_block
from saltus.simulation import simulate

__all__ = ["time_course"]

ROW = 3e-14
"""relative; how much later than its name a row is, so that it has the events at that time: more
than the roundings of a sum of some hundred times (2e-14), less than `AFTER` of `guards`
"""


def time_course(
    path: str | os.PathLike[str],
    *,
    start: float,
    duration: float,
    steps: int,
    variables: Sequence[str],
    amount: Sequence[str] = (),
    concentration: Sequence[str] = (),
    **options: Any,
) -> np.ndarray:
    """The values of `variables` at start + k duration / steps, k = 0, ..., `steps`.

    Parameters
    ----------
    path : str or path
        the file of the model, or its text.
    start, duration : float
        in the model's unit of time; the run begins at time 0.
    variables : list of str
        ids of the model. A species in `amount` or in `concentration` is shown so, every other id
        has the value that it has in formulas.
    options
        of `SimulatorOptions`, such as `event_seed` for the order of events of equal priority. The
        tolerances are rtol=1e-9, atol=1e-13 if not said. Where a comparison is one of a curve, such
        as sin(time) < 0 or x * y > 1, a step is at most duration / steps if not said.

    Returns
    -------
    array of shape (steps + 1, 1 + number of variables)
        time first; at the time of an event the values after it.

    Raises
    ------
    ModelError
        As `load`; also for an unknown variable, and for steps that are no whole number.
    SimulationError
        As `saltus.simulate`.
    """
    _require_grid(start, duration, steps)
    _document, model = model_of(path)  # which owns the model
    how = {**dict.fromkeys(amount, "amount"), **dict.fromkeys(concentration, "concentration")}
    shown = [(name, how.get(name, "value")) for name in variables]
    system = model_block(model, shown)
    times = start + duration * np.arange(steps + 1) / steps
    late = np.where(times > 0.0, times + ROW * (1.0 + times), 0.0)
    usual: dict[str, Any] = {"rtol": 1e-9, "atol": 1e-13}
    if system.curved:
        usual["max_minor_step_size"] = duration / steps
    results = simulate(
        system,
        (0.0, float(late[-1])),
        save_at=late,
        event_rows=False,
        recorded_signals={name: system.output(name) for name in system.output_names},
        **(usual | options),
    )
    return np.column_stack([times, _rows(system, results, times).reshape(steps + 1, len(shown))])


def _rows(system: Model, results: Results, times: np.ndarray) -> np.ndarray:
    """What is shown, which need not be finite, from the states at each time."""
    empty = np.empty((len(times), 0))
    x, z = (results[name] if name in results else empty for name in "xz")
    p = system.constants
    tape = system.shown.tape
    return np.array([evaluated(tape, t, x[i], z[i], p) for i, t in enumerate(times.tolist())])


def _require_grid(start: float, duration: float, steps: int) -> None:
    real = all(isinstance(one, numbers.Real) for one in (start, duration))
    whole = isinstance(steps, numbers.Integral)
    if not (real and whole and start >= 0.0 and duration > 0.0 and steps >= 1):
        raise ModelError(
            "time_course: expected numbers start >= 0 and duration > 0, and a whole number "
            f"steps >= 1, found {start!r}, {duration!r} and {steps!r}"
        )
