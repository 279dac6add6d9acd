"""A scene with other values of its parameters: its tree, and a function that makes its system."""

from __future__ import annotations

import copy
import inspect
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from saltus import _core
from saltus.errors import ModelError
from saltus.scene_files.source import Source, error_of
from saltus.scene_files.systems import parameters_of, system_of_table
from saltus.scene_files.wrong import Wrong
from saltus.system import System

__all__ = ["Maker", "tree_with"]


@dataclass(frozen=True)
class Maker:
    """Makes the system of a scene with other values of its parameters."""

    tree: dict[str, Any]
    name: str

    @property
    def __signature__(self) -> inspect.Signature:
        kind = inspect.Parameter.KEYWORD_ONLY
        own = self.tree.get("parameters", {})
        return inspect.Signature([inspect.Parameter(n, kind, default=None) for n in own])

    def __call__(self, **values: Any) -> System:
        tree = tree_with(self.tree, values)
        source = Source("<text>", "", "toml")
        try:
            return system_of_table(tree, self.name, parameters_of((), tree, {}))
        except Wrong as wrong:
            raise error_of(wrong, {(): source}) from None


def tree_with(tree: dict[str, Any], given: Mapping[str, Any]) -> dict[str, Any]:
    """The tree with other values of parameters. ModelError for unknown ones."""
    if not given:
        return tree
    tree = copy.copy(tree)
    own = dict(tree.get("parameters", {}))
    for name, value in given.items():
        if name not in own:
            known = _core.known_names(name, list(own)) if own else "; the scene has none"
            raise ModelError(f"unknown parameter '{name}' of the scene{known}")
        plain = value.tolist() if hasattr(value, "tolist") else value
        own[name] = {**own[name], "value": plain} if isinstance(own[name], dict) else plain
    tree["parameters"] = own
    return tree
