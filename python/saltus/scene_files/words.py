"""The names in an expression, and the trees that replace them."""

from __future__ import annotations

import ast
import functools
from collections.abc import Mapping
from dataclasses import dataclass

__all__ = ["ANY", "EITHER", "Scope", "Word", "numpy_call", "template"]

ANY, EITHER = -1, -2


@dataclass(frozen=True)
class Word:
    """A name in an expression, and the Python text that replaces it."""

    code: str
    size: int | None = None
    """None: a number; n: a vector of n, of which an entry is taken; ANY: a vector of any length;
    EITHER: a number or a vector of any length
    """
    truth: bool = False
    """whether it is true or false"""
    choice_of: str | None = None
    """the word whose value it names: 'mode' for the name of a mode, which is no number"""


Scope = Mapping[str, Word]


@functools.lru_cache(maxsize=4096)
def template(code: str) -> ast.expr:
    """The tree of a text that is part of this package."""
    return ast.parse(code, mode="eval").body


def numpy_call(function: str, *arguments: ast.expr) -> ast.expr:
    """The tree of a call of a function of NumPy."""
    return ast.Call(template(f"np.{function}"), list(arguments), [])
