"""The names that a scene gives to its parts."""

from __future__ import annotations

import keyword
import re
from collections.abc import Iterable, Mapping
from typing import Any

from saltus._core import known_names
from saltus.scene_files.vocabulary import RESERVED
from saltus.scene_files.wrong import Path, Wrong, found

__all__ = [
    "chosen",
    "named_path",
    "named_vector",
    "require_part_name",
    "require_texts",
    "require_word",
    "text_at",
    "truth_at",
    "whole_at",
]

PART = re.compile(r"[A-Za-z0-9_-]+")
VECTOR = re.compile(r"\s*(\w+)\s*(?:\[\s*(\d{1,6})\s*\])?\s*")


def require_word(path: Path, name: str, taken: Mapping[str, str], what: str) -> None:
    """Wrong for a name that an expression could not read, or that means something else there."""
    if not (name.isidentifier() and name.isascii()) or keyword.iskeyword(name):
        raise Wrong(
            path,
            f"expected a name of letters, digits and '_' that is no word of Python, found '{name}'",
        )
    if name in RESERVED:
        raise Wrong(path, f"'{name}' is taken by expressions; choose another name for the {what}")
    if name in taken:
        raise Wrong(path, f"'{name}' is a {taken[name]} already; choose another name")


def require_part_name(path: Path, name: str, what: str) -> None:
    """Wrong for the name of a block or a port that no path could hold."""
    if not PART.fullmatch(name):
        raise Wrong(
            path, f"expected a name of letters, digits, '_' and '-' for the {what}, found '{name}'"
        )


def named_vector(path: Path, text: Any) -> tuple[str, int | None]:
    """'u' is a number, 'w[3]' a vector of 3."""
    match = VECTOR.fullmatch(text) if isinstance(text, str) else None
    if match is None:
        raise Wrong(path, f"expected a name, 'u', or that of a vector, 'w[3]', found {found(text)}")
    if match[2] is not None and int(match[2]) == 0:
        raise Wrong(
            path, f"expected a vector of 1 entry or more, such as 'w[3]', found {found(text)}"
        )
    return match[1], int(match[2]) if match[2] else None


def text_at(path: Path, value: Any, example: str) -> str:
    """A text; Wrong for anything else."""
    if not isinstance(value, str):
        raise Wrong(path, f"expected text such as '{example}', found {found(value)}")
    return value


def require_texts(path: Path, table: Mapping[str, Any]) -> None:
    """Wrong for a unit or a description that is no text."""
    for key, example in (("unit", "m/s"), ("description", "height over the floor")):
        if key in table:
            text_at((*path, key), table[key], example)


def truth_at(path: Path, value: Any) -> bool:
    """A truth; Wrong for anything else."""
    if not isinstance(value, bool):
        raise Wrong(path, f"expected true or false, found {found(value)}")
    return value


def whole_at(path: Path, value: Any) -> int:
    """A whole number from 1 on; Wrong for anything else."""
    if type(value) is not int or value < 1:
        raise Wrong(path, f"expected a whole number from 1 on, found {found(value)}")
    return value


def chosen(path: Path, value: Any, known: Iterable[str], what: str) -> str:
    """One of the known names. Wrong, with the nearest name, for an unknown one."""
    known = list(known)
    if value not in known:
        name = text_at(path, value, known[0] if known else "")
        raise Wrong(path, f"unknown {what} '{name}'{known_names(name, known)}")
    return str(value)


def named_path(path: Path, text: str, blocks: Mapping[str, Any], what: str) -> str:
    """The name 'block.port'; a block with a single port of the kind may be given as 'block'."""
    block, dot, port = (part.strip() for part in text.partition("."))
    if block not in blocks:
        raise Wrong(path, f"unknown block '{block}'{known_names(block, list(blocks))}")
    if dot:
        return f"{block}.{port}"
    kind = what.removesuffix("s").replace(" ", "_")
    held = getattr(blocks[block], "held_outputs", ()) if kind == "output" else ()
    ports = [name for name in getattr(blocks[block], f"{kind}_names") if name not in held]
    if len(ports) != 1:
        listed = ", ".join(f"'{block}.{name}'" for name in ports) or "none"
        raise Wrong(path, f"block '{block}' has {len(ports)} {what}; say which: {listed}")
    return f"{block}.{ports[0]}"
