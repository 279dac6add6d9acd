# The compiled module as the package uses it. Import saltus, not this.
from collections.abc import Callable, Mapping, Sequence
from enum import Enum
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from saltus.system import System as AnySystem

__version__: str

def known_names(wrong: str, names: Sequence[str], /) -> str: ...
def next_name(kind: str, /) -> str: ...
def context_from_dict(system: AnySystem, data: dict[str, Any]) -> Context: ...

class Context:
    time: float
    continuous_state: NDArray[np.float64]
    discrete_state: NDArray[np.float64]
    mode: int
    modes: list[int]
    parameters: dict[str, float | NDArray[np.float64]]
    def to_dict(self) -> dict[str, Any]: ...
    def to_json(self) -> str: ...
    def with_time(self, time: float) -> Context: ...
    def with_continuous_state(self, continuous_state: ArrayLike) -> Context: ...
    def with_discrete_state(self, discrete_state: ArrayLike) -> Context: ...
    def with_mode(self, mode: int) -> Context: ...
    def with_parameter(self, name: str, value: ArrayLike) -> Context: ...
    def with_parameters(self, values: Mapping[str, ArrayLike]) -> Context: ...
    def __getitem__(self, system: int | AnySystem) -> Context: ...
    def with_subcontext(self, system: int | AnySystem, context: Context) -> Context: ...

class State:
    continuous_state: NDArray[np.float64]
    discrete_state: NDArray[np.float64]
    mode: int
    entry: int
    def with_continuous_state(self, continuous_state: ArrayLike) -> State: ...
    def with_discrete_state(self, discrete_state: ArrayLike) -> State: ...
    def with_mode(self, mode: int) -> State: ...

class System:
    name: str
    system_id: int
    input_names: list[str]
    output_names: list[str]
    def find_input(self: Any, port: int | str, /) -> int: ...
    def find_output(self: Any, port: int | str, /) -> int: ...
    def create_context(self: Any, time: float, /) -> Context: ...

class Convention(Enum):
    state = ...
    inputs = ...
    input = ...

class LeafSystem(System):
    def __init__(self, name: str, /) -> None: ...
    # positional, without defaults; saltus.LeafSystem says what they take
    def declare_continuous_state(self, *arguments: Any, **none: Any) -> None: ...
    def declare_discrete_state(self, *arguments: Any, **none: Any) -> None: ...
    def declare_default_mode(self, *arguments: Any, **none: Any) -> None: ...
    def declare_dynamic_parameter(self, *arguments: Any, **none: Any) -> None: ...
    def declare_input_port(self, *arguments: Any, **none: Any) -> int: ...
    def declare_output_port(self, *arguments: Any, **none: Any) -> int: ...
    def declare_continuous_state_output(self, *arguments: Any, **none: Any) -> int: ...
    def declare_discrete_state_output(self, *arguments: Any, **none: Any) -> int: ...
    def declare_mode_output(self, *arguments: Any, **none: Any) -> int: ...
    def declare_zero_crossing(self, *arguments: Any, **none: Any) -> None: ...
    def declare_periodic_update(self, *arguments: Any, **none: Any) -> None: ...
    def declare_one_shot(self, *arguments: Any, **none: Any) -> None: ...

class DiagramBuilder:
    def add(self, system: AnySystem, /) -> None: ...
    def connect(
        self, source: AnySystem, output: int, destination: AnySystem, input: int, /
    ) -> None: ...
    def export_input(self, system: AnySystem, index: int, name: str, /) -> int: ...
    def export_output(self, system: AnySystem, index: int, name: str, /) -> int: ...

class Diagram(System):
    def __init__(self, builder: DiagramBuilder, name: str, /) -> None: ...
    def require(self, child: str, /) -> None: ...

class Abs(System):
    def __init__(self, name: str, /) -> None: ...

class Adder(System):
    def __init__(self, name: str, operators: str, /) -> None: ...

class Clock(System):
    def __init__(self, name: str, /) -> None: ...

class Comparator(System):
    def __init__(self, name: str, operator: str, /) -> None: ...

class Constant(System):
    def __init__(self, name: str, value: ArrayLike, /) -> None: ...

class Demultiplexer(System):
    def __init__(self, name: str, n_outputs: int, /) -> None: ...

class Gain(System):
    def __init__(self, name: str, gain: ArrayLike, /) -> None: ...

class Integrator(System):
    def __init__(
        self,
        name: str,
        initial_state: ArrayLike,
        enable_reset: bool,
        enable_external_reset: bool,
        zeno_tolerance: float | None,
        enable_limits: bool,
        lower_limit: ArrayLike | None,
        upper_limit: ArrayLike | None,
        enable_hold: bool,
        /,
    ) -> None: ...

class LogicalOperator(System):
    def __init__(self, name: str, function: str, n_inputs: int, /) -> None: ...

class Multiplexer(System):
    def __init__(self, name: str, n_inputs: int, /) -> None: ...

class Offset(System):
    def __init__(self, name: str, offset: ArrayLike, /) -> None: ...

class Product(System):
    def __init__(self, name: str, operators: str, /) -> None: ...

class Pulse(System):
    def __init__(
        self,
        name: str,
        amplitude: ArrayLike,
        period: float,
        pulse_width: float,
        phase_delay: float,
        /,
    ) -> None: ...

class Ramp(System):
    def __init__(
        self, name: str, start_value: ArrayLike, slope: ArrayLike, start_time: float, /
    ) -> None: ...

class Saturate(System):
    def __init__(
        self, name: str, lower_limit: ArrayLike | None, upper_limit: ArrayLike | None, /
    ) -> None: ...

class Sine(System):
    def __init__(
        self,
        name: str,
        amplitude: ArrayLike,
        frequency: ArrayLike,
        phase: ArrayLike,
        bias: ArrayLike,
        /,
    ) -> None: ...

class Step(System):
    def __init__(
        self, name: str, start_value: ArrayLike, end_value: ArrayLike, step_time: float, /
    ) -> None: ...

class Switch(System):
    def __init__(self, name: str, threshold: float | None, /) -> None: ...

class UnitDelay(System):
    def __init__(self, name: str, dt: float, initial_state: ArrayLike, /) -> None: ...

class ZeroOrderHold(System):
    def __init__(self, name: str, dt: float, initial_state: ArrayLike, /) -> None: ...

class Results:
    time: NDArray[np.float64]
    jump: NDArray[np.int32]
    outputs: dict[str, NDArray[np.float64]]
    context: Context
    status: str
    message: str
    block: str
    statistics: dict[str, Any]
    event_count: int
    dense: bool
    span: tuple[float, float]
    joints: NDArray[np.float64]
    def at(
        self, times: Sequence[float], left: bool, /
    ) -> tuple[NDArray[np.float64], dict[str, NDArray[np.float64]]]: ...
    def event(self, index: int, /) -> tuple[Any, ...]: ...
    def event_times(self, name: str, kind: str, /) -> NDArray[np.float64]: ...

class SimulatorOptions:
    rtol: float
    atol: float
    ode_solver_method: str
    max_major_steps: int | None
    max_major_step_length: float
    min_minor_step_size: float
    max_minor_step_size: float
    zeno_tolerance: float
    event_scan_points: int
    max_passes: int
    save_at: list[float]
    save_steps: bool | None
    event_rows: bool
    dense_output: bool
    record_events: bool
    interrupt: Callable[[], bool] | None
    def set_recorded_signals(self, signals: list[tuple[str, AnySystem, int]], /) -> None: ...

class Simulator:
    time: float
    events: int
    context: Context
    def __init__(
        self,
        system: AnySystem,
        options: SimulatorOptions,
        progress: Callable[[float, int], object] | None,
        /,
    ) -> None: ...
    def initialize(self, context: Context, /) -> None: ...
    def advance_to(self, t_end: float, /) -> None: ...
    def results(self, take: bool, /) -> tuple[Results, BaseException | None]: ...
    def describe(self) -> str: ...

class SystemHandle: ...

class SharedSystem(System):
    block_names: list[str]
    def __init__(self, handle: SystemHandle, /) -> None: ...
    def block(self, name: str, /) -> SystemHandle: ...

class Scene:
    system: SystemHandle
    context: Context
    t_span: tuple[float, float]
    options: SimulatorOptions
    recorded_signals: list[tuple[str, SystemHandle, int]]
    provenance: str
    methods: list[str]
    growth: float
    invariants: list[str]

def shelf() -> list[tuple[str, str]]: ...
def scene(name: str, /) -> Scene: ...

class WorkOptions:
    methods: list[str]
    rtols: list[float]
    atol_over_rtol: float
    time_limit: float
    least_time: float
    most_repeats: int

def user_scene(
    system: AnySystem, context: Context, span: tuple[float, float], options: SimulatorOptions, /
) -> Scene: ...
def set_samples(
    scene: Scene,
    times: Sequence[float],
    rows: Sequence[ArrayLike],
    exact: bool,
    provenance: str,
    /,
) -> None: ...
def set_event_times(scene: Scene, all: Sequence[tuple[str, ArrayLike]], /) -> None: ...
def add_invariant(
    scene: Scene, name: str, value: Callable[[float, NDArray[np.float64]], float], /
) -> None: ...
def set_gap(scene: Scene, gap: Callable[[float, NDArray[np.float64]], float], /) -> None: ...
def work_precision(scene: Scene, options: WorkOptions, name: str, title: str, /) -> str: ...
