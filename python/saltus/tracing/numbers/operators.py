"""The operators and methods of symbols and arrays, in one table for each of the two classes.

They call functions that make symbols and arrays themselves. The classes cannot name these
functions, so this module, the last one of the folder, gives them to the classes.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from saltus.tracing.numbers import choices, products
from saltus.tracing.numbers.arrays import LARGEST_TABLE, SymbolArray, as_array, objects_of
from saltus.tracing.numbers.entrywise import apply
from saltus.tracing.numbers.functions import call_function
from saltus.tracing.numbers.reductions import REDUCTIONS
from saltus.tracing.numbers.scalars import SCALARS, cast, is_number, whole
from saltus.tracing.numbers.symbol import Symbol
from saltus.tracing.numbers.ufuncs import call_ufunc, reduce_ufunc
from saltus.tracing.refusal import refuse

__all__ = ["ON_ARRAYS", "ON_BOTH", "ON_SYMBOLS"]


METHODS_OF_ONE = set(
    """
    all any astype copy dot flatten max mean min prod ravel reshape squeeze std sum tolist
    transpose var
    """.split()
)
"""methods of numpy's numbers, which are those of an array of one entry"""


def _array_ufunc(self: Any, ufunc: np.ufunc, method: str, *inputs: Any, **options: Any) -> Any:
    if method != "__call__":
        return reduce_ufunc(ufunc, method, *inputs, **options)
    return call_ufunc(ufunc, *inputs, **options)


def _array_function(self: Any, function: Any, types: Any, args: Any, options: Any) -> Any:
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


def _unary(name: str) -> Callable[[Any], Any]:
    return lambda self: apply(name, self)


def _round_method(self: Any, decimals: int = 0) -> Any:
    return choices.round_(self, decimals)


def _missing(self: Symbol, name: str) -> Any:
    """`METHODS_OF_ONE`, unless the symbol is a Python float, int or bool."""
    if self.python or name not in METHODS_OF_ONE:
        kind = {"f": "float", "i": "int", "b": "bool"}[self.kind]
        raise AttributeError(f"'{kind}' object has no attribute '{name}'")
    return getattr(as_array(self), name)


def _looked_up(self: SymbolArray, key: Symbol) -> Any:
    """Entry (or row) `key`, an integer that is not known, such as the mode.

    NaN beyond the ends, for which numpy raises.
    """
    n = len(self.data)
    if key.kind != "i" or n > LARGEST_TABLE:
        key.__index__()  # refuses
    result: Any = np.nan
    for i in range(n):
        here = apply("logical_or", apply("eq", key, i), apply("eq", key, i - n))
        result = apply("select", here, self[i], result)
    if isinstance(result, SymbolArray):
        return SymbolArray(result.data, self.kind)
    return result.numpy(self.kind)


def _set_where(self: SymbolArray, mask: SymbolArray, value: Any) -> None:
    """x[mask] = number, for a mask that is not known."""
    if mask.shape != self.shape or objects_of(value).size != 1:
        refuse("sets several entries chosen by a value", "use np.where")
    number = cast(as_array(value)._one(), self.kind)
    self[...] = apply("select", mask, number, self)


BINARY = {
    "add": "add", "sub": "sub", "mul": "mul", "truediv": "div", "floordiv": "floor_divide",
    "mod": "mod", "pow": "pow", "and": "and", "or": "or", "xor": "xor",
}  # fmt: skip


"""Python's name of an operator -> its name in SCALARS"""
UNARY = {"neg": "neg", "abs": "abs", "invert": "invert", "pos": "positive"}

ON_BOTH: dict[str, Callable[..., Any]] = {
    **{f"__{method}__": _forward(name) for method, name in BINARY.items()},
    **{f"__r{method}__": _backward(name) for method, name in BINARY.items()},
    **{f"__{method}__": _unary(name) for method, name in UNARY.items()},
    **{f"__{name}__": _forward(name) for name in ("lt", "le", "gt", "ge")},
    "__eq__": _comparison("eq", False),
    "__ne__": _comparison("ne", True),
    "__divmod__": _modulo,
    "__rdivmod__": lambda self, other: _modulo(other, self),
    "__round__": _round,
    "__array_ufunc__": _array_ufunc,
    "__array_function__": _array_function,
    "round": _round_method,
    "clip": choices.clip,
}

ON_SYMBOLS: dict[str, Callable[..., Any]] = {
    **{f"__{name}__": _whole(name) for name in ("floor", "ceil", "trunc")},
    "__getattr__": _missing,
    "is_integer": lambda self: SCALARS["eq"](self, SCALARS["floor"](self)),
}

ON_ARRAYS: dict[str, Callable[..., Any]] = {
    **{f"__i{method}__": _in_place(name) for method, name in BINARY.items()},
    **{k: v for k, v in REDUCTIONS.items() if k not in ("ptp", "average", "gradient")},
    "__matmul__": lambda self, other: products.matmul(self, other),
    "__rmatmul__": lambda self, other: products.matmul(other, self),
    "dot": products.dot,
    "_looked_up": _looked_up,
    "_set_where": _set_where,
}

for _class, _methods in (
    (Symbol, ON_BOTH), (Symbol, ON_SYMBOLS), (SymbolArray, ON_BOTH), (SymbolArray, ON_ARRAYS)
):  # fmt: skip
    for _name, _method in _methods.items():
        setattr(_class, _name, _method)
