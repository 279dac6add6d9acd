"""The wires of a diagram: "source.port -> block.port, other.port"."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from saltus.scene_files.names import named_path
from saltus.scene_files.wrong import Path, Wrong, found

__all__ = ["wires_of"]

EXAMPLE = "'gain.out -> plant.u'"


def wires_of(path: Path, wires: Any, blocks: Mapping[str, Any]) -> Iterator[tuple[Path, str, str]]:
    """(path, output, input) of each wire. Wrong for a text that is no wire."""
    if not isinstance(wires, list):
        raise Wrong(path, f"expected a list of wires such as [{EXAMPLE}], found {found(wires)}")
    for i, text in enumerate(wires):
        at = (*path, i)
        if not isinstance(text, str):
            raise Wrong(at, f"expected a wire such as {EXAMPLE}, found {found(text)}")
        source, arrow, ends = text.partition("->")
        if not arrow or "->" in ends or not source.strip() or not ends.strip():
            raise Wrong(at, f"expected a wire such as {EXAMPLE}, found '{text}'")
        begin = named_path(at, source.strip(), blocks, "outputs")
        for end in ends.split(","):
            yield at, begin, named_path(at, end.strip(), blocks, "inputs")
