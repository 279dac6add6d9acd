"""How far two evaluations of one tape may be apart by rounding alone.

A running error analysis (Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., 3.3):
beside each value goes a bound of its error, which the next operation carries on and adds to.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from saltus.tracing.arguments import Point
from saltus.tracing.numbers import NUMPY

__all__ = ["ULPS", "Bounds"]

Numbers = NDArray[np.float64]

ULPS = 4.0 * np.finfo(float).eps
"""relative error of one operation: numpy's own loops over arrays err by up to 4 units in the last
place, the C library's functions by less than one
"""

EXACT = {"neg", "abs", "floor", "ceil", "trunc", "rint", "sign", "copysign", "minimum", "maximum",
         "select", "lt", "le", "gt", "ge", "eq", "ne", "logical_and", "logical_or",
         "logical_not"}  # fmt: skip

SLOPE_ONE = {"add", "sub", "neg", "abs", "minimum", "maximum", "sin", "cos"}


def _select(condition: Any, yes: Any, no: Any) -> Any:
    return np.where(condition != 0, yes, no)


def operation(name: str, *operands: Any) -> Numbers:
    """The value of a node, for the values of its operands."""
    function = _select if name == "select" else NUMPY[name]
    return np.asarray(function(*operands), dtype=float)


def _new_error(name: str, value: Numbers, operands: Sequence[Numbers]) -> Any:
    if name in EXACT:
        return 0.0
    if name in ("add", "sub"):  # relative to the operands: a sum may be taken in another order
        return ULPS * (np.abs(operands[0]) + np.abs(operands[1]))
    return ULPS * np.abs(value)


def _carried(name: str, value: Numbers, operands: Sequence[Numbers], k: int, error: Any) -> Any:
    """How far the value moves when operand k moves by its error."""
    if not error.any():
        return 0.0
    if name in SLOPE_ONE:  # at most; the ends of a long way through a sine would say nothing
        return error
    if name == "mul":
        return np.abs(operands[1 - k]) * error
    far: Any = error if name in ("mod", "fmod", "tan") else 0.0  # these come back on their way
    for part in (1.0, -1.0, 0.5, -0.5, 0.1, -0.1):
        moved = list(operands)
        moved[k] = operands[k] + part * error
        far = np.maximum(far, np.abs(operation(name, *moved) - value))
    return far


class Bounds:
    """Values and bounds of nodes at several points at once."""

    def __init__(self, graph: Any, variables: dict[int, tuple[str, int, int]], at: list[Point]):
        self._graph = graph
        self._variables = variables
        self._points = at
        self._known: dict[int, tuple[Numbers, Numbers]] = {}

    def _variable(self, kind: str, first: int, second: int) -> Numbers:
        def one(at: Point) -> float:
            if kind in ("time", "mode", "entry"):
                return float(getattr(at, kind))
            if kind == "input":
                return float(at.u[first][second])
            name = {"continuous_state": "x", "discrete_state": "z", "parameter": "p"}[kind]
            return float(getattr(at, name)[first])

        return np.array([one(at) for at in self._points])

    def _leaf(self, node: int) -> Numbers | None:
        number = self._graph.value(node)
        if number is not None:
            return np.full(len(self._points), number)
        return self._variable(*self._variables[node]) if node in self._variables else None

    def of(self, node: int) -> tuple[Numbers, Numbers]:
        """Values of a node, and bounds of their errors; not finite where rounding may decide."""
        waiting = [node]
        while waiting:
            current = waiting[-1]
            if current in self._known:
                waiting.pop()
                continue
            leaf = self._leaf(current)
            if leaf is not None:
                self._known[current] = (leaf, np.zeros(len(self._points)))
                continue
            name, operands = self._graph.operation(current)
            missing = [n for n in operands if n not in self._known]
            waiting += missing
            if not missing:
                self._known[current] = self._computed(name, [self._known[n] for n in operands])
        return self._known[node]

    def _computed(self, name: str, parts: list[tuple[Numbers, Numbers]]) -> tuple[Numbers, Numbers]:
        operands = [value for value, _ in parts]
        value = operation(name, *operands)
        bound = _new_error(name, value, operands)
        for k, (_, error) in enumerate(parts):
            bound = bound + _carried(name, value, operands, k, error)
        return value, np.where(np.isfinite(value), bound, 0.0)
