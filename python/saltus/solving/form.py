"""`Form`: the form in which the engine, which knows real states and increasing times, runs a call
of `solve` that is complex or goes back in time.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from saltus._declarations import places_of
from saltus.errors import ModelError

__all__ = ["PLAIN", "Form", "Names", "chosen", "form_of", "require_numbers"]

Function = Callable[..., Any]
Names = tuple[str, ...] | None
"""names of the values that a function gets by keyword; None if a run has no such values"""


@dataclass(frozen=True)
class Form:
    """The relation of the user's times and states to those of the engine.

    A run back in time counts s = -t, so dx/ds = -f(-s, x). A complex state of n numbers is a real
    state of 2n: the real and the imaginary part of each number, one after the other.
    """

    backward: bool = False
    is_complex: bool = False

    @property
    def plain(self) -> bool:
        """Whether nothing changes."""
        return not (self.backward or self.is_complex)

    def time(self, s: Any) -> Any:
        """t [s] from s, and s from t."""
        return -s if self.backward else s

    def state(self, x: Any) -> Any:
        """The user's state, which shares the memory of the engine's."""
        return x.view(complex) if self.is_complex else x

    def flat(self, x: ArrayLike) -> np.ndarray:
        """The engine's state from the user's."""
        if not self.is_complex:
            return np.asarray(x)
        return np.array(x, dtype=complex).reshape(-1).view(float)

    def value(self, function: Function, args: tuple[Any, ...], names: Names = None) -> Function:
        """function(t, x, *args) as a callback of a leaf, whose result stays as it is. It gets the
        values of `names`, parameters and the mode, by keyword.

        Such callbacks close over the user's function, this form and constants, and nothing else. So
        two callbacks that do the same share their traces.
        """
        if names is not None:
            return lambda time, state, /, **given: function(
                self.time(time),
                self.state(state.continuous_state),
                *args,
                **chosen(names, state, given),
            )
        if self.plain:
            return lambda time, state: function(time, state.continuous_state, *args)
        return lambda time, state: function(
            self.time(time), self.state(state.continuous_state), *args
        )

    def flow(self, function: Function, args: tuple[Any, ...], names: Names = None) -> Function:
        """dx/ds of the engine's state from function(t, x, *args), which returns dx/dt."""
        value = self.value(function, args, names)
        if self.plain:
            return value
        if names is not None:
            return lambda time, state, /, **given: self.rate(value(time, state, **given))
        return lambda time, state: self.rate(
            function(self.time(time), self.state(state.continuous_state), *args)
        )

    def rate(self, xdot: Any) -> Any:
        """dx/ds of the engine's state from dx/dt."""
        if self.plain:
            return xdot
        require_numbers("f", xdot)
        return self.time(self.flat(xdot))

    def matrix(
        self, function: Function, args: tuple[Any, ...], size: int, names: Names = None
    ) -> Function:
        """d(dx/ds)/dx of the engine's state from function(t, x, *args), which returns df/dx as an
        array, as a sparse matrix, or as a number for one state.
        """

        def entries(time: float, state: Any, /, **given: Any) -> Any:
            named = chosen(names, state, given)
            found = function(self.time(time), self.state(state.continuous_state), *args, **named)
            if hasattr(found, "toarray"):
                found = found.toarray()
            if self.plain:
                alone = size == 1 and np.ndim(found) == 0
                whole = alone and found is not None and not isinstance(found, (str, dict))
                return [[found]] if whole else found  # the engine refuses what is no number
            require_numbers("jacobian", found)
            if size == 1 and np.ndim(found) == 0:
                found = [[found]]
            return self.time(self._real(found, size))

        return entries

    def _real(self, matrix: ArrayLike, size: int) -> np.ndarray:
        """The matrix of real and imaginary parts: a + ib is the block ((a, -b), (b, a))."""
        if not self.is_complex:
            return np.asarray(matrix)
        given = np.asarray(matrix, dtype=complex)
        if given.shape != (size, size):
            raise ModelError(
                f"solve: jacobian returned shape {given.shape}, expected {(size, size)}"
            )
        real = np.empty((2 * given.shape[0], 2 * given.shape[1]))
        real[0::2, 0::2] = real[1::2, 1::2] = given.real
        real[1::2, 0::2] = given.imag
        real[0::2, 1::2] = -given.imag
        return real

    def places(self, sparsity: Any) -> Any:
        """The places of the engine's Jacobian from those of the user's."""
        if sparsity is None or not self.is_complex:
            return sparsity
        pairs = np.array(places_of("solve", sparsity), dtype=int).reshape(-1, 2)
        blocks = [2 * pairs + [i, j] for i in (0, 1) for j in (0, 1)]
        rows, columns = np.concatenate(blocks).T
        return rows, columns

    def tolerance(self, tolerance: Any) -> Any:
        """The tolerance of each number, for each of its parts."""
        if not self.is_complex or np.ndim(tolerance) == 0:
            return tolerance
        return np.repeat(np.asarray(tolerance), 2)


def chosen(names: Names, state: Any, given: dict[str, Any]) -> dict[str, Any]:
    """The keywords of a function that takes `names`."""
    return {name: state.mode if name == "mode" else given[name] for name in names or ()}


def require_numbers(what: str, returned: Any, expected: str = "numbers") -> None:
    """ModelError where a function returned what is no number, nor a list or an array of them."""
    if returned is None:
        raise ModelError(
            f"solve: {what} returned None, expected {expected}; is a `return` missing?"
        )
    entries = returned if isinstance(returned, (list, tuple)) else [returned]
    for entry in entries:
        if entry is None or isinstance(entry, (str, dict)):
            raise ModelError(f"solve: {what} returned {returned!r}, expected {expected}")


PLAIN = Form()


@functools.cache
def form_of(backward: bool, is_complex: bool) -> Form:
    """The one form of this kind, so that callbacks can be compared."""
    return Form(backward, is_complex)
