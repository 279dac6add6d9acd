"""numpy's ufuncs, their reductions too, called with symbols."""

from __future__ import annotations

from typing import Any

import numpy as np

from saltus.tracing.numbers.arrays import SymbolArray, array, as_array, wrapped
from saltus.tracing.numbers.entrywise import apply
from saltus.tracing.numbers.products import matmul
from saltus.tracing.numbers.reductions import fold
from saltus.tracing.numbers.scalars import NUMPY
from saltus.tracing.numbers.symbol import Symbol
from saltus.tracing.refusal import refuse

__all__ = ["call_ufunc", "reduce_ufunc"]

UFUNCS: dict[np.ufunc, str] = {
    function: name for name, function in NUMPY.items() if isinstance(function, np.ufunc)
}
"""numpy's ufunc -> its name in SCALARS"""
UFUNCS.update(
    {
        np.absolute: "abs", np.fabs: "abs", np.remainder: "mod", np.float_power: "pow",
        np.logical_xor: "logical_xor", np.square: "square", np.reciprocal: "reciprocal",
        np.positive: "positive", np.fmax: "fmax", np.fmin: "fmin", np.deg2rad: "deg2rad",
        np.radians: "deg2rad", np.rad2deg: "rad2deg", np.degrees: "rad2deg",
        np.logaddexp: "logaddexp", np.heaviside: "heaviside", np.isnan: "isnan",
        np.isinf: "isinf", np.isfinite: "isfinite", np.signbit: "signbit",
        np.conjugate: "positive", np.bitwise_and: "and", np.bitwise_or: "or",
        np.bitwise_xor: "xor", np.invert: "invert",
    }
)  # fmt: skip


def call_ufunc(ufunc: np.ufunc, *arguments: Any, out: Any = None, **options: Any) -> Any:
    """The result of a ufunc called with symbols."""
    where = options.pop("where", True)
    dtype = options.pop("dtype", None)
    if options or where is not True:
        refuse(f"calls np.{ufunc.__name__} with {', '.join(options) or 'where'}", "leave that out")
    if len(arguments) > ufunc.nin:  # the output as a positional argument
        arguments, out = arguments[: ufunc.nin], arguments[ufunc.nin]
    if ufunc in (np.divmod, np.modf):
        return _two(ufunc, arguments)
    if ufunc is np.matmul:
        result = matmul(*arguments)
    elif ufunc in UFUNCS:
        result = _as_numpy(apply(UFUNCS[ufunc], *arguments))
    else:
        refuse(f"calls np.{ufunc.__name__}, which has no symbolic form")
    if dtype is not None and result is not None:
        result = result.astype(dtype) if isinstance(result, SymbolArray) else wrapped(
            array(result, np.dtype(dtype).kind).data
        )  # fmt: skip
    return result if out is None else _written(out, result)


def _as_numpy(result: Any) -> Any:
    return result.numpy() if type(result) is Symbol else result


def _written(out: Any, result: Any) -> Any:
    if isinstance(out, tuple):
        (out,) = out
    if not isinstance(out, SymbolArray):
        refuse("writes to an array from outside", "what changes something outside is called")
    out[...] = result
    return out


def _two(ufunc: np.ufunc, arguments: tuple[Any, ...]) -> tuple[Any, Any]:
    if ufunc is np.divmod:
        return apply("floor_divide", *arguments), apply("mod", *arguments)
    integral = apply("trunc", *arguments)
    return apply("sub", *arguments, integral), integral


def reduce_ufunc(ufunc: np.ufunc, method: str, *arguments: Any, **options: Any) -> Any:
    """np.add.reduce(x) and similar reductions, on the entries as objects."""
    name = UFUNCS.get(ufunc)
    if name is None or method not in ("reduce", "accumulate", "outer"):
        refuse(f"calls np.{ufunc.__name__}.{method}, which has no symbolic form")
    if method == "outer":
        a, b = (as_array(x) for x in arguments)
        return apply(name, a.reshape(a.shape + (1,) * b.ndim), b)
    return fold(name, method == "accumulate", *arguments, **options)
