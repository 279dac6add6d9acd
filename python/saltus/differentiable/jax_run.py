"""A `Run` as a function of JAX: the derivatives along the columns, by the rule of `custom_jvp`.

The columns are computed forward, so that the pullback that JAX makes by transposing the rule costs
one run too.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from saltus.differentiable.parameters import flat
from saltus.differentiable.run import Run
from saltus.differentiable.values import mapped
from saltus.errors import ModelError

__all__ = ["function_of"]

Function = Callable[[Any], Any]


def function_of(run: Run) -> Function:
    """f(p) -> RunValues of arrays of JAX."""
    differentiable = _differentiable(run)

    def function(p: Any) -> Any:
        return differentiable(flat(run, p, partial(_array, run.where), jnp.concatenate))

    require_doubles(run.where)
    return function


def require_doubles(where: str) -> None:
    """ModelError while JAX computes in single precision, which would round the results."""
    if jnp.result_type(float) != np.float64:
        raise ModelError(
            f"{where}: expected JAX with float64, found it without; call "
            "jax.config.update('jax_enable_x64', True) at the beginning of the program"
        )


def _array(where: str, name: str, value: Any) -> Any:
    """Whole numbers become float64, which is exact; narrower floats have lost digits already."""
    require_doubles(where)
    try:
        array = jnp.asarray(value)
    except (TypeError, ValueError):
        raise ModelError(f"{where}: {name}: expected numbers of float64, found {value!r}") from None
    if not (array.dtype == np.float64 or jnp.issubdtype(array.dtype, jnp.integer)):
        raise ModelError(
            f"{where}: {name}: expected float64, found {array.dtype}; make it with "
            "dtype=jax.numpy.float64"
        )
    return array.astype(np.float64)


def _differentiable(run: Run) -> Function:
    values, with_columns = _called(run.values, _shapes(run)), _once(run)
    function = jax.custom_jvp(values)

    def rule(primals: Any, tangents: Any) -> Any:
        found, columns = with_columns(*primals)
        (tangent,) = tangents
        return found, mapped(lambda column: column @ tangent, columns)

    function.defjvp(rule)
    return function  # type: ignore[no-any-return,unused-ignore]


def _once(run: Run) -> Function:
    """The values with their derivatives, which have no derivatives themselves."""
    size = len(run.parameters)
    called = _called(run.with_columns, (_shapes(run), _shapes(run, size)))
    function = jax.custom_jvp(called)

    def rule(primals: Any, tangents: Any) -> Any:
        raise ModelError(
            f"{run.where}: second derivatives of a run are not computed; take differences of its "
            "first derivatives"
        )

    function.defjvp(rule)
    return function  # type: ignore[no-any-return,unused-ignore]


def _shapes(run: Run, *last: int) -> Any:
    struct: Any = jax.ShapeDtypeStruct
    return mapped(lambda shape: struct((*shape, *last), np.float64), run.shapes)


def _called(function: Function, shapes: Any) -> Function:
    """A function of NumPy as one of JAX. Where p is known it is called directly, and its exceptions
    come out as they are.
    """

    def on_host(p: Any) -> Any:
        return function(np.asarray(p, dtype=float))

    def called(p: Any) -> Any:
        if isinstance(p, jax.core.Tracer):
            return jax.pure_callback(on_host, shapes, p, vmap_method="sequential")
        return jax.tree.map(jnp.asarray, on_host(p))

    return called
