"""Contexts, options and recorded signals in the form that the engine takes."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import fields
from typing import Any

import numpy as np

from saltus import _core
from saltus.errors import ModelError
from saltus.options import SimulatorOptions
from saltus.ports import core_port
from saltus.system import OutputPort, System

__all__ = ["PYTHON_ONLY", "core_context", "core_options", "needs_interpreter", "ports_of"]

PYTHON_ONLY = frozenset({"recorded_signals", "python", "machine_code", "throw", "progress"})
"""options that the engine does not have, or not in this form"""
WAYS = ("traced", "called")
"""how a Python callback may be asked to run: the values of the option `python`"""
WHEN = ("auto", "always", "never")
"""when a tape becomes machine code: the values of the option `machine_code`"""

_UNBOUNDED = {
    "max_major_step_length": math.inf,
    "min_minor_step_size": 0.0,
    "max_minor_step_size": math.inf,
}
TRUTHS = (bool, np.bool_)
NUMBERS = ("int", "float", "ArrayLike")
"""the beginnings of the types of options that are numbers"""


def ports_of(signals: Any) -> list[tuple[str, System, int]]:
    if not isinstance(signals, Mapping | None):
        raise ModelError(f"recorded_signals: expected a dict of names and ports, found {signals!r}")
    for name, port in (signals or {}).items():
        if not isinstance(port, OutputPort):
            raise ModelError(
                f"recorded signal '{name}': expected a port, such as block.output_ports[0], "
                f"found {port!r}"
            )
    return [(name, *core_port(port)) for name, port in (signals or {}).items()]


def needs_interpreter(system: System, options: SimulatorOptions) -> bool:
    """Whether a run calls a Python function, so that threads would wait for each other."""
    if options.python != "traced":
        return bool(system.interpreted_blocks)
    return any(callback.runs == "called" for callback in system.explain())


def core_options(options: SimulatorOptions, system: System | None = None) -> _core.SimulatorOptions:
    """The options of the engine, for runs of `system` if it is given."""
    core = _core.SimulatorOptions()
    for field in fields(options):
        value = getattr(options, field.name)
        if field.name in PYTHON_ONLY:
            continue
        _require_kind(field.name, str(field.type), value)
        try:
            setattr(
                core,
                field.name,
                _UNBOUNDED[field.name] if value is None and field.name in _UNBOUNDED else value,
            )
        except TypeError:
            raise ModelError(
                f"option {field.name}: expected {field.type}, found {value!r}"
            ) from None
    _require_kind("throw", "bool", options.throw)
    _require_known("python", options.python, WAYS)
    _require_known("machine_code", options.machine_code, WHEN)
    if options.machine_code == "always":
        from saltus.jit import require_installed

        require_installed()
    core.set_recorded_signals(ports_of(options.recorded_signals))
    if core.islands and core.island_threads != 1 and isinstance(system, System):
        core.island_threads = 1 if needs_interpreter(system, options) else core.island_threads
    return core


def _require_kind(option: str, kind: str, value: object) -> None:
    """Python takes True for 1 and 3 for true; an option does not."""
    if value is None and "None" in kind:
        return
    wants_truth = kind.startswith("bool")
    if (wants_truth or kind.startswith(NUMBERS)) and wants_truth != isinstance(value, TRUTHS):
        raise ModelError(f"option {option}: expected {kind}, found {value!r}")


def _require_known(option: str, word: object, words: tuple[str, ...]) -> None:
    if word not in words:
        found = f"'{word}'{_core.known_names(str(word), words)}"
        raise ModelError(f"option {option}: unknown {found}")


def core_context(context: object) -> _core.Context:
    if not isinstance(context, _core.Context):
        raise ModelError(f"expected a context, such as system.create_context(), found {context!r}")
    return context
