"""Values at a context without a run: the system of a context, and what the engine evaluates."""

from __future__ import annotations

import weakref

import numpy as np
from numpy.typing import ArrayLike

from saltus import _core
from saltus._engine import core_context
from saltus.errors import ModelError
from saltus.ports import InputPort, OutputPort, core_port
from saltus.system import System

__all__ = ["fix", "input_value", "made_context", "output_value", "rates"]

_systems: weakref.WeakValueDictionary[int, System] = weakref.WeakValueDictionary()
"""systems that made a context, by their number"""


def made_context(system: System) -> None:
    """Remembers a system, for as long as it lives, as the one of the contexts that it makes."""
    _systems[system.system_id] = system


def _system_of(context: object, system: System) -> System:
    """The system whose values a context has: this one, or the diagram around it."""
    number = core_context(context).system_id
    found = system if number == system.system_id else _systems.get(number)
    if found is None:
        raise ModelError(
            f"the context belongs to no system that is still there; make it with create_context() "
            f"of '{system.name}' or of the diagram around it"
        )
    return found


def rates(system: System, context: _core.Context) -> np.ndarray:
    return _core.evaluate_time_derivatives(_system_of(context, system), context, system)


def output_value(port: OutputPort, context: _core.Context) -> float | np.ndarray:
    system = _system_of(context, port.system)
    value: float | np.ndarray = _core.evaluate_output(system, *core_port(port), context)
    return value


def input_value(port: InputPort, context: _core.Context) -> float | np.ndarray:
    system = _system_of(context, port.system)
    value: float | np.ndarray = _core.evaluate_input(system, *core_port(port), context)
    return value


def fix(port: InputPort, value: ArrayLike) -> None:
    _core.fix_input(*core_port(port), value)
