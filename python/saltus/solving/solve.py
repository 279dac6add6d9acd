"""`solve`: the short way to a run, with the arguments of `scipy.integrate.solve_ivp`."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from saltus._porting import OPTIONS, refuse
from saltus._span import span_of
from saltus.errors import ModelError, SimulationError
from saltus.results.record import Record
from saltus.simulation import SimulatorOptions
from saltus.simulation.whole import prepared, run_whole
from saltus.solving.arguments import arguments_of, state_of, times_of
from saltus.solving.form import form_of
from saltus.solving.formed import formed
from saltus.solving.guard import Guard, functions_of, guards_of
from saltus.solving.kept import call_of, find, keep
from saltus.solving.named import named_of
from saltus.solving.solution import Known, Solution
from saltus.solving.solved_system import SolvedSystem
from saltus.solving.tolerances import first_step_of, tolerances_of

__all__ = ["solve"]

HINTS = OPTIONS | {
    "fun": "the function is the first argument, f",
    **dict.fromkeys(
        ("guard", "guards", "event", "callback", "callbacks"), "it is called events here"
    ),
    "jac": "it is called jacobian here",
    "jac_sparsity": "it is called jacobian_sparsity here",
    "lband": "say with jacobian_sparsity which entries may differ from zero",
    "uband": "say with jacobian_sparsity which entries may differ from zero",
    "min_step": "it is called min_minor_step_size here, and rarely of use",
    "max_minor_step_size": "it is called max_step here",
    "ode_solver_method": "it is called method here",
    "save_at": "it is called t_eval here",
    "event_rows": "with t_eval there are rows at those times only, else at events too",
    "recorded_signals": "the state is recorded as 'x'; for other signals write a LeafSystem",
}
METHODS = {"RK23": "dopri5", "LSODA": "auto"}
"""methods of SciPy that do not exist here -> the methods that replace them"""
OWN = (
    "method",
    "args",
    "t_eval",
    "max_step",
    "vectorized",
    "jacobian",
    "jacobian_sparsity",
    "events",
)


def solve(
    f: Callable[..., ArrayLike | None],
    t_span: tuple[float, float],
    x0: ArrayLike | None = None,
    *,
    y0: ArrayLike | None = None,
    parameters: Mapping[str, Any] | None = None,
    mode: int | None = None,
    events: Guard | Callable[..., Any] | Sequence[Guard | Callable[..., Any]] | None = None,
    method: str = "auto",
    rtol: ArrayLike = 1e-6,
    atol: ArrayLike = 1e-8,
    args: Sequence[Any] | None = (),
    t_eval: ArrayLike | None = None,
    dense_output: bool = False,
    first_step: float | None = None,
    max_step: float = np.inf,
    vectorized: bool = False,
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
        [s] Begin and end. If the end is before the begin, the run goes back in time; directions of
        events are those along the run.
    x0 : array_like, shape (n,), or a number
        The state at the beginning. A complex one is run as 2n real states, its real and imaginary
        parts, each within the tolerances; then `f` returns complex numbers, and guards real ones.
    y0 : array_like, optional
        SciPy's name for `x0`.
    parameters : mapping of str to number or array, optional
        Values that `f`, `jacobian`, guards and resets get by keyword, if they have an argument with
        that name: ``f(t, x, k)`` with ``parameters={"k": 0.05}``. Arrays and whole numbers arrive
        as arrays of floats. `sweep` varies the parameters of `system_of`, which is quicker than a
        loop of calls.
    mode : int, optional
        The mode at the beginning, for guards with `start_mode` and `end_mode`; 0 if one of them
        has such a mode. Functions with an argument `mode` get the present one.
    events : Guard or callable, or a list of them, optional
        A plain ``g(t, x, *args)``, perhaps with SciPy's attributes `terminal` and `direction`, is
        logged where it is zero; `Guard` says more, such as a reset.
    method : str
        'auto', 'dopri5' ('RK45'), 'dop853' ('DOP853'), 'adams', 'bdf' ('BDF'), 'radau'
        ('Radau'). SciPy's 'RK23' is run by 'dopri5' and 'LSODA' by 'auto'.
    rtol, atol : float or array_like, shape (n,)
        Relative and absolute tolerance of a step, for all states or for each. A relative one below
        1e-15 is raised to that, with a warning.
    args : sequence
        Handed on to `f`, `jacobian`, guards and resets.
    t_eval : array_like, optional
        [s] Times in the order of the run. Then only these times have rows, and at the time of an
        event it is the row after the event.
    dense_output : bool
        Keep the interpolants of the solver: then ``solution(t)`` and ``solution.sol(t)`` work.
    first_step : float, optional
        [s] The first step that is tried; by default the tolerance chooses it.
    max_step : float
        [s] The longest step of the solver.
    vectorized : bool
        Whether `f` takes states as columns, ``f(t, x)`` with `x` of shape (n, k); it gets one.
    jacobian : callable or array_like, optional
        ``jacobian(t, x, *args)``, or a constant, the n by n matrix df/dx; for stiff methods.
    jacobian_sparsity : optional
        The entries of df/dx that may differ from zero; see `LeafSystem.declare_continuous_state`.
    progress : bool or callable
        True shows the progress of the run; see `SimulatorOptions`.
    **options
        Any other option of `SimulatorOptions`, such as ``zeno_tolerance=0`` or ``throw=False``.

    Returns
    -------
    Solution
        `Results` whose signal 'x' is the state, with `t`, `y`, `t_events`, `sol`, ... beside.

    Raises
    ------
    ModelError
        If a shape is wrong, an option is unknown (with the nearest name), or times decrease.
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
    _refuse(options)
    begin, end = span_of("solve: t_span", t_span, backward=True)
    start = state_of(_one_of(x0, y0))
    guards = None if events is None else guards_of(events)
    given = arguments_of(args)
    if np.isinf(end) and start.size:
        _require_terminal(guards or [])
    form = form_of(end < begin, start.dtype.kind == "c")
    shape = (jacobian_sparsity is None, bool(vectorized))
    plain = parameters is None and mode is None and jacobian_sparsity is None
    call = call_of(f, begin, start, given, guards or [], jacobian, form, shape) if plain else None
    kept = None if call is None else find(call)
    system = kept
    if system is None:
        functions = [f, jacobian, *functions_of(guards or [])]
        named = named_of(parameters, mode, guards or [], functions, len(given))
        call = None if named else call  # functions that get values by name are not kept
        system = SolvedSystem(
            f,
            begin,
            start,
            given,
            guards or [],
            jacobian,
            jacobian_sparsity,
            vectorized,
            form,
            named,
        )
    settings: dict[str, Any] = {
        **options,
        **tolerances_of(rtol, atol, start.size, form),
        "ode_solver_method": METHODS.get(method, method),
        "dense_output": dense_output,
        "first_step": first_step_of(first_step, abs(end - begin)),
        "max_minor_step_size": max_step,
        "progress": progress,
    }
    if form.is_complex:
        settings.setdefault("python", "called")  # there are no complex expressions
    if t_eval is not None:
        settings |= {"save_at": times_of(t_eval, begin, end, form), "event_rows": False}
    names = None if guards is None else [guard.named(i) for i, guard in enumerate(guards)]
    known = Known(names, form, jacobian is not None and not callable(jacobian))
    run = prepared(
        "solve", system, None, {**settings, "recorded_signals": {"x": system.output("x")}}
    )
    if call is not None and kept is None:
        keep(call, system)
    context = system.create_context(form.time(begin))
    return run_whole(run, context, form.time(end), _Outcome(system, known))


def _one_of(x0: ArrayLike | None, y0: ArrayLike | None) -> ArrayLike:
    if (x0 is None) == (y0 is None):
        found = "none" if x0 is None else "both"
        raise ModelError(f"solve: expected the initial state as x0 or as y0, found {found}")
    return y0 if x0 is None else x0  # type: ignore[return-value]


def _require_terminal(guards: Sequence[Guard]) -> None:
    if not any(guard.terminal for guard in guards):
        raise ModelError(
            "solve: t_span: the end is infinite, and no event is terminal to end the run"
        )


def _refuse(options: Mapping[str, Any]) -> None:
    """Raises ModelError for an unknown name, with the nearest name or with advice."""
    if not options:
        return
    known = [field.name for field in fields(SimulatorOptions) if field.name not in HINTS]
    refuse("solve", options, [*OWN, *known], HINTS)


@dataclass(frozen=True)
class _Outcome:
    """Makes the solution of a run, which counts t."""

    system: SolvedSystem
    known: Known

    def __call__(
        self, core: Record, raised: BaseException | None
    ) -> tuple[Solution, BaseException | None]:
        form = self.known.form
        if form.backward and isinstance(raised, SimulationError):  # it counts s
            t = form.time(raised.time)
            raised = SimulationError(formed(core, form).message, t, raised.block)
        return Solution(core, raised, self.system, self.known, self.system), raised
