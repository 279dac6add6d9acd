"""Blocks and wires: `DiagramBuilder` collects them, `Diagram` is the system they make."""

from saltus.diagram.builder import DiagramBuilder
from saltus.diagram.diagram import Diagram

__all__ = ["Diagram", "DiagramBuilder"]
