"""Parameters that several blocks of a diagram share, and expressions of them."""

from saltus.parameters.given import given, note, plain
from saltus.parameters.parameter import Parameter
from saltus.parameters.shared import Shared

__all__ = ["Parameter", "Shared", "given", "note", "plain"]
