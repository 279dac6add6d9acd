"""`linearize`: the linear system close to a context, with names."""

from saltus.linearization.linear import Linearization
from saltus.linearization.linearizer import linearize, linearizer_of

__all__ = ["Linearization", "linearize", "linearizer_of"]
