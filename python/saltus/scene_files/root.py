"""The root of a scene: its version, its keys."""

from __future__ import annotations

from typing import Any

from saltus.scene_files.names import require_part_name, text_at
from saltus.scene_files.systems import SYSTEM_KEYS
from saltus.scene_files.wrong import Wrong, found, require_keys

__all__ = ["ROOT_KEYS", "VERSION", "require_root"]

VERSION = 1
LISTS = {"wires", "modes", "inputs", "event_wires"}
ROOT_KEYS = {"version", "name", "title", "include", "run", "sweep", "$schema"}


def require_root(tree: dict[str, Any]) -> None:
    """Wrong for a tree that is no scene of this version."""
    if "version" not in tree:
        raise Wrong((), f"expected 'version = {VERSION}', the version of the format")
    if type(tree["version"]) is not int or tree["version"] != VERSION:
        raise Wrong(
            ("version",),
            f"expected {VERSION}, found {found(tree['version'])}; another version of Saltus reads "
            "this file",
        )
    require_keys((), tree, ("version", "name", "title", "include", *SYSTEM_KEYS, "run", "sweep",
                            "$schema"))  # fmt: skip
    for key, table in tree.items():
        for name in LISTS & table.keys() if isinstance(table, dict) else ():
            if isinstance(table[name], list) and all(
                isinstance(t, (str, dict)) for t in table[name]
            ):
                raise Wrong(
                    (key, name),
                    f"'{name}' belongs to the whole scene; in TOML a key below a [header] is one "
                    "of that table, so write it above the first header",
                )
    for key in ("name", "title", "description"):
        if key in tree:
            text_at((key,), tree[key], "a ball over a floor")
    if "name" in tree:
        require_part_name(("name",), tree["name"], "scene")
    if not {"blocks", "states", "discrete", "outputs", "updates", "guards"} & tree.keys():
        raise Wrong((), "expected 'blocks', or the 'states' or 'outputs' of a leaf; found neither")
