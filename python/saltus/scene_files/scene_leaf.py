"""`SceneLeaf`: a block of a scene file, with what the file says beside its equations."""

from __future__ import annotations

from typing import Any

from saltus.leaf_system import LeafSystem
from saltus.scene_files.expression import Expression
from saltus.scene_files.moving import Doubt, Motions
from saltus.scene_files.wrong import Path

__all__ = ["SceneLeaf"]


class SceneLeaf(LeafSystem):
    """A block whose equations are in a scene file."""

    shown: tuple[str, ...] = ()
    """the outputs that the file names, which are recorded by default"""
    motions: Motions
    """what moves each output between events"""
    doubts: tuple[Doubt, ...] = ()
    """the equalities in its guards that depend on what its inputs are"""
    structural: dict[str, str]
    """the parameters in its equations that are in numbers of the block too, and where"""
    path: Path
    """the keys of its table"""
    fixed: frozenset[str]
    """the parameters in numbers of the block that are no starts of states, as a period"""
    read: frozenset[str]
    """the parameters in its equations"""
    expressions: list[tuple[Path, Any, Expression]]
    """the expressions of its equations, with their keys and texts"""
    state_names: list[str]
    """the names of the continuous states in a context; none if they are `x[0]`, ... there"""
    starts: list[tuple[Path, Any]]
    """the starts of the continuous states: keys and texts"""
    held_starts: list[tuple[Path, Any]]
    """the starts of the discrete states: keys and texts"""
    states: tuple[str, ...]
    """the names of the continuous states"""
    held: dict[str, int]
    """the discrete states, by name, and their positions"""
    held_outputs: tuple[str, ...] = ()
    """the outputs that show a discrete state or the mode, and that the file does not name"""
    last: list[tuple[Path, float]]
    """[s] the last time of each of its updates that ends, and the key that says it"""
