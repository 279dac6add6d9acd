"""Blocks without inputs. Their output is called 'out'."""

from __future__ import annotations

from numpy.typing import ArrayLike

from saltus import _core
from saltus.library.block import Block


class Constant(Block, _core.Constant):
    """y = value. Parameter `value`. Never computed."""

    def __init__(self, value: ArrayLike, *, name: str | None = None):
        super().__init__(self._named(name), value)


class Step(Block, _core.Step):
    """y = start_value for t < step_time [s], else end_value. Parameters `start_value`, `end_value`;
    one exact event.
    """

    def __init__(
        self,
        start_value: ArrayLike = 0.0,
        end_value: ArrayLike = 1.0,
        step_time: float = 1.0,
        *,
        name: str | None = None,
    ):
        super().__init__(self._named(name), start_value, end_value, step_time)


class Sine(Block, _core.Sine):
    """y = amplitude sin(frequency t + phase) + bias; frequency in rad/s, phase in rad. All four are
    parameters.
    """

    def __init__(
        self,
        amplitude: ArrayLike = 1.0,
        frequency: ArrayLike = 1.0,
        phase: ArrayLike = 0.0,
        bias: ArrayLike = 0.0,
        *,
        name: str | None = None,
    ):
        super().__init__(self._named(name), amplitude, frequency, phase, bias)


class Clock(Block, _core.Clock):
    """y = t [s]."""

    def __init__(self, *, name: str | None = None):
        super().__init__(self._named(name))


class Ramp(Block, _core.Ramp):
    """y = start_value + slope max(0, t - start_time); slope in 1/s, start_time in s. Parameters
    `start_value`, `slope`.

    The kink is an exact event.
    """

    def __init__(
        self,
        start_value: ArrayLike = 0.0,
        slope: ArrayLike = 1.0,
        start_time: float = 1.0,
        *,
        name: str | None = None,
    ):
        super().__init__(self._named(name), start_value, slope, start_time)


class Pulse(Block, _core.Pulse):
    """y = amplitude in the first pulse_width (a fraction, 0 to 1) of each period [s], counted from
    phase_delay [s]; else 0.

    Parameter `amplitude`; both edges are exact events.
    """

    def __init__(
        self,
        amplitude: ArrayLike = 1.0,
        period: float = 1.0,
        pulse_width: float = 0.5,
        phase_delay: float = 0.0,
        *,
        name: str | None = None,
    ):
        super().__init__(self._named(name), amplitude, period, pulse_width, phase_delay)
