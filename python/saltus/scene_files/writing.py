"""A scene as text: TOML for people, JSON for machines."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import Any

from saltus.errors import ModelError

__all__ = ["text_of"]

BARE = re.compile(r"[A-Za-z0-9_-]+")
WIDE = 100
HEADED = ("guards", "edges", "updates", "event_inputs")  # each entry of these gets a header


def text_of(tree: dict[str, Any], kind: str) -> str:
    """The text of a scene, 'toml' or 'json'."""
    if kind == "json":
        return json.dumps(tree, indent=1, ensure_ascii=False) + "\n"
    if kind != "toml":
        raise ModelError(f"expected a name that ends in .toml or .json, found '.{kind}'")
    return "\n".join(_lines((), tree)).strip() + "\n"


def _lines(path: tuple[str, ...], table: dict[str, Any]) -> Iterator[str]:
    """The text of a table: first the entries that are no tables, then a header for each table in
    it.

    The entries of a table stay in their order, which is that of states and blocks.
    """
    for key, value in table.items():
        if not isinstance(value, dict):
            yield f"{_key(key)} = {_value(value)}"
    for key, value in table.items():
        if isinstance(value, dict):
            yield from _table((*path, key), value)


def _table(path: tuple[str, ...], table: dict[str, Any]) -> Iterator[str]:
    if path[-1] == "systems" and len(path) % 2:  # systems, systems.NAME.systems, ...
        for name, system in table.items():
            yield from _header((*path, name))
            yield from _lines((*path, name), _dict(system))
        if table:
            return
    if path[-1] in HEADED and table and all(isinstance(value, dict) for value in table.values()):
        for name, value in table.items():
            yield from _header((*path, name))
            yield from _entries(value)
        return
    yield from _header(path)
    yield from _entries(table)


def _entries(table: dict[str, Any]) -> Iterator[str]:
    for key, value in table.items():
        yield f"{_key(key)} = {_value(value)}"


def _dict(value: Any) -> dict[str, Any]:
    assert isinstance(value, dict)
    return value


def _header(path: tuple[str, ...]) -> Iterator[str]:
    yield ""
    yield f"[{'.'.join(map(_key, path))}]"


def _key(key: str) -> str:
    return key if BARE.fullmatch(key) else json.dumps(key, ensure_ascii=False)


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, dict):
        inside = ", ".join(f"{_key(key)} = {_value(inner)}" for key, inner in value.items())
        return f"{{ {inside} }}" if inside else "{}"
    if isinstance(value, list):
        return _list([_value(inner) for inner in value])
    return repr(value)


def _list(values: list[str]) -> str:
    one = f"[{', '.join(values)}]"
    if len(one) <= WIDE or any("\n" in value for value in values):
        return one
    return "[\n" + "".join(f"  {value},\n" for value in values) + "]"
