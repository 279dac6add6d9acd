"""A `Run` as a function of PyTorch: the pullback v^T S and the pushforward S dp of its columns S.

The values come from a plain run. A derivative makes a run with columns when it is asked for, which
has the same values to the bit, so `autograd.Function` need not know beforehand whether it will be.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import torch

from saltus.differentiable.parameters import flat
from saltus.differentiable.run import Run
from saltus.differentiable.values import leaves, with_leaves
from saltus.errors import ModelError

__all__ = ["function_of"]


def function_of(run: Run) -> Callable[[Any], Any]:
    """f(p) -> RunValues of tensors."""

    def function(p: Any) -> Any:
        given = flat(run, p, partial(_tensor, run.where), torch.cat)
        return with_leaves(run.shapes, _Values.apply(given, run))

    return function


def _tensor(where: str, name: str, value: Any) -> torch.Tensor:
    """No number is converted here: a copy would lose the connection with its gradient."""
    if not isinstance(value, torch.Tensor):
        raise ModelError(f"{where}: {name}: expected a tensor of float64, found {value!r}")
    if value.dtype != torch.float64:
        raise ModelError(
            f"{where}: {name}: expected float64, found {value.dtype}; make it with "
            "dtype=torch.float64, or convert it with .double()"
        )
    if value.device.type != "cpu":
        raise ModelError(
            f"{where}: {name}: expected a tensor on the CPU, found {value.device}; say .cpu()"
        )
    return value


def _tensors(arrays: Any) -> tuple[torch.Tensor, ...]:
    return tuple(torch.from_numpy(np.array(array, dtype=float)) for _, array in leaves(arrays))


class _Values(torch.autograd.Function):  # type: ignore[misc,unused-ignore]
    """p -> the values of the run."""

    @staticmethod
    def forward(p: torch.Tensor, run: Run) -> tuple[torch.Tensor, ...]:
        return _tensors(run.values(p.detach().numpy()))

    @staticmethod
    def setup_context(ctx: Any, inputs: Any, output: Any) -> None:
        p, ctx.run = inputs
        ctx.save_for_backward(p)
        ctx.save_for_forward(p)
        ctx.set_materialize_grads(False)

    @staticmethod
    def backward(ctx: Any, *cotangents: Any) -> Any:
        """v^T S, over the values that have a cotangent."""
        (p,) = ctx.saved_tensors
        columns = _Columns.apply(p, ctx.run)
        pulled = [
            v.reshape(-1) @ column.reshape(-1, column.shape[-1])
            for v, column in zip(cotangents, columns, strict=True)
            if v is not None
        ]
        return sum(pulled) if pulled else None, None

    @staticmethod
    def jvp(ctx: Any, tangent: Any, _: Any) -> Any:
        (p,) = ctx.saved_tensors
        return tuple(column @ tangent for column in _Columns.apply(p, ctx.run))

    @staticmethod
    def vmap(info: Any, in_dims: Any, p: torch.Tensor, run: Run) -> Any:
        return _one_by_one(_Values, in_dims[0], p, run)


class _Columns(torch.autograd.Function):  # type: ignore[misc,unused-ignore]
    """p -> the derivatives of the values, which have no derivatives themselves."""

    @staticmethod
    def forward(p: torch.Tensor, run: Run) -> tuple[torch.Tensor, ...]:
        return _tensors(run.with_columns(p.detach().numpy())[1])

    @staticmethod
    def setup_context(ctx: Any, inputs: Any, output: Any) -> None:
        ctx.run = inputs[1]

    @staticmethod
    def backward(ctx: Any, *cotangents: Any) -> Any:
        _refuse_second(ctx.run)

    @staticmethod
    def jvp(ctx: Any, *tangents: Any) -> Any:
        _refuse_second(ctx.run)

    @staticmethod
    def vmap(info: Any, in_dims: Any, p: torch.Tensor, run: Run) -> Any:
        return _one_by_one(_Columns, in_dims[0], p, run)


def _one_by_one(function: Any, dim: int, p: torch.Tensor, run: Run) -> Any:
    rows = [function.apply(row, run) for row in p.movedim(dim, 0)]
    return tuple(map(torch.stack, zip(*rows, strict=True))), (0,) * len(rows[0])


def _refuse_second(run: Run) -> None:
    raise ModelError(
        f"{run.where}: second derivatives of a run are not computed; take differences of its first "
        "derivatives"
    )
