"""`key_of`: the options of a run as values that tell whether a plan was made for them."""

from __future__ import annotations

import weakref
from collections.abc import Mapping
from typing import Any

import numpy as np

from saltus.callbacks.plans import Key
from saltus.options import SimulatorOptions
from saltus.ports import OutputPort

__all__ = ["key_of"]

DEFAULTS = vars(SimulatorOptions())
PLAIN = {bool, int, float, str, type(None)}
KEPT = {"progress": False, "interrupt": None, "python": "traced"}
"""the values that the options must have if a plan is kept: otherwise it would keep the user's
functions, or a called output might have another shape the next time
"""


def key_of(options: SimulatorOptions | None, overrides: Mapping[str, Any]) -> Key | None:
    """The options as values that can be compared. None if no plan may be kept for them, because
    they may be wrong, or may change without being seen.
    """
    if options is not None and type(options) is not SimulatorOptions:
        return None
    values = {**(DEFAULTS if options is None else vars(options)), **overrides}
    if len(values) != len(DEFAULTS):
        return None  # an unknown name
    signals = _signals(values.pop("recorded_signals"))
    kinds = tuple(map(type, values.values()))
    if signals is None or any(values[name] is not value for name, value in KEPT.items()):
        return None
    if not PLAIN.issuperset(kinds):
        for name, value in values.items():
            if type(value) not in PLAIN:
                values[name] = _fixed(value)
                if values[name] is None:
                    return None
    return (kinds, tuple(values.values()), signals)


def _signals(signals: Any) -> Key | None:
    """The recorded signals as values that can be compared; None if they may be wrong. They refer to
    the blocks weakly, because a block may keep the plan, and with it this key.
    """
    if signals is None:
        return (None,)  # the outputs that the system exports
    if type(signals) is list and {str}.issuperset(map(type, signals)):
        signals = {path: path for path in signals}
    if type(signals) is not dict:
        return None
    key = []
    for name, port in signals.items():
        if type(name) is not str or type(port) not in (OutputPort, str):
            return None
        at = port if type(port) is str else (weakref.ref(port.system), port.index)
        key.append((name, at))
    return tuple(key)


def _fixed(value: Any) -> Any:
    """The present value of a number, an array, or a list of numbers; None for any other object."""
    if isinstance(value, np.generic):
        return value
    if type(value) is np.ndarray and value.dtype.kind in "biuf":
        return (value.shape, value.dtype.str, value.tobytes())
    if type(value) in (list, tuple) and PLAIN.issuperset(map(type, value)):
        return (tuple(map(type, value)), tuple(value))
    return None
