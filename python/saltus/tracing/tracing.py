"""`trace`: a function of Python becomes a tape, or a reason why not."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

import numpy as np

from saltus import _core
from saltus.tracing import kept, relations, residuals
from saltus.tracing.arguments import Result, Symbols, call, result_of
from saltus.tracing.check import Check
from saltus.tracing.numbers import Symbol, array
from saltus.tracing.refusal import Refusal, raised_at
from saltus.tracing.rounding import Bounds
from saltus.tracing.sandbox import Sandbox
from saltus.tracing.signature import Refused, Signature, Traced
from saltus.tracing.state import in_other_order

__all__ = ["trace"]


def trace(signature: Signature, few: bool = False) -> Traced | Refused:
    """Call a function once with symbols and make a tape of its operations.

    The function is not called itself before a copy of it, which cannot write to anything outside,
    has shown that it has no effects. Then tape and function are compared at a dozen points.

    Parameters
    ----------
    signature : Signature
        the function, how it is called, and the values it starts with.
    few : bool
        a function of the same code was traced and compared before; compare at fewer points.

    Returns
    -------
    Traced or Refused
        a tape that gives the values of the function, to a few roundings; or one sentence that
        names the obstacle, its place and a remedy. An exception of the function in the call with
        symbols is such a reason too; it is raised again when the function is called.

    Notes
    -----
    Where the function would raise for its values (Python's 1.0 / 0.0, math.sqrt(-1.0)) the tape
    gives infinity or NaN. np.where and its like stay inside the tape: a kink in a derivative,
    which no guard locates.

    Examples
    --------
    >>> import numpy as np
    >>> def fall(time, state, **parameters):
    ...     y, v = state.continuous_state
    ...     return np.array([v, -9.81])
    >>> traced = trace(Signature(function=fall, state_shape=(2,)))
    >>> traced.tape(0.0, np.array([10.0, 3.0]), np.empty(0), 0, 0, np.empty(0), [])
    array([ 3.  , -9.81])
    """
    with np.errstate(all="ignore"):
        found = kept.find(signature)
        if found is None:
            found, check = _made(signature, few)
            kept.keep(signature, found, check)
    return found


def _made(signature: Signature, few: bool) -> tuple[Traced | Refused, Check | None]:
    """A new trace, and how it is checked around other values."""
    sandbox = Sandbox()
    try:
        return _traced(signature, sandbox, few)
    except Refusal as refusal:
        return Refused(str(refusal), sandbox.dependencies, refusal.by_check), None
    except Exception as error:
        place = raised_at(error.__traceback__)
        what = f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
        reason = (
            f"raised {what}{f' at {place}' if place else ''} when it was called with symbols; "
            "use numpy, math and plain Python on them"
        )
        return Refused(reason, sandbox.dependencies), None
    finally:
        sandbox.close()


def _traced(signature: Signature, sandbox: Sandbox, few: bool) -> tuple[Traced, Check]:
    graph = _core.Graph()
    symbols = Symbols(graph, signature)
    function = sandbox.form_of(signature.function, _name(signature.function))
    arguments, options, _ = symbols.arguments()
    if signature.owner is not None:
        arguments.insert(0, sandbox.form_of(signature.owner, "self"))
    returned = call(
        signature, function, arguments, options, lambda shape: array(np.full(shape, np.nan))
    )
    result = result_of(signature, returned)
    sandbox.refuse_writes()
    if signature.result_size is not None and signature.kind in ("vector", "matrix"):
        _require_size(result, signature.result_size)
    _require_shape(result, signature.result_shape)
    _to_nodes(graph, result)
    tape = graph.tape(result.numbers)
    check = Check(tape, result, functools.partial(Bounds, graph, symbols.variables))
    compared = _compared(check, signature, few)
    guard = residuals.jump if getattr(signature.function, "jumps", False) else residuals.residual
    return _outcome(graph, tape, result, sandbox, compared, guard), check


def _compared(check: Check, signature: Signature, few: bool) -> int:
    try:
        return check.run(signature, few)
    except Refusal as refusal:
        refusal.by_check = True
        raise


def _name(function: Callable[..., Any]) -> str:
    return getattr(function, "__name__", type(function).__name__)


def _require_size(result: Result, size: int) -> None:
    if len(result.numbers) != size:
        raise Refusal(f"returns {len(result.numbers)} numbers, expected {size}")


def _require_shape(result: Result, shape: tuple[int, ...] | None) -> None:
    if shape is not None and in_other_order(result.shape, shape):
        raise Refusal(f"returns an array of shape {result.shape}, expected {tuple(shape)}")


def _to_nodes(graph: Any, result: Result) -> None:
    result.numbers = [
        number.node if type(number) is Symbol else graph.constant(float(number))
        for number in result.numbers
    ]


def _outcome(
    graph: Any,
    tape: Any,
    result: Result,
    sandbox: Sandbox,
    compared: int,
    guard: Callable[[Any, list[int]], Any],
) -> Traced:
    numbers_are_truths = (
        not result.boolean
        and not result.written
        and residuals.stand_for_truths(graph, result.numbers)
    )
    truths = (result.boolean and not result.written) or numbers_are_truths
    return Traced(
        tape=tape,
        shape=result.shape,
        boolean=result.boolean,
        numbers_are_truths=numbers_are_truths,
        residual=guard(graph, result.numbers) if truths else None,
        relations=relations.find(_core.Graph, graph, result.numbers) if truths else None,
        wrote_x="x" in result.written,
        wrote_z="z" in result.written,
        wrote_mode="m" in result.written,
        dependencies=sandbox.dependencies,
        compared=compared,
    )
