"""The operators of symbols and arrays, and numpy's ufuncs on them, entry by entry."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from saltus.tracing.array import SymbolArray, array, as_array, objects_of, wrapped
from saltus.tracing.refusal import refuse
from saltus.tracing.scalars import NUMPY, SCALARS, is_number, whole
from saltus.tracing.symbol import Symbol

UFUNCS: dict[np.ufunc, str] = {
    function: name for name, function in NUMPY.items() if isinstance(function, np.ufunc)
}
"""numpy's ufunc -> what it is called in SCALARS"""
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


def _bitwise(name: str, logical: str) -> None:
    """& | ^ ~ of truths; of integers they are refused."""

    def function(*arguments: Any) -> Any:
        if not any(type(a) is Symbol for a in arguments):
            return {"and": np.bitwise_and, "or": np.bitwise_or, "xor": np.bitwise_xor,
                    "invert": np.invert}[name](*arguments)  # fmt: skip
        kinds = {a.kind if type(a) is Symbol else as_array(a).kind for a in arguments}
        if kinds != {"b"}:
            refuse(f"computes bitwise ({name}) with integers or reals", "use arithmetic")
        if name == "invert" and arguments[0].python:
            refuse("inverts a Python bool by ~, which gives -1 or -2", "use np.logical_not")
        return SCALARS[logical](*arguments)

    SCALARS[name] = function


for _name, _logical in (
    ("and", "logical_and"), ("or", "logical_or"), ("xor", "logical_xor"), ("invert", "logical_not")
):  # fmt: skip
    _bitwise(_name, _logical)

_ON_ARRAYS: dict[str, Any] = {}


def _on_arrays(name: str, count: int) -> Any:
    """SCALARS[name], broadcast over arrays of objects by numpy."""
    if name not in _ON_ARRAYS:
        _ON_ARRAYS[name] = np.frompyfunc(SCALARS[name], count, 1)
    return _ON_ARRAYS[name]


def apply(name: str, *arguments: Any) -> Any:
    """The operation on numbers and arrays of any shapes that broadcast."""
    for a in arguments:
        if not is_number(a):
            break
    else:
        return SCALARS[name](*arguments)
    parts = [objects_of(as_array(a)) for a in arguments]
    return wrapped(_on_arrays(name, len(parts))(*parts))


def call_ufunc(ufunc: np.ufunc, *arguments: Any, out: Any = None, **options: Any) -> Any:
    """What a ufunc called with symbols gives."""
    where = options.pop("where", True)
    dtype = options.pop("dtype", None)
    if options or where is not True:
        refuse(f"calls np.{ufunc.__name__} with {', '.join(options) or 'where'}", "leave that out")
    if len(arguments) > ufunc.nin:  # the output as a positional argument
        arguments, out = arguments[: ufunc.nin], arguments[ufunc.nin]
    if ufunc in (np.divmod, np.modf):
        return _two(ufunc, arguments)
    if ufunc is np.matmul:
        from saltus.tracing.products import matmul

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


def _array_ufunc(self: Any, ufunc: np.ufunc, method: str, *inputs: Any, **options: Any) -> Any:
    if method != "__call__":
        return reduce_ufunc(ufunc, method, *inputs, **options)
    return call_ufunc(ufunc, *inputs, **options)


def reduce_ufunc(ufunc: np.ufunc, method: str, *arguments: Any, **options: Any) -> Any:
    """np.add.reduce(x) and the like, on the entries as objects."""
    name = UFUNCS.get(ufunc)
    if name is None or method not in ("reduce", "accumulate", "outer"):
        refuse(f"calls np.{ufunc.__name__}.{method}, which has no symbolic form")
    if method == "outer":
        a, b = (as_array(x) for x in arguments)
        return apply(name, a.reshape(a.shape + (1,) * b.ndim), b)
    from saltus.tracing.reductions import fold

    return fold(name, method == "accumulate", *arguments, **options)


def _array_function(self: Any, function: Any, types: Any, args: Any, options: Any) -> Any:
    from saltus.tracing.functions import call_function

    return call_function(function, args, options)


def _operand(self: Any, other: Any) -> bool:
    """Whether the operator works; numpy's numbers and arrays take lists, Python's floats do not."""
    if is_number(other) or isinstance(other, (SymbolArray, np.ndarray)):
        return True
    takes_lists = isinstance(self, SymbolArray) or not self.python
    return takes_lists and isinstance(other, (list, tuple))


def _forward(name: str) -> Callable[[Any, Any], Any]:
    def operate(self: Any, other: Any) -> Any:
        return apply(name, self, other) if _operand(self, other) else NotImplemented

    return operate


def _backward(name: str) -> Callable[[Any, Any], Any]:
    def operate(self: Any, other: Any) -> Any:
        return apply(name, other, self) if _operand(self, other) else NotImplemented

    return operate


def _in_place(name: str) -> Callable[[Any, Any], Any]:
    def operate(self: Any, other: Any) -> Any:
        if not _operand(self, other):
            return NotImplemented
        result = apply(name, self, other)
        if "bif".index(self.kind) < "bif".index(as_array(result).kind):
            raise TypeError(f"cannot {name} in place to an array of {self.dtype}")
        self[...] = result
        return self

    return operate


def _comparison(name: str, other_way: bool) -> Callable[[Any, Any], Any]:
    def operate(self: Any, other: Any) -> Any:
        if _operand(self, other):
            return apply(name, self, other)
        if isinstance(self, SymbolArray):
            refuse(f"compares an array with {type(other).__name__}", "compare it with numbers")
        return other_way

    return operate


BINARY = {
    "add": "add", "sub": "sub", "mul": "mul", "truediv": "div", "floordiv": "floor_divide",
    "mod": "mod", "pow": "pow", "and": "and", "or": "or", "xor": "xor",
}  # fmt: skip


def _ordered(name: str) -> Callable[[Any, Any], Any]:
    return _forward(name)


def _round(self: Any, digits: int | None = None) -> Any:
    if digits:
        refuse("rounds to decimal places", "use np.round")
    if isinstance(self, SymbolArray):
        return apply("rint", self)
    if digits is None:
        return whole("rint", self).numpy("i")
    return SCALARS["rint"](self)


def _modulo(self: Any, other: Any) -> Any:
    return apply("floor_divide", self, other), apply("mod", self, other)


def _whole(name: str) -> Callable[[Any], Any]:
    def operate(self: Any) -> Any:
        result = whole(name, self)
        return Symbol(result.graph, result.node, "i", True)

    return operate


def install(cls: Any) -> None:
    """Give a class the operators and numpy's two protocols."""
    for method, name in BINARY.items():
        setattr(cls, f"__{method}__", _forward(name))
        setattr(cls, f"__r{method}__", _backward(name))
        if cls is SymbolArray:
            setattr(cls, f"__i{method}__", _in_place(name))
    for name in ("lt", "le", "gt", "ge"):
        setattr(cls, f"__{name}__", _ordered(name))
    cls.__eq__ = _comparison("eq", False)
    cls.__ne__ = _comparison("ne", True)
    for method, name in {"neg": "neg", "abs": "abs", "invert": "invert", "pos": "positive"}.items():
        setattr(cls, f"__{method}__", lambda self, name=name: apply(name, self))
    cls.__divmod__ = _modulo
    cls.__rdivmod__ = lambda self, other: _modulo(other, self)
    cls.__round__ = _round
    cls.__array_ufunc__ = _array_ufunc
    cls.__array_function__ = _array_function


install(Symbol)
install(SymbolArray)
for _method, _name in {"floor": "floor", "ceil": "ceil", "trunc": "trunc"}.items():
    setattr(Symbol, f"__{_method}__", _whole(_name))
