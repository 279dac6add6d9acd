"""`SimulatorOptions`: how a run is done."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from saltus._porting import OPTIONS, refuse
from saltus.progress import Progress
from saltus.system import OutputPort

__all__ = ["SimulatorOptions", "atol_beside"]


def atol_beside(rtol: Any) -> Any:
    """The absolute tolerance of a scene file, and of the command line, that say the relative one
    alone: a hundredth of it, as 1e-8 is of 1e-6.
    """
    return [each / 100.0 for each in rtol] if isinstance(rtol, (list, tuple)) else rtol / 100.0


def _refuse_unknown(cls: Any) -> Any:
    """An unknown name is answered with the nearest name, or a hint, in place of a TypeError."""
    generated = cls.__init__

    @functools.wraps(generated)
    def __init__(self: Any, **options: Any) -> None:
        refuse(cls.__name__, options, (field.name for field in fields(cls)), OPTIONS)
        generated(self, **options)

    cls.__init__ = __init__
    return cls


@_refuse_unknown
@dataclass(frozen=True, kw_only=True)
class SimulatorOptions:
    """How a run is done. `dataclasses.replace(options, rtol=1e-9)` makes a changed copy.

    A minor step is one step of the solver. A major step is the stretch from one instant to the
    next: an instant is the start, the end, a time event, or an event of a guard with an effect. A
    major step has as many minor steps as the tolerances need.

    Every option can also be given to `simulate`, `Simulator` and `solve` by its name.

    Raises
    ------
    ModelError
        If a name is unknown; the message has the nearest name. A value that makes no sense is
        refused when a run begins.

    Examples
    --------
    >>> import saltus
    >>> options = saltus.SimulatorOptions(rtol=1e-9, atol=1e-11, dense_output=True)
    >>> options.ode_solver_method
    'auto'
    """

    rtol: ArrayLike = 1e-6
    """relative tolerance of a minor step: the root mean square over the states of error / (atol +
    rtol |x|) stays below 1. One number for all states, or one for each continuous state, in the
    order of the context
    """
    atol: ArrayLike = 1e-8
    """absolute tolerance, in the unit of the states; one number, or one for each"""
    ode_solver_method: str = "auto"
    """'auto' (dopri5 or dop853 by tolerance, radau or bdf while the scene is stiff), 'dopri5',
    'dop853', 'adams', 'bdf', 'radau', 'taylor' (derivatives that are traced, or formulas); also
    'rk45', 'RK45', 'DOP853', 'non-stiff', 'stiff', 'BDF', 'Radau'
    """
    linear_solver: str = "auto"
    """how a stiff method solves its linear systems: 'auto' (by number of states and places of the
    Jacobian), 'dense', 'band', 'sparse', 'gmres'; `statistics.linear_solver` names the choice
    """
    find_sparsity: bool = True
    """if a block of more than 256 states declares neither Jacobian nor sparsity, a stiff method
    finds the sparsity by calls of its derivative near the state; `statistics.linear_solver` has the
    outcome. With False such a block counts as full, or its places are unknown
    """
    max_major_steps: int | None = None
    """instants that a run may have, the start and the end among them, as `statistics.instants`
    counts them; more end it with the status 'step_limit'. It bounds the events of a run, not the
    minor steps
    """
    max_major_step_length: float | None = math.inf
    """[s] longest major step: an instant is added where the next one would be later"""
    min_minor_step_size: float | None = 0.0
    """[s] the shortest minor step; it is rarely useful, because the tolerance chooses the step"""
    max_minor_step_size: float | None = math.inf
    """[s] the longest minor step; it is rarely useful either, because events are found in any step
    """
    first_step: float | None = None
    """[s] the first solver step of the run that is tried; None: the tolerance chooses it"""
    zeno_tolerance: float = 1e-6
    """[s] A guard whose firings follow each other this closely, with shrinking gaps, comes to rest:
    a Zeno hold. 0 switches the monitor off
    """
    event_scan_points: int | None = None
    """interior points of a step at which guards are evaluated, to find two crossings in one step; 0
    switches this off. None means as many as the degree of the method's dense output, that is 4 for
    dopri5, 7 for dop853, and for adams and bdf the present order, at least 3
    """
    max_passes: int = 100
    """number of passes of an instant before it counts as a loop without end"""
    event_seed: float = 0.0
    """seed of the random order in which executions of queued zero crossings with equal priority
    follow each other at one time; any finite number
    """
    recorded_signals: Mapping[str, OutputPort | str] | Sequence[str] | None = None
    """the outputs to record: a dict of names with ports or paths such as "car.engine.out", or a
    list of paths. None: the outputs of the system, in a sweep nothing; {}: nothing
    """
    sensitivity: Sequence[str] = ()
    """the parameters and start values to differentiate the run by, with the names of `sweep`:
    "e", "ball.e", "x[0]"; see `Results.sensitivities`
    """
    save_at: Sequence[float] = ()
    """[s] increasing times within the run to record at. If there are any, solver steps are recorded
    only with save_steps=True
    """
    save_steps: bool | None = None
    event_rows: bool = True
    """record rows at events, at the start and at the end too. With False there are rows at save_at
    only, one for each time; at the time of an event it is the row after it
    """
    dense_output: bool = False
    """keep the interpolants of the solver: `results(t)` gives state and recorded signals at any
    time
    """
    record_events: bool = True
    """the event log; switching it off changes nothing else"""
    islands: bool = False
    """True lets islands step apart: parts of the scene that read nothing of each other have steps,
    events and rows of their own, so that n balls cost as much as n runs of one ball. Each island
    runs as if it were alone, to the bit; see `Results.islands`. Event wires with delays lead from
    island to island. A later version may change the default
    """
    island_threads: int = 1
    """the number of threads on which islands run, 0 for as many as the machine has cores; the
    results have the same bits. It needs islands=True. Where Python callbacks are called, all
    islands run on one thread
    """
    python: str = "traced"
    """'traced' makes expressions of the Python callbacks that allow it, which run without the
    interpreter; 'called' calls them all. See `system.explain()`
    """
    machine_code: str = "auto"
    """how tapes run: 'auto' compiles them with llvmlite, the extra ``saltus[jit]``, once a run has
    shown that it pays; 'always' compiles them before the run; 'never' interprets them. The results
    have the same bits
    """
    throw: bool = True
    """raise an exception if a run does not end well; False returns the results with their status"""
    progress: bool | Callable[[Progress], object] = False
    """True shows the progress of the run, by tqdm if it is installed, otherwise on a line of
    stderr; a function is called with a `Progress` at most ten times a second, and once at the end
    """
    interrupt: Callable[[], bool] | None = None
    """a function that is called about every 20 ms; if it returns True the run ends with the status
    'interrupted'. Ctrl-C ends a run in any case
    """

    def __post_init__(self) -> None:
        for name in ("rtol", "atol"):
            tolerance = getattr(self, name)
            if isinstance(tolerance, (list, np.ndarray)) and np.ndim(tolerance) == 1:
                # a copy that compares and hashes by value, as the options do
                object.__setattr__(self, name, tuple(tolerance))
