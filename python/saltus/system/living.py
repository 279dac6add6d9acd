"""The system whose values a context has, while that system lives."""

from __future__ import annotations

import weakref
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from saltus import _core
    from saltus.system.system import System

__all__ = ["remember", "system_of"]

_systems: weakref.WeakValueDictionary[int, System] = weakref.WeakValueDictionary()
"""living systems that may have made a context, by their number"""


def remember(system: System) -> None:
    """Lets `system_of` find a system."""
    _systems[system.system_id] = system


def system_of(context: _core.Context) -> System | None:
    """The system whose values a context has, if it still lives and made a context."""
    return _systems.get(context.system_id)
