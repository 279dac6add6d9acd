"""The ports of a block: its inputs and outputs."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from saltus import _core
from saltus._declarations import EVERYTHING, RequiresInputs, callback_of, inputs_of, shape_of
from saltus._porting import refusing
from saltus._quantities import Declared
from saltus.errors import ModelError
from saltus.leaf_system.derivatives import columns_of

__all__ = ["DeclaresPorts"]


def _ticks(block: str, period: Any, offset: Any) -> tuple[float, float]:
    """[s] The period and the offset of a sampled output as numbers."""
    try:
        if 0.0 < float(period) < math.inf and math.isfinite(float(offset)):
            return float(period), float(offset)
    except (TypeError, ValueError):
        pass
    raise ModelError(
        f"block '{block}': output: expected a period above 0 s and a finite offset, found "
        f"period = {period!r}, offset = {offset!r}"
    )


def _before(block: str, default_value: Any, sizes: list[int]) -> Any:
    """The value of a sampled output before its first tick."""
    if default_value is None:
        return np.zeros(sizes)
    if list(np.shape(default_value)) == sizes:
        return default_value
    raise ModelError(
        f"block '{block}': output: expected a default_value of shape {tuple(sizes)}, found one of "
        f"shape {np.shape(default_value)}"
    )


class DeclaresPorts(_core.LeafSystem):
    """Declares the signals that a block reads and shows."""

    __slots__ = ()

    _declared_quantities: Declared

    @refusing
    def declare_input_port(
        self, name: str | None = None, shape: int | tuple[int, ...] | None = None
    ) -> int:
        """Declares an input, by default called in_0, in_1, ...; returns its position.

        `shape` is () for a number, n for a vector, (m, n) for a matrix. If it is given, another
        shape is refused, otherwise the input takes that of its wire. An input of one number comes
        as a float, with shape 1 as an array, and a matrix as an array of two dimensions.

        Raises ModelError for a shape of more than two dimensions, or with a 0 in one of two.

        Examples
        --------
        >>> block = saltus.LeafSystem(name="gram")
        >>> block.declare_input_port("A", shape=(2, 3))
        0
        >>> block.declare_output_port(lambda time, state, A: A @ A.T)
        0
        >>> saltus.response(block, [[1.0, 0.0, 2.0], [0.0, 3.0, 0.0]])
        array([[5., 0.],
               [0., 9.]])
        """
        return super().declare_input_port(name or "", shape_of(shape))

    @refusing
    def declare_output_port(
        self,
        callback: Callable[..., ArrayLike],
        name: str | None = None,
        requires_inputs: RequiresInputs = True,
        shape: int | tuple[int, ...] | None = None,
        default_value: ArrayLike | None = None,
        boolean: bool | None = None,
        reads: Iterable[str] = EVERYTHING,
        formula: bool = False,
        period: float | None = None,
        offset: float = 0.0,
        derivatives: Callable[..., Mapping[str, ArrayLike]] | None = None,
    ) -> int:
        """Declares an output, y = callback(time, state, *inputs, **parameters), by default called
        out_0, out_1, ...; returns its position.

        `shape` (or the shape of `default_value`) is () for a number, n for a vector, (m, n) for a
        matrix, which the callback returns as an array, or as the numbers row by row. If it is not
        given, or `boolean` is not, the callback is called once before the run, with inputs at zero,
        to find it. A boolean output that reaches a derivative or a reset is located by bisection
        and held in between. `reads` names the values it depends on, of 'time', 'continuous_state',
        'discrete_state', 'mode', 'inputs': an output that reads neither time nor a continuous state
        is computed at events only, not at every stage of the solver.

        With `formula` a run may compute the trace of the callback together with those of the blocks
        around it, to the same bits. If the other blocks turn an inf or nan of the callback, such as
        1/0, into a finite number, nothing raises or warns then. In a `Simulator` the formula is
        that of the whole run: if an attribute that it reads changes between two pieces, the next
        piece is a `ModelError`. A callback that is not traced, that reads a discrete state or the
        mode, or that returns more than 16 numbers remains a call.

        With `period` [s] the output is sampled: y[k] = callback(...) at t = offset + k period, held
        to the next tick, with the state and the mode as they are before the updates of that tick.
        Before the first tick it is `default_value`, or 0; its shape is a number unless `shape` or
        `default_value` says otherwise. A `RateTransition` behind the output does it, which is
        called "block.output" in contexts and orders the outputs of one tick.

        `derivatives` gives those of the callback, as in `declare_continuous_state`.

        Raises ModelError for a name declared twice, an unknown value in `reads`, a period that is
        not above 0, an offset that is not finite, and an offset without a period.

        Examples
        --------
        >>> clock = saltus.LeafSystem(name="clock")
        >>> clock.declare_output_port(lambda t, s: t, name="sampled", period=0.5, offset=0.25)
        0
        >>> saltus.response(clock, t=[0.0, 0.3, 0.7, 0.8])
        array([0.  , 0.25, 0.25, 0.75])
        """
        inputs = inputs_of(requires_inputs)
        sizes = shape_of(shape, default_value)
        ticks = None
        if period is not None:
            sizes = sizes or []
            ticks = (*_ticks(self.name, period, offset), _before(self.name, default_value, sizes))
        elif offset != 0.0:
            raise ModelError(f"block '{self.name}': output: an offset without a period; give both")
        return super().declare_output_port(
            callback_of(callback),
            name or "",
            inputs,
            sizes,
            boolean,
            list(reads),
            _core.Convention.state,
            bool(formula),
            ticks,
            columns_of(derivatives, self, inputs, None, f"derivatives of output '{name or ''}'"),
        )

    @refusing
    def declare_continuous_state_output(self, name: str | None = None) -> int:
        """Declares an output that shows the whole continuous state, which is never copied. Returns
        its position.
        """
        output = super().declare_continuous_state_output(name or "")
        self._declared_quantities.whole += (output,)
        return output

    @refusing
    def declare_discrete_state_output(self, name: str | None = None) -> int:
        """Declares an output that shows the whole discrete state, which is never copied. Returns
        its
        position.
        """
        return super().declare_discrete_state_output(name or "")

    @refusing
    def declare_mode_output(self, name: str | None = None) -> int:
        """Declares an output that shows the mode. Returns its position."""
        output = super().declare_mode_output(name or "")
        self._declared_quantities.mode += (output,)
        return output
