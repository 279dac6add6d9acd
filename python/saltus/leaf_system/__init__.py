"""Blocks of your own: the class, and its declarations, one idea a module."""

from saltus.leaf_system.leaf_system import LeafSystem

__all__ = ["LeafSystem"]
