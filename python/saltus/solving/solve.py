"""`solve`: the short way to a run, with the arguments of `scipy.integrate.solve_ivp`."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from saltus._core import Context
from saltus._porting import OPTIONS, refuse
from saltus._span import span_of
from saltus.errors import ModelError
from saltus.results.record import Record
from saltus.simulation import Simulator, SimulatorOptions
from saltus.solving.guard import Guard, guards_of
from saltus.solving.solution import Solution
from saltus.solving.solved_system import SolvedSystem, arguments_of, state_of, times_of

__all__ = ["solve"]

HINTS = OPTIONS | {
    "fun": "the function is the first argument, f",
    "y0": "the initial state is the third argument, x0",
    "jac": "it is called jacobian here",
    "jac_sparsity": "it is called jacobian_sparsity here",
    "lband": "say with jacobian_sparsity which entries may differ from zero",
    "uband": "say with jacobian_sparsity which entries may differ from zero",
    "first_step": "the engine chooses the first step by the tolerance; leave it out",
    "min_step": "it is called min_minor_step_size here, and rarely of use",
    "max_minor_step_size": "it is called max_step here",
    "ode_solver_method": "it is called method here",
    "save_at": "it is called t_eval here",
    "event_rows": "with t_eval there are rows at those times only, else at events too",
    "recorded_signals": "the state is recorded as 'x'; for other signals write a LeafSystem",
    "vectorized": "f is called with one state at a time; leave it out",
}
METHODS = {
    "RK23": "take method='dopri5', or 'auto', with a larger rtol",
    "Radau": "take method='bdf', or 'auto'",
    "LSODA": "take method='auto': it changes between stiff and not by itself",
}
BACKWARD = "; to go back in time, solve dx/ds = -f(-s, x) from -begin to -end"
OWN = ("method", "args", "t_eval", "max_step", "jacobian", "jacobian_sparsity", "events")


def solve(
    f: Callable[..., ArrayLike | None],
    t_span: tuple[float, float],
    x0: ArrayLike,
    *,
    events: Guard | Callable[..., Any] | Sequence[Guard | Callable[..., Any]] | None = None,
    method: str = "auto",
    rtol: float = 1e-6,
    atol: float = 1e-8,
    args: Sequence[Any] = (),
    t_eval: ArrayLike | None = None,
    dense_output: bool = False,
    max_step: float = np.inf,
    jacobian: Callable[..., ArrayLike] | ArrayLike | None = None,
    jacobian_sparsity: Any = None,
    progress: Any = False,
    **options: Any,
) -> Solution:
    """Solves dx/dt = f(t, x) with events, like `scipy.integrate.solve_ivp`.

    It makes a `LeafSystem` of the functions and runs it: a class with the same functions gives the
    same bits. Differences from SciPy: an event may have a reset, after which the run goes on, and
    where events accumulate (a ball that comes to rest) the state rests with them; a run that ends
    badly raises, unless ``throw=False``; `status` is a word; default tolerances are finer.

    Parameters
    ----------
    f : callable
        ``f(t, x, *args)`` returns dx/dt, n numbers in units of x per second; or
        ``f(t, x, out, *args)`` writes them to `out` and returns nothing. `x` is read-only.
    t_span : (float, float)
        [s] begin and end.
    x0 : array_like, shape (n,), or a number
        The state at the beginning.
    events : Guard or callable, or a list of them, optional
        A plain ``g(t, x, *args)``, perhaps with SciPy's attributes `terminal` and `direction`, is
        logged where it is zero; `Guard` says more, such as a reset.
    method : str
        'auto', 'dopri5' ('RK45'), 'dop853' ('DOP853'), 'adams' or 'bdf' ('BDF').
    rtol, atol : float
        Relative and absolute tolerance of a step.
    args : sequence
        Handed on to `f`, `jacobian`, guards and resets.
    t_eval : array_like, optional
        [s] increasing times; then there are rows at these only, at an event that after it.
    dense_output : bool
        Keep the interpolants of the solver: then ``solution(t)`` and ``solution.sol(t)`` work.
    max_step : float
        [s] longest step of the solver.
    jacobian : callable or array_like, optional
        ``jacobian(t, x, *args)``, or a constant, the n by n matrix df/dx; for stiff methods.
    jacobian_sparsity : optional
        Where df/dx may differ from zero; see `LeafSystem.declare_continuous_state`.
    progress : bool or callable
        True shows how far the run is; see `SimulatorOptions`.
    **options
        Any other option of `SimulatorOptions`, such as ``zeno_tolerance=0`` or ``throw=False``.

    Returns
    -------
    Solution
        `Results` whose signal 'x' is the state, with `t`, `y`, `t_events`, `sol`, ... beside.

    Raises
    ------
    ModelError
        For bad input: wrong shapes, unknown options (with the nearest name), times that decrease.
    SimulationError
        If the run ends badly; its attribute `results` has the run until then.
    KeyboardInterrupt
        After Ctrl-C; its attribute `results` has the run until then.

    Examples
    --------
    A ball that bounces infinitely often, and comes to rest:

    >>> import saltus
    >>> def bounce(t, x):
    ...     return [0.0, -0.7 * x[1]]
    >>> floor = saltus.Guard(lambda t, x: x[0], reset=bounce, direction="falling", name="floor")
    >>> solution = saltus.solve(lambda t, x: [x[1], -9.81], (0, 5), [1.0, 0.0], events=[floor])
    >>> solution.status, solution.y[:, -1].tolist()
    ('reached_end', [0.0, 0.0])
    """
    _refuse(method, options)
    begin, end = span_of("solve: t_span", t_span, BACKWARD)
    guards = None if events is None else guards_of(events)
    if np.isinf(end) and not any(guard.terminal for guard in guards or []):
        raise ModelError(
            "solve: t_span: the end is infinite, and no event is terminal to end the run"
        )
    system = SolvedSystem(
        f, begin, state_of(x0), arguments_of(args), guards or [], jacobian, jacobian_sparsity
    )
    settings: dict[str, Any] = {
        **options,
        "rtol": rtol,
        "atol": atol,
        "ode_solver_method": method,
        "dense_output": dense_output,
        "max_minor_step_size": max_step,
        "progress": progress,
    }
    if t_eval is not None:
        settings |= {"save_at": times_of(t_eval, begin, end), "event_rows": False}
    names = None if guards is None else [guard.named(i) for i, guard in enumerate(guards)]
    return _run(system, begin, end, settings, names)


def _refuse(method: object, options: Mapping[str, Any]) -> None:
    """Raises ModelError for an unknown name, with the nearest name or with advice."""
    known = [field.name for field in fields(SimulatorOptions) if field.name not in HINTS]
    refuse("solve", options, [*OWN, *known], HINTS)
    if isinstance(method, str) and method in METHODS:
        raise ModelError(f"solve: there is no method '{method}': {METHODS[method]}")


def _run(
    system: SolvedSystem,
    begin: float,
    end: float,
    settings: Mapping[str, Any],
    names: Sequence[str] | None,
) -> Solution:
    simulator = _SolveSimulator(system, names, settings)
    return simulator.solution(system.create_context(begin), end)


class _SolveSimulator(Simulator):
    """A simulator whose runs end in a `Solution`."""

    def __init__(
        self, system: SolvedSystem, names: Sequence[str] | None, settings: Mapping[str, Any]
    ):
        super().__init__(system, recorded_signals={"x": system.output("x")}, **settings)
        self._names = names

    def _outcome(self, core: Record, raised: BaseException | None, asks: Any) -> Solution:
        assert isinstance(self.system, SolvedSystem)
        return Solution(core, raised, asks, self._names, self.system, self.system.fixed_jacobian)

    def solution(self, context: Context, end: float) -> Solution:
        solution = self._run(context, end)
        assert isinstance(solution, Solution)
        return solution
