"""The wires of a diagram: "source.port -> block.port, other.port"."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from saltus.scene_files.names import named_path
from saltus.scene_files.wrong import Path, Wrong, found

__all__ = ["ends_of", "wires_of"]

EXAMPLE = "gain.out -> plant.u"


def wires_of(path: Path, wires: Any, blocks: Mapping[str, Any]) -> Iterator[tuple[Path, str, str]]:
    """(path, output, input) of each wire. Wrong for a text that is no wire."""
    if not isinstance(wires, list):
        raise Wrong(path, f"expected a list of wires such as ['{EXAMPLE}'], found {found(wires)}")
    for i, text in enumerate(wires):
        source, ends = ends_of((*path, i), text, EXAMPLE)
        begin = named_path((*path, i), source, blocks, "outputs")
        for end in ends:
            yield (*path, i), begin, named_path((*path, i), end, blocks, "inputs")


def ends_of(path: Path, text: Any, example: str) -> tuple[str, list[str]]:
    """The source of a wire, and the places to which it leads. Wrong for a text that is no wire."""
    if not isinstance(text, str):
        raise Wrong(path, f"expected a wire such as '{example}', found {found(text)}")
    source, arrow, ends = (part.strip() for part in text.partition("->"))
    if not arrow or "->" in ends or not source or not ends:
        raise Wrong(path, f"expected a wire such as '{example}', found '{text}'")
    return source, [end.strip() for end in ends.split(",")]
