"""The answers of a state and of a context to what looks right and is not: `state[0]`, and values
that are set in place.
"""

from __future__ import annotations

from saltus import _core

__all__ = ["answer"]

NO_ARRAY = (
    "the state of a callback is no array: its numbers are state.continuous_state, "
    "state.discrete_state and state.mode, as in x, v = state.continuous_state"
)


def _no_array(self, *_) -> None:  # type: ignore[no-untyped-def]
    raise TypeError(NO_ARRAY)


def _no_change(self, name, value) -> None:  # type: ignore[no-untyped-def]
    changed = f"with_{name}"
    if name == "parameters":
        how = "context.with_parameters({'k': 2.0})"
    elif hasattr(type(self), changed):
        how = f"context.{changed}(...)"
    else:
        known = [each for each in dir(self) if not each.startswith("_")]
        raise AttributeError(
            f"'Context' object has no attribute '{name}'{_core.known_names(name, known)}"
        )
    raise AttributeError(f"a context is not changed in place; write context = {how}")


def answer() -> None:
    """Gives both classes of the compiled module these answers."""
    for name in ("__getitem__", "__iter__"):
        setattr(_core.State, name, _no_array)
    _core.Context.__setattr__ = _no_change  # type: ignore[method-assign]


answer()
