"""numpy's functions on symbols: some run on arrays of objects unchanged, others are written here.

A function that is called with known numbers only is computed by numpy itself.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from saltus.tracing.numbers import choices, products, solving
from saltus.tracing.numbers.arrays import (
    SymbolArray,
    array,
    as_array,
    index_of,
    is_known,
    kind_of_type,
    known,
    objects_of,
    wrapped,
)
from saltus.tracing.numbers.entrywise import apply
from saltus.tracing.numbers.reductions import REDUCTIONS
from saltus.tracing.numbers.scalars import is_number
from saltus.tracing.numbers.symbol import Symbol, joint
from saltus.tracing.numbers.ufuncs import call_ufunc
from saltus.tracing.refusal import refuse

__all__ = ["call_function", "has_symbols", "owned", "plain"]

ARRANGING = """
    append argwhere array_split atleast_1d atleast_2d atleast_3d block broadcast_arrays broadcast_to
    column_stack concatenate convolve cross delete diag diagflat diagonal diff dsplit dstack ediff1d
    einsum expand_dims flip fliplr flipud hsplit hstack insert kron meshgrid moveaxis pad polyval
    ravel repeat reshape resize roll rollaxis rot90 split squeeze stack swapaxes take tensordot
    tile trace transpose trapezoid trapz tri tril triu vander vsplit vstack
""".split()
"""numpy's functions that only arrange entries, or add and multiply them"""

EFFECTS = """
    copyto fill_diagonal fromfile genfromtxt info load loadtxt memmap place put put_along_axis
    putmask save savetxt savez savez_compressed set_printoptions seterr seterrcall setbufsize
    show_config show_runtime
""".split()
"""numpy's functions that change an argument or have other effects"""


def has_symbols(value: Any) -> bool:
    if isinstance(value, SymbolArray):
        return not is_known(value.data)
    if isinstance(value, (list, tuple)):
        return any(has_symbols(item) for item in value)
    if isinstance(value, dict):
        return any(has_symbols(item) for item in value.values())
    return type(value) is Symbol


def plain(value: Any) -> Any:
    """The same with numpy's own arrays, where no entry is symbolic."""
    if isinstance(value, SymbolArray):
        return known(value, "uses values")
    if isinstance(value, (list, tuple)) and any(isinstance(v, (SymbolArray, list)) for v in value):
        return [plain(item) for item in value]
    return value


def _boxed(value: Any, kind: str, outermost: bool = True) -> Any:
    """The value with arrays of objects; `kind` is the kind of all of them together."""
    if isinstance(value, SymbolArray):
        return (value if value.kind == kind else array(value, kind)).data
    if isinstance(value, (list, tuple)):
        if not outermost and all(is_number(item) for item in value):
            return objects_of(value)
        return [_boxed(item, kind, False) for item in value]
    # numpy would ask a bare symbol how to do it, and so come back here
    return objects_of(value) if type(value) is Symbol else value


def _arrays_in(value: Any) -> list[SymbolArray]:
    if isinstance(value, (list, tuple)):
        return [found for item in value for found in _arrays_in(item)]
    return [as_array(value)] if isinstance(value, (SymbolArray, Symbol)) else []


def _returned(result: Any, source: list[SymbolArray]) -> Any:
    """The result of numpy's function on objects as an array of symbols; a view remains a view."""
    if isinstance(result, (list, tuple)):
        return [_returned(item, source) for item in result]
    if isinstance(result, np.ndarray) and result.dtype != object:
        return array(result)
    if len(source) == 1 and isinstance(result, np.ndarray) and result.ndim:
        one = source[0]
        if np.may_share_memory(result, one.data):
            return SymbolArray(result, one.kind, one.frozen)
    return wrapped(result)


def _arrange(function: Callable[..., Any], args: Any, options: Any) -> Any:
    args = tuple(index_of(a) if i and not has_symbols(a) else a for i, a in enumerate(args))
    source = _arrays_in(list(args))
    kind = joint(*{a.kind for a in source} or "f")
    if options.get("out") is not None:
        refuse(f"calls np.{function.__name__} with `out`", "assign the result")
    return _returned(function(*(_boxed(a, kind) for a in args), **options), source)


def call_function(function: Callable[..., Any], args: Any, options: Any) -> Any:
    """The result of numpy's function for these arguments, with symbols among them or without."""
    name = function.__name__
    if name in EFFECTS:
        refuse(f"calls np.{name}, which changes something", "such a function is called")
    if name in ALIASING or has_symbols(args) or has_symbols(options):
        if name in FUNCTIONS:
            return FUNCTIONS[name](*args, **options)
        if name in ARRANGING:
            return _arrange(function, args, options)
        refuse(f"calls np.{name}, which has no symbolic form", "write it out, or leave it called")
    if name in ARRANGING and _arrays_in(list(args)):
        return _arrange(function, args, options)
    result = function(*plain(tuple(args)), **{key: plain(v) for key, v in options.items()})
    return owned(result)


def owned(result: Any) -> Any:
    if isinstance(result, (list, tuple)):
        return type(result)(*map(owned, result)) if hasattr(result, "_fields") else type(result)(
            [owned(item) for item in result]
        )  # fmt: skip
    return array(result) if isinstance(result, np.ndarray) else result


def _array(value: Any, dtype: Any = None, *, copy: Any = True, ndmin: int = 0, **o: Any) -> Any:
    kind = "" if dtype is None else kind_of_type(dtype)
    if copy is not True and isinstance(value, SymbolArray) and kind in ("", value.kind):
        return value
    made = array(value, kind)
    return made.reshape((1,) * (ndmin - made.ndim) + made.shape) if ndmin > made.ndim else made


def _as_array(value: Any, dtype: Any = None, **options: Any) -> Any:
    return _array(value, dtype, copy=None)


def _copy(a: Any, **options: Any) -> Any:
    return as_array(a).copy()


def _empty(shape: Any, dtype: Any = float, **options: Any) -> Any:
    return array(np.full(shape, np.nan if kind_of_type(dtype) == "f" else 0, dtype))


def _full(shape: Any, fill_value: Any, dtype: Any = None, **options: Any) -> Any:
    value = as_array(fill_value) if dtype is None else array(fill_value, kind_of_type(dtype))
    return array(SymbolArray(np.broadcast_to(value.data, shape), value.kind))


def _like(number: float) -> Callable[..., Any]:
    def function(a: Any, dtype: Any = None, shape: Any = None, **options: Any) -> Any:
        a = as_array(a)
        kind = a.kind if dtype is None else kind_of_type(dtype)
        filled = 0.0 if kind != "f" and number != number else number
        return array(np.full(a.shape if shape is None else shape, filled), kind)

    return function


def _full_like(a: Any, fill_value: Any, dtype: Any = None, **options: Any) -> Any:
    a = as_array(a)
    return array(_full(a.shape, fill_value), a.kind if dtype is None else kind_of_type(dtype))


def _linspace(start: Any, stop: Any, num: int = 50, endpoint: bool = True, **o: Any) -> Any:
    if o:
        refuse("calls np.linspace of values with options", "write it out")
    step = apply("div", stop - start, float(num - 1 if endpoint else num))
    return apply("add", apply("mul", np.arange(num), step), start)


def _method(name: str) -> Callable[..., Any]:
    return lambda a, *rest, **options: getattr(as_array(a), name)(*rest, **options)


def _ndim(a: Any) -> int:
    return objects_of(a).ndim


ALIASING = {"array", "asarray", "asanyarray", "ascontiguousarray", "empty", "copy"}
"""these never give numpy's own array: it could not take a symbol later"""

FUNCTIONS: dict[str, Callable[..., Any]] = {
    **REDUCTIONS,
    "amin": REDUCTIONS["min"],
    "amax": REDUCTIONS["max"],
    "array": _array,
    "asarray": _as_array,
    "asanyarray": _as_array,
    "ascontiguousarray": _as_array,
    "copy": _copy,
    "empty": _empty,
    "full": _full,
    "zeros_like": _like(0),
    "ones_like": _like(1),
    "empty_like": _like(np.nan),  # so that the check sees an entry nobody has written
    "full_like": _full_like,
    "linspace": _linspace,
    "dot": products.dot,
    "inner": products.inner,
    "vdot": products.vdot,
    "outer": products.outer,
    "multi_dot": products.multi_dot,
    "matrix_power": products.matrix_power,
    "norm": products.norm,
    "solve": solving.solve,
    "inv": solving.inv,
    "det": solving.det,
    "shape": lambda a: objects_of(a).shape,
    "ndim": _ndim,
    "isscalar": lambda a: not isinstance(a, (SymbolArray, list, tuple)),
    "iscomplexobj": lambda a: False,
    "size": lambda a: objects_of(a).size,
    "real": lambda a: a,
    "sinc": lambda a: apply("sinc", a),
    "fix": lambda a: call_ufunc(np.trunc, a),
    "astype": _method("astype"),
    **choices.CHOICES,
}
"""numpy's name of a function -> its form for symbols"""
