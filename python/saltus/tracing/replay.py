"""`Replay`: the reads of one trace, made again for another function of the same code."""

from __future__ import annotations

from types import FunctionType, MethodType
from typing import Any

import numpy as np

from saltus.tracing.effects import only_attributes
from saltus.tracing.sandbox import PLAIN, Dependencies, same, same_content
from saltus.tracing.signature import Signature

__all__ = ["Replay"]

NUMBERS = (int, float, complex, np.number)  # a bool decides, a number is one


class Replay:
    """Pairs the objects that one function reads with those that the other one reads.

    Blocks of one class, functions of one code and their variables are pairs: what is read from them
    is compared, not they themselves.
    """

    def __init__(self, one: Signature, other: Signature, exact: bool):
        self._exact = exact
        """whether numbers have to be equal; else only their types and sizes"""
        self._pairs: dict[int, Any] = {}
        self._kept: list[Any] = []  # so that no identity is used twice
        self._paired = self._pair(one.function, other.function) and (
            one.owner is None or self._pair(one.owner, other.owner)
        )

    def dependencies(self, dependencies: Dependencies) -> Dependencies | None:
        """The objects that the other function reads, if it is the same; or nothing."""
        return dependencies.moved(self._moved, self._equal) if self._paired else None

    def _moved(self, value: Any) -> Any:
        """The object of the other function in place of one of this function."""
        return self._pairs.get(id(value), value)

    def _equal(self, value: Any, other: Any, inside: Any) -> bool:
        if value is other and inside is None:
            return True
        if type(value) is not type(other):
            return False
        if isinstance(value, PLAIN):
            return same(value, other) or (not self._exact and self._is_number(value))
        if inside is not None:
            return same_content(other, inside) or (not self._exact and _alike(value, other))
        return self._pair(value, other)

    @staticmethod
    def _is_number(value: Any) -> bool:
        return isinstance(value, NUMBERS) and not isinstance(value, bool)

    def _pair(self, value: Any, other: Any) -> bool:
        """Whether two objects may take each other's place if the values read are equal."""
        if value is other:
            return True
        if id(value) in self._pairs:
            return self._pairs[id(value)] is other
        if type(value) is not type(other) or isinstance(value, type):
            return False
        if isinstance(value, FunctionType):
            return self._pair_functions(value, other)
        if isinstance(value, MethodType):
            return self._pair(value.__func__, other.__func__) and self._pair(
                value.__self__, other.__self__
            )
        if not only_attributes(type(value)) or not hasattr(value, "__dict__"):
            return False  # such as two functions of NumPy
        self._note(value, other)
        self._note(value.__dict__, other.__dict__)
        return True

    def _pair_functions(self, value: FunctionType, other: FunctionType) -> bool:
        if value.__code__ is not other.__code__ or value.__globals__ is not other.__globals__:
            return False
        self._note(value, other)
        for mine, its in zip(value.__closure__ or (), other.__closure__ or (), strict=True):
            self._note(mine, its)
        return True

    def _note(self, value: Any, other: Any) -> None:
        self._pairs[id(value)] = other
        self._kept += (value, other)


def _alike(value: Any, other: Any) -> bool:
    """Containers of the same form, whose numbers may differ."""
    if type(value) is not type(other):
        return False
    if isinstance(value, np.ndarray):
        return bool(value.shape == other.shape and value.dtype == other.dtype)
    if isinstance(value, dict):
        return value.keys() == other.keys() and all(_alike(value[k], other[k]) for k in value)
    if isinstance(value, (list, tuple)):
        return len(value) == len(other) and all(map(_alike, value, other))
    if Replay._is_number(value):
        return True
    return same(value, other)
