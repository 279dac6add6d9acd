"""The objects from which a search for the effects of a callback begins."""

from __future__ import annotations

import gc
from collections.abc import Mapping
from typing import Any

__all__ = ["roots_of"]


def roots_of(block: Mapping[str, Any], i: int) -> list[Any]:
    """Function `i` of a block, and the block if the function is a method of it."""
    function = block["functions"][i]
    owner = [block["leaf"]] if function["method"] else []
    if function["compiled"]:  # perhaps a function of Python that ctypes calls
        owner = gc.get_referents(function["function"])
    return [function["function"], *owner]
