"""A leaf while its table is read: the block, its names, and what every part of the table may say."""

from __future__ import annotations

import ast
from typing import Any

from saltus.scene_files.expression import Expression
from saltus.scene_files.functions import number_of
from saltus.scene_files.leaf_scope import LeafScope
from saltus.scene_files.moving import ALWAYS
from saltus.scene_files.names import chosen
from saltus.scene_files.scene_leaf import SceneLeaf
from saltus.scene_files.words import template
from saltus.scene_files.wrong import Path, Wrong, table_at

__all__ = ["LeafParts"]


class LeafParts:
    """The table of a leaf, and the block that is declared from it."""

    def __init__(self, path: Path, table: dict[str, Any], name: str, scope: LeafScope):
        self.path, self.table, self.scope = path, table, scope
        self.leaf = SceneLeaf(name=name)
        self.leaf.path = path
        self.leaf.shown = tuple(table.get("outputs", {}))
        self.motions = {name: ALWAYS for name in scope.states if name in scope.motions}
        self.leaf.motions = self.motions
        self.leaf.held = {name: i for i, name in enumerate(scope.discrete)}
        self.leaf.last, self.leaf.states = [], tuple(scope.states)
        self.structural: dict[str, str] = {}
        """the parameters in numbers that are no starts, as a period, and the keys that read them"""
        self.started: dict[str, str] = {}
        """the parameters in the starts of states, and the keys that read them"""

    def mode(self, path: Path, value: Any) -> int:
        return self.scope.modes.index(chosen(path, value, self.scope.modes, "mode"))

    def start(self, path: Path, value: Any) -> float:
        return number_of(path, value, self.scope.parameters, self.started)

    def number(self, path: Path, value: Any) -> float:
        return number_of(path, value, self.scope.parameters, self.structural)

    def effect(self, path: Path, value: dict[str, Any]) -> tuple[ast.expr | None, list[Expression]]:
        """The state after an event, and its expressions. All of them read the state before the
        event.
        """
        path = (*path, "set")
        if "set" not in value:
            return None, []
        assigned = table_at(path, value["set"], "{ v = '-e * v' }")
        names = [*self.scope.states, *self.scope.discrete, *(["mode"] if self.scope.modes else [])]
        if not assigned:
            raise Wrong(path, "expected a state and its new value, such as { v = '-e * v' }")
        for name in assigned:
            chosen((*path, name), name, names, "state")
        made = {
            name: self.scope.expression((*path, name), text)
            for name, text in assigned.items()
            if name != "mode"
        }
        after: ast.expr = template("state")
        for states, method in (
            (self.scope.states, "continuous"),
            (self.scope.discrete, "discrete"),
        ):
            if any(name in made for name in states):
                after = _with(after, f"with_{method}_state", self.all_of(states, made))
        if "mode" in assigned:
            mode = self.mode((*path, "mode"), assigned["mode"])
            after = _with(after, "with_mode", ast.Constant(mode))
        return after, list(made.values())

    def all_of(self, states: list[str], made: dict[str, Expression]) -> ast.expr:
        words = self.scope.words
        return ast.List(
            [made[n].tree if n in made else template(words[n].code) for n in states], ast.Load()
        )


def _with(state: ast.expr, method: str, value: ast.expr) -> ast.expr:
    return ast.Call(ast.Attribute(state, method, ast.Load()), [value], [])
