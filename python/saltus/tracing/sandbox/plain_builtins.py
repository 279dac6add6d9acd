"""Python's builtins for symbols: which are used as they are, and which have a form of their own."""

from __future__ import annotations

import builtins
import sys
from collections.abc import Callable
from typing import Any

import numpy as np

from saltus.tracing.numbers import SCALARS, Symbol, SymbolArray, is_number, kind_of, truth, whole
from saltus.tracing.refusal import refuse
from saltus.tracing.sandbox.guarded import Guarded, parent, unguarded

__all__ = ["REPLACED", "SAFE"]

SAFE = set(
    """
    abs all any ascii bytes callable chr classmethod complex dict divmod enumerate filter format
    frozenset getattr hasattr iter len list map next object ord property range repr reversed round
    set slice sorted staticmethod str sum tuple zip True False None Ellipsis NotImplemented
    __debug__ __build_class__ __name__ __doc__
    """.split()
)


def _as_python(value: Any, kind: str) -> Symbol:
    return Symbol(value.graph, value.node, kind, True)


def _single(value: Any) -> Any:
    return value._one() if isinstance(value, SymbolArray) else value


def _extreme(name: str, better: str) -> Callable[..., Any]:
    """Python's min or max: the first of the best, found by comparisons from left to right."""
    real = getattr(builtins, name)

    def function(*arguments: Any, **options: Any) -> Any:
        items = list(arguments[0]) if len(arguments) == 1 else list(arguments)
        if not any(isinstance(item, (Symbol, SymbolArray)) for item in items):
            return real(*arguments, **options)
        if options:
            refuse(f"calls {name} of values with {', '.join(options)}", f"use {name} alone")
        if len({kind_of(_single(item)) == "b" for item in items}) > 1:
            refuse(f"takes the {name} of truths and numbers", "multiply the truths by 1.0 first")
        best = _single(items[0])
        for item in map(_single, items[1:]):
            best = SCALARS["select"](SCALARS[better](item, best), item, best)
        return best

    return function


class _Converted(type):
    """Makes `isinstance(x, float)` true for a symbol of kind float."""

    kinds: str
    real: type

    def __instancecheck__(cls, value: Any) -> bool:
        return is_instance(value, cls.real)

    def __call__(cls, *arguments: Any, **options: Any) -> Any:
        value = _single(arguments[0]) if arguments else None
        return cls.convert(value) if type(value) is Symbol else cls.real(*arguments, **options)

    convert: Callable[[Any], Any]


def _to_float(value: Symbol) -> Any:
    return _as_python(value, "f")


def _to_int(value: Symbol) -> Any:
    return _as_python(whole("trunc", value) if value.kind == "f" else value, "i")


def _to_bool(value: Symbol) -> Any:
    return _as_python(truth(value), "b")


class Float(metaclass=_Converted):
    """float"""

    real = float
    dtype = np.dtype(float)  # numpy uses the dtype of any object that has one
    convert = staticmethod(_to_float)


class Int(metaclass=_Converted):
    """int"""

    real = int
    dtype = np.dtype(int)  # numpy uses the dtype of any object that has one
    convert = staticmethod(_to_int)


class Bool(metaclass=_Converted):
    """bool"""

    real = bool
    dtype = np.dtype(bool)  # numpy uses the dtype of any object that has one
    convert = staticmethod(_to_bool)


def _types_of(symbol: Symbol) -> type:
    python = {"f": float, "i": int, "b": bool}
    return (python if symbol.python else {"f": np.float64, "i": np.int64, "b": np.bool_})[
        symbol.kind
    ]


def is_instance(value: Any, kinds: Any) -> bool:
    """isinstance; the type of a symbol is the type of the number in its place."""
    if isinstance(kinds, tuple):
        return any(is_instance(value, kind) for kind in kinds)
    kind = _real_class(kinds)
    if type(value) is Symbol and isinstance(kind, type):
        return issubclass(_types_of(value), kind)
    if type(value) is SymbolArray and kind is np.ndarray:
        return True
    return isinstance(unguarded(value), kind)


def _real_class(kind: Any) -> Any:
    """The class whose face this is."""
    if type(kind) is _Converted:
        return kind.real
    return getattr(kind, "type", unguarded(kind)) if type(kind) is not Guarded else unguarded(kind)


def _type(*arguments: Any) -> Any:
    if len(arguments) == 1 and type(arguments[0]) is Guarded:
        return arguments[0].__class__
    if len(arguments) == 1 and not isinstance(arguments[0], (Symbol, SymbolArray)):
        return type(arguments[0])
    refuse("asks for the type of a value", "use isinstance")


def _pow(base: Any, exponent: Any, modulus: Any = None) -> Any:
    if modulus is not None and not is_number(modulus):
        refuse("calls pow with a modulus", "use %")
    return pow(base, exponent) if modulus is None else pow(base, exponent, modulus)


def _super(*arguments: Any) -> Any:
    """super(): the same object, with attributes from the classes after that of the method."""
    if not arguments:
        frame = sys._getframe(1)
        arguments = frame.f_locals["__class__"], frame.f_locals[frame.f_code.co_varnames[0]]
    after, value = arguments
    if type(value) is not Guarded:
        refuse("uses super() of a new object", "call the class by its name")
    return parent(value, unguarded(after))


REPLACED: dict[str, Any] = {
    "super": _super,
    "min": _extreme("min", "lt"),
    "max": _extreme("max", "gt"),
    "float": Float,
    "int": Int,
    "bool": Bool,
    "isinstance": is_instance,
    "type": _type,
    "pow": _pow,
}
