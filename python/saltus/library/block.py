"""The base of all blocks of the library."""

from __future__ import annotations

from typing import Any

from saltus import _core
from saltus._porting import refusing
from saltus.system import System

__all__ = ["Block"]


class Block(System):
    """A ready block."""

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        if cls.__module__.startswith(__package__):  # not those derived elsewhere
            cls.__init__ = refusing(cls.__init__)  # type: ignore[method-assign]

    def _named(self, name: str | None) -> str:
        return name or _core.next_name(type(self).__name__)
