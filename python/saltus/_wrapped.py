"""Functions that are made anew for each run, to call a function of the user."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

__all__ = ["OWNER", "wrapping"]

OWNER = "__saltus_owner__"


def wrapping(owner: Callable[..., Any], function: Callable[..., Any]) -> Callable[..., Any]:
    """Marks `function`, which does nothing but call `owner`: its traces are kept with `owner`."""
    setattr(function, OWNER, owner)
    return function
