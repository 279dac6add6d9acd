"""A run as a differentiable function, for JAX and for PyTorch."""

from saltus.differentiable.jax_function import jax_function
from saltus.differentiable.torch_function import torch_function
from saltus.differentiable.values import RunValues

__all__ = ["RunValues", "jax_function", "torch_function"]
