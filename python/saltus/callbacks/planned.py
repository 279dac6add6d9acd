"""Plans of a system with its callbacks, traced."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from saltus import _core
from saltus.callbacks.called import Called
from saltus.callbacks.callbacks import Callbacks, Others
from saltus.callbacks.explanation import Explanation
from saltus.errors import ModelError

__all__ = ["called_callbacks", "explain", "planned", "traced_callbacks"]

Made = TypeVar("Made")


def callbacks_of(system: Any) -> Callbacks:
    """The callbacks of a system at present, for the next plan.

    They are made at first use, and anew if blocks have declared more since.
    """
    callbacks: Callbacks | None = getattr(system, "_callbacks", None)
    if callbacks is None or callbacks.traces.stale:
        return Callbacks(system)
    callbacks.refresh()
    return callbacks


def planned(
    system: Any, plan: Callable[[Callbacks], Made], others: Others = ()
) -> tuple[Made, Callbacks]:
    """The result of `plan` for a system with its callbacks, which are traced by then.

    `plan` is called again if a function, traced for the first plan, has to be called, or if called
    functions share values outside of the system.
    """
    callbacks = callbacks_of(system)
    made = plan(callbacks)
    if callbacks.settle(others):
        made = plan(callbacks)
    system._callbacks = callbacks
    return made, callbacks


def called_callbacks(system: Any) -> Callbacks | None:
    """The callbacks of a system of which none is traced, for the option `python="called"`. None if no
    functions share values outside of the system: then a plan needs nothing of them.
    """
    callbacks = Called(system)
    return callbacks if callbacks.settle() else None


def traced_callbacks(system: Any) -> Callbacks:
    """The callbacks of a system, traced. ModelError if the system cannot run."""
    return planned(system, lambda callbacks: _made_complete(system, callbacks))[1]


def _made_complete(system: Any, callbacks: Callbacks) -> None:
    if not callbacks.traces.complete:
        _core.trace(system, callbacks)


def explain(system: Any) -> Explanation:
    """How each callback of a system runs, even if the system is not ready to run yet."""
    try:
        return traced_callbacks(system).explain()
    except ModelError:
        callbacks = Callbacks(system)
        callbacks.traces.guess_shapes()
        for number, block in enumerate(callbacks.traces.blocks()):
            callbacks.trace_block(number, block)
        callbacks.settle()
        return callbacks.explain(
            "the system has open inputs; each is taken for a single number here"
        )
