"""What all blocks share."""

from __future__ import annotations

from saltus import _core
from saltus.system import System


class Block(System):
    """A ready block."""

    def _named(self, name: str | None) -> str:
        return name or _core.next_name(type(self).__name__)
