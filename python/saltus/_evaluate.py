"""Values of a system at a context, without a run; and the values of open inputs."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from saltus import _core
from saltus._engine import core_context
from saltus.errors import ModelError
from saltus.ports import InputPort, OutputPort, core_port
from saltus.system import System, system_of

__all__ = ["fix", "input_value", "output_value", "rates"]


def _whole(context: object, system: System) -> System:
    """The system that a context is evaluated with: the diagram around `system`, or itself."""
    values = core_context(context)
    if values.system_id == system.system_id:
        return system
    whole = system_of(values)
    if values.has_system(system.system_id):
        if whole is None:
            raise ModelError(
                f"the context is one of a diagram around '{system.name}' that does not live any "
                "more; keep the diagram in a variable"
            )
        return whole
    return system  # the context may be one of an equal system; the engine compares


def rates(system: System, context: _core.Context) -> np.ndarray:
    return _core.evaluate_time_derivatives(_whole(context, system), context, system)


def output_value(port: OutputPort, context: _core.Context) -> float | np.ndarray:
    whole = _whole(context, port.system)
    value: float | np.ndarray = _core.evaluate_output(whole, *core_port(port), context)
    return value


def input_value(port: InputPort, context: _core.Context) -> float | np.ndarray:
    whole = _whole(context, port.system)
    value: float | np.ndarray = _core.evaluate_input(whole, *core_port(port), context)
    return value


def fix(port: InputPort, value: ArrayLike | None) -> None:
    if value is None:
        _core.free_input(*core_port(port))
    else:
        _core.fix_input(*core_port(port), value)
