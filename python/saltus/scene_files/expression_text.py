"""The text of an expression: the tree of Python's parser, and the columns of mistakes in it."""

from __future__ import annotations

import ast
import functools
import warnings
from collections.abc import Sequence
from typing import Any

from saltus.scene_files.wrong import Path, Wrong

__all__ = ["MOST_LEVELS", "ExpressionText"]

MOST_CHARACTERS = 10_000
MOST_LEVELS = 150


class ExpressionText:
    """A text, with the keys of the file at which it stands."""

    def __init__(self, path: Path, text: str):
        self.path, self.text = path, text

    def wrong(self, message: str, node: Any = None) -> Wrong:
        if getattr(node, "col_offset", None) is None:
            return Wrong(self.path, f"'{self.short()}': {message}")
        at = self.place(node)
        return Wrong(self.path, f"'{self.short()}', column {at + 1}: {message}", at)

    def place(self, node: Any) -> int:
        """The position of a node in the text; Python's parser counts bytes, not characters."""
        return len(self.encoded[: node.col_offset].decode(errors="replace")) + self.lead()

    @functools.cached_property
    def encoded(self) -> bytes:
        return self.line().encode()

    def short(self) -> str:
        return self.text if len(self.text) <= 60 else f"{self.text[:57]}..."

    def line(self) -> str:
        """The text in one line, from its first word on."""
        return self.text.replace("\n", " ").replace("\t", " ").lstrip()

    def lead(self) -> int:
        return len(self.text) - len(self.text.replace("\n", " ").replace("\t", " ").lstrip())

    def parsed(self) -> ast.expr:
        if len(self.text) > MOST_CHARACTERS:
            raise Wrong(
                self.path,
                f"expected an expression of at most {MOST_CHARACTERS} characters, found "
                f"{len(self.text)}; split it into parameters or outputs",
            )
        if "#" in self.text:
            at = self.text.index("#")
            raise Wrong(
                self.path,
                f"'{self.short()}', column {at + 1}: '#' begins a comment in TOML, and is no part "
                "of an expression; write the comment outside of the text",
                at,
            )
        if not self.text.strip():
            raise Wrong(self.path, "expected an expression such as '-k * x / m', found no text")
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                return ast.parse(self.line(), "<scene>", mode="eval").body
        except SyntaxError as error:
            at = min(max(0, (error.offset or 1) - 1) + self.lead(), len(self.text))
            raise Wrong(
                self.path,
                f"'{self.short()}', column {at + 1}: no expression: {error.msg}; expected "
                "one such as '-k * x / m'",
                at,
            ) from None
        except (RecursionError, MemoryError):
            raise self.too_deep() from None
        except ValueError as error:  # such as a character of code 0, or a number of 5000 digits
            raise self.wrong(f"no expression: {error}") from None

    def too_deep(self, node: Any = None) -> Wrong:
        return self.wrong(
            f"nested too deeply; expected at most {MOST_LEVELS} levels; name a part of it", node
        )

    def require_few(self, node: ast.expr, parts: Sequence[ast.expr]) -> None:
        """Each part is a level of the tree that is built."""
        if len(parts) > MOST_LEVELS:
            raise self.wrong(f"expected at most {MOST_LEVELS} parts, found {len(parts)}", node)
