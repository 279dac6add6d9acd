"""Refused names: an unknown name gets the nearest one as an answer, a name of a similar tool
advice.
"""

from __future__ import annotations

import functools
import inspect
import re
from collections.abc import Callable, Iterable, Mapping
from typing import Any, ParamSpec, TypeVar

from saltus._core import Diagram, known_names
from saltus.errors import BlockParameterError, ModelError
from saltus.parameter import given

__all__ = ["OPTIONS", "is_reset", "missing", "refuse", "refusing"]

P = ParamSpec("P")
R = TypeVar("R")

SPAN = "the span is time_span=(begin, end), in seconds"
OPTIONS = {
    **dict.fromkeys(("t_span", "tspan", "span", "t_end", "tf", "stop_time", "StopTime"), SPAN),
    **dict.fromkeys(("method", "solver", "integrator"), "it is ode_solver_method='auto'"),
    **dict.fromkeys(("max_step", "max_step_size", "MaxStep"), "it is max_minor_step_size [s]"),
    **dict.fromkeys(
        ("dt", "step_size", "fixed_step"),
        "the tolerances rtol and atol choose the steps; rows at even times are save_at=[...]",
    ),
    **dict.fromkeys(("t_eval", "teval", "saveat", "tout"), "it is save_at=[...]"),
    **dict.fromkeys(("tol", "tolerance", "RelTol", "reltol"), "it is rtol"),
    **dict.fromkeys(("AbsTol", "abstol"), "it is atol"),
    **dict.fromkeys(
        ("record", "signals", "outputs", "log"), "it is recorded_signals=['block.port']"
    ),
    **dict.fromkeys(
        ("x0", "y0", "initial_state"),
        "give a context: system.create_context().with_continuous_state([...])",
    ),
    **dict.fromkeys(
        ("params", "parameters", "p"),
        "give a context: system.create_context().with_parameters({...})",
    ),
    "math_backend": "there is one backend, compiled; leave it out",
    "enable_tracing": "see system.explain(); python='called' switches it off",
    "enable_autodiff": "derivatives of a run are sensitivity=['gain.gain', ...]",
    "max_checkpoints": "leave it out: sensitivity=[...] goes forward and needs none",
    "buffer_length": "the recorder grows as needed; leave it out",
    "save_time_series": "give recorded_signals, or recorded_signals=[] records nothing",
    "return_context": "results.context is always there; leave it out",
    "zc_bisection_loop_count": "events are located to the last digits of a double; leave it out",
    "int_time_scale": "time is a double and ticks are counted by integers; leave it out",
    "major_step_callback": "use a Simulator and call advance_to as often as you want to look",
    "results_options": "say save_at=[...] for rows at chosen times",
    "max_results_interval": "say save_at=[...] for rows at chosen times",
    "fixed_results_interval": "say save_at=[...] for rows at chosen times",
    "postprocess": "call the function on what simulate returns",
    "throw_errors": "the option is called throw in Python",
}

DECLARATIONS = {
    "enable_tracing": "see system.explain(); leave it out",
    "dtype": "every value is a double; leave it out",
    "as_array": "every value is an array; leave it out",
    "mass_matrix": "divide by it in the ode",
    "prerequisites_of_calc": "say which inputs are read with requires_inputs",
    "grad_guard": "it is guard_derivatives, and is needed for a guard that is called only",
}
CALLED = {
    **dict.fromkeys(("initial_condition", "ic", "x0", "InitialCondition"), "initial_state"),
    **dict.fromkeys(("k", "K", "factor"), "gain"),
    **dict.fromkeys(("amp", "a"), "amplitude"),
    **dict.fromkeys(("freq", "omega", "w"), "frequency"),
    **dict.fromkeys(("num", "b"), "numerator"),
    **dict.fromkeys(("den",), "denominator"),
    **dict.fromkeys(("Kp", "P"), "kp"),
    **dict.fromkeys(("Ki", "I"), "ki"),
    **dict.fromkeys(("Kd", "D"), "kd"),
    **dict.fromkeys(("signs", "inputs"), "operators"),
    **dict.fromkeys(("lower", "min", "low"), "lower_limit"),
    **dict.fromkeys(("upper", "max", "high"), "upper_limit"),
    "period": "dt",
    "sample_time": "dt",
    "dt": "period",
    "initial_value": "initial_state",
    "default_value": "initial_state",
}
"""arguments of the blocks of similar tools -> their names here, where a block has them"""


def refuse(
    where: str, given: Iterable[str], known: Iterable[str], hints: Mapping[str, str] = DECLARATIONS
) -> None:
    """Raises ModelError for the first of `given` that is not one of `known`."""
    known = list(known)
    for name in given:
        if name in known:
            continue
        if name in hints:
            raise ModelError(f"{where}: no option '{name}': {hints[name]}")
        raise ModelError(f"{where}: unknown option '{name}'{known_names(name, known)}")


def missing(owner: Any, name: str, instead: Mapping[str, str]) -> Any:
    """Raises the AttributeError for a name that `owner` does not have, with what is there instead,
    or with the nearest name. For `__getattr__`.
    """
    if hasattr(type(owner), name):  # a property raised the AttributeError, which says more
        return object.__getattribute__(owner, name)
    known = [each for each in dir(owner) if not each.startswith("_")]
    hint = f"; {instead[name]}" if name in instead else known_names(name, known)
    hint = "" if name.startswith("_") else hint
    raise AttributeError(f"'{type(owner).__name__}' object has no attribute '{name}'{hint}")


def refusing(method: Callable[P, R]) -> Callable[P, R]:
    """The method; it answers an unknown keyword or an argument of a wrong kind by a ModelError, not
    by a TypeError.
    """
    code = method.__code__
    known = code.co_varnames[1 : code.co_argcount + code.co_kwonlyargcount]
    where = method.__name__ if method.__name__ != "__init__" else method.__qualname__.split(".")[-2]

    declares = method.__name__.startswith("declare_")
    hints = _hints(method.__name__, known)
    constructs = method.__name__ == "__init__"
    positional = known[: code.co_argcount - 1] if constructs else ()

    @functools.wraps(method)
    def checked(*arguments: P.args, **options: P.kwargs) -> R:
        if declares and not getattr(arguments[0], "_made", False):
            raise ModelError(f"{where}: call super().__init__(name=...) first, then declare")
        if declares:
            _let_go(arguments[0])
        if constructs:
            if not code.co_flags & inspect.CO_VARARGS:
                _require_few(where, positional, arguments, options)
            if not options.keys() <= set(known):
                from saltus.library.ported import as_here

                placed = dict(zip(positional, arguments[1:], strict=False))
                options = as_here(where, options, known, placed)  # type: ignore[assignment]
        refuse(where, options, known, hints)
        try:
            if positional and _has_expressions(arguments, options):
                return _constructed(method, positional, arguments, options)
            return method(*arguments, **options)
        except TypeError as error:
            if not WRONG_KIND.search(str(error)):
                raise
        raise ModelError(f"{where}: {_wrong_kind(method, arguments, options)}")

    return checked


def _require_few(
    where: str, positional: tuple[str, ...], arguments: Any, options: Mapping[str, Any]
) -> None:
    """ModelError for more arguments without a name than a block takes, and for a truth in the place
    of a limit, where other tools have another argument; for one limit that may be either.
    """
    given = arguments[1:]
    if len(given) > len(positional):
        raise ModelError(
            f"{where}: expected at most {len(positional)} arguments without a name "
            f"({', '.join(positional) or 'none'}), found {len(given)}; give the others by name"
        )
    for name, value in zip(positional, given, strict=False):
        if isinstance(value, bool) and name.endswith("_limit"):
            raise ModelError(f"{where}: {name}: expected numbers, found {value}; give it by name")
    if len(given) == 1 and positional[0] == "lower_limit" and "upper_limit" not in options:
        raise ModelError(  # other tools begin with the upper one
            f"{where}: say which limit it is: lower_limit={given[0]!r} or upper_limit={given[0]!r}"
        )


def _has_expressions(arguments: Any, options: Any) -> bool:
    """Whether a block, and no diagram, is given a `Parameter`: a diagram passes it on."""
    values = (*arguments[1:], *options.values())
    return not isinstance(arguments[0], Diagram) and any(given(one) is not None for one in values)


def _constructed(
    method: Callable[..., R], names: tuple[str, ...], arguments: Any, options: Any
) -> R:
    from saltus.parameters.noted import note, plain

    block, *values = arguments
    numbers, expressions = plain({**dict(zip(names, values, strict=False)), **options})
    made = method(block, **numbers)
    note(block, expressions)
    return made


def _let_go(block: Any) -> None:
    """Drops the traces and plans that a block keeps, because the block declares more."""
    callbacks = getattr(block, "_callbacks", None)
    if callbacks is not None:
        callbacks.plans.clear()
        block._callbacks = None


def _hints(method: str, known: tuple[str, ...]) -> dict[str, str]:
    """The advice for arguments that a declaration, or the constructor of a block, does not have."""
    if method.startswith("declare_"):
        return DECLARATIONS
    return {other: f"it is called {name} here" for other, name in CALLED.items() if name in known}


WRONG_KIND = re.compile(r"incompatible (function|constructor) arguments")  # the compiled module's


def _wrong_kind(method: Callable[..., Any], arguments: Any, options: Any) -> str:
    """The expected annotations and the found values, as text."""
    signature = inspect.signature(method)
    given = dict(list(signature.bind(*arguments, **options).arguments.items())[1:])  # not self
    expected = ", ".join(f"{name}: {signature.parameters[name].annotation}" for name in given)
    found = ", ".join(f"{name} = {value!r}" for name, value in given.items())
    return f"expected {expected}; found {found}"


def is_reset(where: str, what: str, word: str) -> bool:
    """Whether an option is "reset", and not "held"; BlockParameterError for another word."""
    words = ["held", "reset"]
    if word not in words:
        near = known_names(str(word), words)
        raise BlockParameterError(f"{where}: unknown {what} {word!r}{near}")
    return word == "reset"
