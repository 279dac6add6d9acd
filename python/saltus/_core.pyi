# The compiled module as the package uses it. Import saltus, not this. Made by ./dev stubs.
from collections.abc import Callable, Mapping, Sequence
from typing import Any, ClassVar, NoReturn, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from saltus.system import System as AnySystem

class Context:
    """
    All values of a system at one time. Made by `system.create_context()`.

    A context is a value: each `with_*` returns a new one, the old one and the system stay as they are.
    The states of a diagram are one vector, block after block in the order of `add`; `context[block]` is
    the context of one block. Contexts compare by value, and can be copied and pickled.

    Raises
    ------
    ModelError
        From each method: for a wrong size, a value that is not finite, an unknown name or system.

    Examples
    --------
    >>> from saltus.library import Gain, Integrator
    >>> builder = saltus.DiagramBuilder()
    >>> x, gain = builder.add(Integrator([1.0, 2.0], name="x"), Gain(-1.0, name="gain"))
    >>> builder.connect(x.output(), gain.input())
    >>> builder.connect(gain.output(), x.input())
    >>> context = builder.build().create_context()
    >>> context.continuous_state
    array([1., 2.])
    >>> context.parameters["gain.gain"]
    -1.0
    >>> context.time, context.modes, context.discrete_state
    (0.0, [0, 0], array([], dtype=float64))
    >>> context[x], context[x].mode
    (Context(time=0, continuous_state=[1, 2], mode=0), 0)
    """

    def __getitem__(self, system: int | AnySystem) -> Context:
        """
        The context of one block or inner diagram, given it or its `system_id`.
        """

    def has_system(self, system_id: int) -> bool:
        """
        Whether these are values of a system or of a block in it.

        Parameters
        ----------
        system_id : int
            The number of the system.

        Examples
        --------
        >>> from saltus.library import Clock
        >>> clock = Clock()
        >>> clock.create_context().has_system(clock.system_id)
        True
        """

    def to_dict(self) -> dict[str, Any]:
        """
        Everything in it as plain data, block by block.

        Returns
        -------
        dict
            Of strings, numbers and lists: for JSON or the like.

        Examples
        --------
        >>> from saltus.library import Integrator
        >>> Integrator(1.0).create_context().to_dict()["time"]
        0.0
        """

    def to_json(self) -> str:
        """
        The same as `to_dict`, as text.

        Returns
        -------
        str
            JSON; `system.context_from_json(text)` reads it, to the last bit.

        Examples
        --------
        >>> from saltus.library import Integrator
        >>> x = Integrator(0.1)
        >>> context = x.create_context()
        >>> x.context_from_json(context.to_json()) == context
        True
        """

    def with_continuous_state(self, continuous_state: ArrayLike) -> Context:
        """
        All continuous states replaced.

        Parameters
        ----------
        continuous_state
            A vector of all of them, or a number where there is one.

        Examples
        --------
        >>> from saltus.library import Integrator
        >>> Integrator([0.0, 0.0]).create_context().with_continuous_state([1.0, 2.0])
        Context(time=0, continuous_state=[1, 2], mode=0)
        """

    def with_discrete_state(self, discrete_state: ArrayLike) -> Context:
        """
        All discrete states replaced.

        Parameters
        ----------
        discrete_state
            A vector of all of them, or a number where there is one.

        Examples
        --------
        >>> class Counter(saltus.LeafSystem):
        ...     def __init__(self):
        ...         super().__init__(name="counter")
        ...         self.declare_discrete_state(default_value=0.0)
        >>> Counter().create_context().with_discrete_state(3.0).discrete_state
        array([3.])
        """

    def with_mode(self, mode: int) -> Context:
        """
        Another mode, of a context of one block.

        Parameters
        ----------
        mode
            A number that selects equations.

        Examples
        --------
        >>> class Light(saltus.LeafSystem):
        ...     def __init__(self):
        ...         super().__init__(name="light")
        ...         self.declare_default_mode(0)
        >>> Light().create_context().with_mode(1).mode
        1
        """

    def with_parameter(self, name: str, value: ArrayLike) -> Context:
        """
        One parameter replaced.

        Parameters
        ----------
        name
            Of a block's own context its name, of a diagram's 'block.name'.
        value
            A number or a vector of as many entries; a number for a vector parameter fills it.

        Examples
        --------
        >>> from saltus.library import Gain
        >>> Gain(2.0).create_context().with_parameter("gain", 3.0).parameters
        {'gain': 3.0}
        """

    def with_parameters(self, values: Mapping[str, ArrayLike]) -> Context:
        """
        Several parameters replaced.

        Parameters
        ----------
        values
            A dict of names and values, as for `with_parameter`.

        Examples
        --------
        >>> from saltus.library import Sine
        >>> context = Sine().create_context().with_parameters({"amplitude": 2.0, "bias": 1.0})
        >>> context.parameters["bias"]
        1.0
        """

    def with_subcontext(self, system: int | AnySystem, context: Context) -> Context:
        """
        The values of one block or inner diagram replaced.

        Parameters
        ----------
        system
            The block or inner diagram, or its `system_id`.
        context
            Its new values, such as `context[system].with_continuous_state(1.0)`.

        Examples
        --------
        >>> from saltus.library import Clock, Integrator
        >>> builder = saltus.DiagramBuilder()
        >>> t, x = builder.add(Clock(), Integrator())
        >>> builder.connect(t.output(), x.input())
        >>> context = builder.build().create_context()
        >>> context.with_subcontext(x, context[x].with_continuous_state(4.0)).continuous_state
        array([4.])
        """

    def with_time(self, time: float) -> Context:
        """
        This context at another time.

        Parameters
        ----------
        time
            [s]

        Examples
        --------
        >>> from saltus.library import Clock
        >>> Clock().create_context().with_time(2.5).time
        2.5
        """

    @property
    def continuous_state(self) -> np.ndarray:
        """
        All continuous states, as one read-only vector.
        """

    @property
    def discrete_state(self) -> np.ndarray:
        """
        All discrete states, as one read-only vector.
        """

    @property
    def mode(self) -> int:
        """
        The mode, of a context of one block.
        """

    @property
    def modes(self) -> list[int]:
        """
        The mode of each block, in the order of `add`.
        """

    @property
    def num_continuous_states(self) -> int:
        """
        How many numbers `continuous_state` has.
        """

    @property
    def num_discrete_states(self) -> int:
        """
        How many numbers `discrete_state` has.
        """

    @property
    def parameters(self) -> dict[str, float | NDArray[np.float64]]:
        """
        Every parameter by name, a number or a read-only vector; in a diagram by 'block.name'.
        """

    @property
    def state(self) -> Any:
        """
        The context itself: its states and modes are the values that a run changes.
        """

    @property
    def system_id(self) -> int:
        """
        The number of the system whose values these are; 0 for none.
        """

    @property
    def time(self) -> float:
        """
        [s]
        """

class Tape:
    def __call__(
        self,
        arg0: float,
        arg1: Any,
        arg2: Any,
        arg3: int,
        arg4: int,
        arg5: Any,
        arg6: Sequence[Any],
        /,
    ) -> np.ndarray: ...
    def compile(self) -> None: ...
    def jacobian(self) -> tuple[list[int], list[int], Tape]: ...
    def llvm_module(self) -> str: ...
    def reads_input(self, arg0: int, /) -> bool: ...
    def to_string(self) -> str: ...
    @property
    def instruction_count(self) -> int: ...
    @property
    def is_machine_code(self) -> bool: ...
    @property
    def reads(self) -> list[str]: ...
    @property
    def size(self) -> int: ...

class Graph:
    def __init__(self) -> None: ...
    def __len__(self) -> int: ...
    def apply(self, arg0: str, /, *args: int) -> int: ...
    def constant(self, arg0: float, /) -> int: ...
    def continuous_state(self, arg0: int, /) -> int: ...
    def discrete_state(self, arg0: int, /) -> int: ...
    def entry(self) -> int: ...
    def input(self, arg0: int, arg1: int, /) -> int: ...
    def mode(self) -> int: ...
    def operation(self, arg0: int, /) -> tuple[str, list[int]]: ...
    def parameter(self, arg0: int, /) -> int: ...
    def tape(self, arg0: Sequence[int], /) -> Tape: ...
    def time(self) -> int: ...
    def value(self, arg0: int, /) -> float | None: ...

class System:
    def create_context(self: Any, arg0: float, /) -> Context: ...
    def find_event_input(self: Any, arg0: str, arg1: int | None, /) -> int: ...
    def find_event_output(self: Any, arg0: str, arg1: int | None, /) -> int: ...
    @overload
    def find_input(self: Any, arg0: int) -> int: ...
    @overload
    def find_input(self: Any, arg0: str) -> int: ...
    @overload
    def find_output(self: Any, arg0: int) -> int: ...
    @overload
    def find_output(self: Any, arg0: str) -> int: ...
    @property
    def event_input_names(self) -> list[str]: ...
    @property
    def event_output_names(self) -> list[str]: ...
    @property
    def input_names(self) -> list[str]: ...
    @property
    def interpreted_blocks(self) -> list[str]: ...
    @property
    def name(self) -> str: ...
    @property
    def output_names(self) -> list[str]: ...
    @property
    def system_id(self) -> int: ...

class DiagramBuilder:
    def __init__(self) -> None: ...
    def add(self, arg0: AnySystem, /) -> None: ...
    def compute_parameter(self, arg0: AnySystem, arg1: str, arg2: Tape, /) -> None: ...
    def connect(self, arg0: AnySystem, arg1: int, arg2: AnySystem, arg3: int, /) -> None: ...
    def connect_event(
        self,
        arg0: AnySystem,
        arg1: int,
        arg2: int | None,
        arg3: AnySystem,
        arg4: int,
        arg5: int | None,
        arg6: float,
        arg7: float,
        /,
    ) -> None: ...
    def declare_parameter(self, arg0: str, arg1: Any, /) -> int: ...
    def execute(
        self, arg0: AnySystem, arg1: AnySystem, arg2: int, arg3: str, arg4: bool, arg5: str, /
    ) -> None: ...
    def export_event_input(
        self, arg0: AnySystem, arg1: int, arg2: int | None, arg3: str, /
    ) -> int: ...
    def export_event_output(
        self, arg0: AnySystem, arg1: int, arg2: int | None, arg3: str, /
    ) -> int: ...
    def export_input(self, arg0: AnySystem, arg1: int, arg2: str, /) -> int: ...
    def export_output(self, arg0: AnySystem, arg1: int, arg2: str, /) -> int: ...

class Diagram(System):
    def __init__(self, arg0: DiagramBuilder, arg1: str, /) -> None: ...
    def require(self, arg0: str, /) -> None: ...

class State:
    """
    What a callback sees of its block, as a value: read-only arrays, and `with_*` that return a new
    state.

    A reset map or an update returns the state it wants. What counts as written is what a `with_*` was
    called for, even if the value is the one that was there.

    Examples
    --------
    >>> class Ball(saltus.LeafSystem):
    ...     def __init__(self):
    ...         super().__init__(name="ball")
    ...         self.declare_continuous_state(2, ode=self.ode)
    ...         self.declare_zero_crossing(self.height, self.bounce, name="bounce")
    ...
    ...     def ode(self, time, state):
    ...         return [state.continuous_state[1], -9.81]
    ...
    ...     def height(self, time, state):
    ...         return state.continuous_state[0]
    ...
    ...     def bounce(self, time, state):
    ...         y, v = state.continuous_state
    ...         return state.with_continuous_state([abs(y), -0.8 * v])
    >>> ball = Ball()
    >>> context = ball.create_context().with_continuous_state([1.0, 0.0])
    >>> len(saltus.simulate(ball, context, (0.0, 1.0)).events)
    1

    >>> class Lamp(saltus.LeafSystem):
    ...     def __init__(self):
    ...         super().__init__(name="lamp")
    ...         self.declare_default_mode(0)
    ...         self.declare_discrete_state(default_value=[0.0])
    ...         self.declare_periodic_update(self.switch, period=1.0)
    ...
    ...     def switch(self, time, state):
    ...         count = state.discrete_state + 1
    ...         return state.with_discrete_state(count).with_mode(1 - state.mode)
    >>> lamp = Lamp()
    >>> end = saltus.simulate(lamp, lamp.create_context(), (0.0, 2.5)).context
    >>> end.mode, end.discrete_state
    (1, array([3.]))
    """

    def __getitem__(self, arg0: NoReturn, /) -> NoReturn: ...
    def __iter__(self) -> NoReturn: ...
    def with_continuous_state(self, continuous_state: ArrayLike) -> State:
        """
        Another continuous state, of the declared shape.
        """

    def with_discrete_state(self, discrete_state: ArrayLike) -> State:
        """
        Another discrete state, of the declared shape.
        """

    def with_mode(self, mode: int) -> State:
        """
        Another mode.
        """

    @property
    def continuous_state(self) -> NDArray[np.float64]: ...
    @property
    def discrete_state(self) -> NDArray[np.float64]: ...
    @property
    def relations(self) -> tuple[bool | NDArray[np.float64], ...]: ...
    @property
    def mode(self) -> int: ...
    @property
    def entry(self) -> int: ...

class Convention:
    """
    Members:

      state

      inputs

      input
    """

    __members__: ClassVar[dict[str, Convention]]
    input: ClassVar[Convention]
    inputs: ClassVar[Convention]
    state: ClassVar[Convention]

    def __init__(self, value: int) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class LeafSystem(System):
    def __init__(self, arg0: str, /) -> None: ...
    def declare_continuous_state(self, *arguments: Any, **none: Any) -> None: ...
    def declare_continuous_state_output(self, *arguments: Any, **none: Any) -> int: ...
    def declare_default_mode(self, *arguments: Any, **none: Any) -> None: ...
    def declare_discrete_state(self, *arguments: Any, **none: Any) -> None: ...
    def declare_discrete_state_output(self, *arguments: Any, **none: Any) -> int: ...
    def declare_dynamic_parameter(self, *arguments: Any, **none: Any) -> None: ...
    def declare_edge_reset(self, *arguments: Any, **none: Any) -> None: ...
    def declare_event_input(self, *arguments: Any, **none: Any) -> None: ...
    def declare_input_port(self, *arguments: Any, **none: Any) -> int: ...
    def declare_mode_output(self, *arguments: Any, **none: Any) -> int: ...
    def declare_one_shot(self, *arguments: Any, **none: Any) -> None: ...
    def declare_output_port(self, *arguments: Any, **none: Any) -> int: ...
    def declare_periodic_update(self, *arguments: Any, **none: Any) -> None: ...
    def declare_relation(self, *arguments: Any, **none: Any) -> int: ...
    def declare_time_event(self, *arguments: Any, **none: Any) -> None: ...
    def declare_zero_crossing(self, *arguments: Any, **none: Any) -> None: ...

class Clock(System):
    def __init__(self, arg0: str, /) -> None: ...

class Constant(System):
    def __init__(self, arg0: str, arg1: Any, /) -> None: ...

class Pulse(System):
    def __init__(self, arg0: str, arg1: Any, arg2: float, arg3: float, arg4: float, /) -> None: ...

class Ramp(System):
    def __init__(self, arg0: str, arg1: Any, arg2: Any, arg3: float, /) -> None: ...

class Sine(System):
    def __init__(self, arg0: str, arg1: Any, arg2: Any, arg3: Any, arg4: Any, /) -> None: ...

class Step(System):
    def __init__(self, arg0: str, arg1: Any, arg2: Any, arg3: float, /) -> None: ...

class Chirp(System):
    def __init__(self, arg0: str, arg1: Any, arg2: Any, arg3: float, arg4: Any, /) -> None: ...

class DataSource(System):
    def __init__(self, arg0: str, arg1: Any, arg2: Any, arg3: str, arg4: str, /) -> None: ...

class RandomNumber(System):
    def __init__(
        self,
        arg0: str,
        arg1: float,
        arg2: str,
        arg3: float,
        arg4: Any,
        arg5: Any,
        arg6: Any,
        arg7: Any,
        /,
    ) -> None: ...

class Sawtooth(System):
    def __init__(self, arg0: str, arg1: Any, arg2: float, arg3: float, /) -> None: ...

class WhiteNoise(System):
    def __init__(self, arg0: str, arg1: float, arg2: Any, arg3: float, /) -> None: ...

class Abs(System):
    def __init__(self, arg0: str, /) -> None: ...

class Adder(System):
    def __init__(self, arg0: str, arg1: str, /) -> None: ...

class BusCreator(System):
    def __init__(self, arg0: str, arg1: Sequence[tuple[str, int | None]], /) -> None: ...

class BusSelector(System):
    def __init__(
        self, arg0: str, arg1: Sequence[tuple[str, int | None]], arg2: Sequence[str], /
    ) -> None: ...

class CrossProduct(System):
    def __init__(self, arg0: str, /) -> None: ...

class DeadZone(System):
    def __init__(self, arg0: str, arg1: Any, arg2: bool, /) -> None: ...

class Demultiplexer(System):
    def __init__(self, arg0: str, arg1: int, /) -> None: ...

class DotProduct(System):
    def __init__(self, arg0: str, /) -> None: ...

class Exponent(System):
    def __init__(self, arg0: str, arg1: str, /) -> None: ...

class Gain(System):
    def __init__(self, arg0: str, arg1: Any, /) -> None: ...

class Logarithm(System):
    def __init__(self, arg0: str, arg1: str, /) -> None: ...

class LookupTable1d(System):
    def __init__(self, arg0: str, arg1: Any, arg2: Any, arg3: str, arg4: str, /) -> None: ...

class LookupTable2d(System):
    def __init__(self, arg0: str, arg1: Any, arg2: Any, arg3: Any, arg4: str, /) -> None: ...

class LookupTableNd(System):
    def __init__(self, arg0: str, arg1: Sequence[Any], arg2: Any, arg3: str, /) -> None: ...

class MatrixConcatenation(System):
    def __init__(self, arg0: str, arg1: int, arg2: int, /) -> None: ...

class MatrixInversion(System):
    @overload
    def __init__(self, arg0: str) -> None: ...
    @overload
    def __init__(self, arg0: str, arg1: int) -> None: ...

class MatrixMultiplication(System):
    @overload
    def __init__(self, arg0: str) -> None: ...
    @overload
    def __init__(self, arg0: str, arg1: tuple[int, int], arg2: tuple[int, int]) -> None: ...

class MatrixTransposition(System):
    @overload
    def __init__(self, arg0: str) -> None: ...
    @overload
    def __init__(self, arg0: str, arg1: tuple[int, int]) -> None: ...

class MinMax(System):
    def __init__(self, arg0: str, arg1: str, arg2: int, /) -> None: ...

class Multiplexer(System):
    def __init__(self, arg0: str, arg1: int, /) -> None: ...

class Offset(System):
    def __init__(self, arg0: str, arg1: Any, /) -> None: ...

class Power(System):
    def __init__(self, arg0: str, arg1: Any, /) -> None: ...

class Product(System):
    def __init__(self, arg0: str, arg1: str, /) -> None: ...

class ProductOfElements(System):
    def __init__(self, arg0: str, /) -> None: ...

class Quantizer(System):
    def __init__(self, arg0: str, arg1: Any, arg2: float, /) -> None: ...

class Reciprocal(System):
    def __init__(self, arg0: str, /) -> None: ...

class Reshape(System):
    def __init__(self, arg0: str, arg1: Sequence[int], /) -> None: ...

class Saturate(System):
    def __init__(self, arg0: str, arg1: Any, arg2: Any, /) -> None: ...

class ScalarBroadcast(System):
    def __init__(self, arg0: str, arg1: int, /) -> None: ...

class Sign(System):
    def __init__(self, arg0: str, /) -> None: ...

class Slice(System):
    @overload
    def __init__(self, arg0: str, arg1: int) -> None: ...
    @overload
    def __init__(self, arg0: str, arg1: Sequence[int]) -> None: ...
    @overload
    def __init__(self, arg0: str, arg1: int | None, arg2: int | None, arg3: int) -> None: ...

class SquareRoot(System):
    def __init__(self, arg0: str, /) -> None: ...

class SumOfElements(System):
    def __init__(self, arg0: str, /) -> None: ...

class Trigonometric(System):
    def __init__(self, arg0: str, arg1: str, /) -> None: ...

class Comparator(System):
    def __init__(self, arg0: str, arg1: str, /) -> None: ...

class Counter(System):
    def __init__(self, arg0: str, arg1: str, arg2: int | None, arg3: int, /) -> None: ...

class HitCrossing(System):
    def __init__(self, arg0: str, arg1: float, arg2: str, /) -> None: ...

class IfThenElse(System):
    def __init__(self, arg0: str, /) -> None: ...

class LogicalOperator(System):
    def __init__(self, arg0: str, arg1: str, arg2: int, /) -> None: ...

class MultiportSwitch(System):
    def __init__(self, arg0: str, arg1: int, /) -> None: ...

class Relay(System):
    def __init__(
        self, arg0: str, arg1: float, arg2: float, arg3: float, arg4: float, arg5: bool, /
    ) -> None: ...

class Stop(System):
    def __init__(self, arg0: str, /) -> None: ...

class Switch(System):
    def __init__(self, arg0: str, arg1: float | None, /) -> None: ...

class ControlPort(System):
    def __init__(self, arg0: str, /) -> None: ...

class SubsystemOutput(System):
    def __init__(self, arg0: str, arg1: str, arg2: bool, arg3: str, arg4: Any, /) -> None: ...

class Integrator(System):
    def __init__(
        self,
        arg0: str,
        arg1: Any,
        arg2: bool,
        arg3: bool,
        arg4: float | None,
        arg5: bool,
        arg6: Any,
        arg7: Any,
        arg8: bool,
        /,
    ) -> None: ...

class SecondOrderIntegrator(System):
    def __init__(
        self,
        arg0: str,
        arg1: Any,
        arg2: Any,
        arg3: Any,
        arg4: Any,
        arg5: float,
        arg6: Any,
        arg7: Any,
        /,
    ) -> None: ...

class SlewRateLimiter(System):
    def __init__(self, arg0: str, arg1: float, arg2: float, arg3: float, arg4: Any, /) -> None: ...

class Backlash(System):
    def __init__(self, arg0: str, arg1: float, arg2: float, /) -> None: ...

class MassWithFriction(System):
    def __init__(
        self,
        arg0: str,
        arg1: float,
        arg2: float,
        arg3: float | None,
        arg4: float,
        arg5: float,
        arg6: float,
        /,
    ) -> None: ...

class RigidBody(System):
    def __init__(
        self,
        arg0: str,
        arg1: float,
        arg2: Any,
        arg3: Any,
        arg4: Any,
        arg5: Any,
        arg6: Any,
        arg7: Any,
        /,
    ) -> None: ...

class Derivative(System):
    def __init__(self, arg0: str, arg1: Any, arg2: Any, /) -> None: ...

class LTISystem(System):
    def __init__(
        self, arg0: str, arg1: Any, arg2: Any, arg3: Any, arg4: Any, arg5: Any, /
    ) -> None: ...

class PID(System):
    def __init__(
        self,
        arg0: str,
        arg1: float,
        arg2: float,
        arg3: float,
        arg4: float,
        arg5: float,
        arg6: float | None,
        arg7: float | None,
        arg8: float | None,
        /,
    ) -> None: ...

class TransferFunction(System):
    def __init__(
        self, arg0: str, arg1: Any, arg2: Any, arg3: Any, arg4: float | None, /
    ) -> None: ...
    @property
    def scales(self) -> np.ndarray: ...

class DelayN(System):
    def __init__(self, arg0: str, arg1: float, arg2: int, arg3: Any, /) -> None: ...

class DiscreteClock(System):
    def __init__(self, arg0: str, arg1: float, /) -> None: ...

class EdgeDetection(System):
    def __init__(self, arg0: str, arg1: float, arg2: str, arg3: bool, /) -> None: ...

class RateLimiter(System):
    def __init__(self, arg0: str, arg1: float, arg2: float, arg3: float, arg4: Any, /) -> None: ...

class RateTransition(System):
    def __init__(self, arg0: str, arg1: float, arg2: Any, arg3: float, /) -> None: ...

class TransportDelay(System):
    def __init__(self, arg0: str, arg1: float, arg2: Any, arg3: int, /) -> None: ...

class UnitDelay(System):
    def __init__(self, arg0: str, arg1: float, arg2: Any, /) -> None: ...

class ZeroOrderHold(System):
    def __init__(self, arg0: str, arg1: float, arg2: Any, /) -> None: ...

class DerivativeDiscrete(System):
    def __init__(self, arg0: str, arg1: float, arg2: float | None, arg3: Any, /) -> None: ...

class FilterDiscrete(System):
    def __init__(self, arg0: str, arg1: float, arg2: Any, arg3: Any, /) -> None: ...

class IntegratorDiscrete(System):
    def __init__(
        self,
        arg0: str,
        arg1: float,
        arg2: Any,
        arg3: str,
        arg4: bool,
        arg5: bool,
        arg6: bool,
        arg7: Any,
        arg8: Any,
        arg9: bool,
        /,
    ) -> None: ...

class LTISystemDiscrete(System):
    def __init__(
        self, arg0: str, arg1: float, arg2: Any, arg3: Any, arg4: Any, arg5: Any, arg6: Any, /
    ) -> None: ...

class PIDDiscrete(System):
    def __init__(
        self,
        arg0: str,
        arg1: float,
        arg2: float,
        arg3: float,
        arg4: float,
        arg5: float,
        arg6: float,
        arg7: float | None,
        arg8: float | None,
        /,
    ) -> None: ...

class TransferFunctionDiscrete(System):
    def __init__(self, arg0: str, arg1: float, arg2: Any, arg3: Any, arg4: Any, /) -> None: ...

class Results:
    def at(
        self, arg0: Sequence[float], arg1: bool, /
    ) -> tuple[NDArray[np.float64], dict[str, NDArray[np.float64]]]: ...
    def event(self, arg0: int, /) -> tuple[Any, ...]: ...
    def event_times(self, arg0: str, arg1: str | None, /) -> np.ndarray: ...
    def sensitivities_at(self, arg0: Sequence[float], arg1: bool, /) -> tuple[Any, ...]: ...
    @property
    def apart(self) -> bool: ...
    @property
    def block(self) -> str: ...
    @property
    def context(self) -> Context: ...
    @property
    def dense(self) -> bool: ...
    @property
    def event_count(self) -> int: ...
    @property
    def event_names(self) -> list[str]: ...
    @property
    def islands(self) -> list[Any]: ...
    @property
    def joints(self) -> np.ndarray: ...
    @property
    def jump(self) -> NDArray[np.int32]: ...
    @property
    def message(self) -> str: ...
    @property
    def outputs(self) -> dict[str, NDArray[np.float64]]: ...
    @property
    def sensitivities(self) -> Any: ...
    @property
    def span(self) -> tuple[float, float]: ...
    @property
    def statistics(self) -> dict[str, Any]: ...
    @property
    def status(self) -> str: ...
    @property
    def time(self) -> np.ndarray: ...

class SimulatorOptions:
    dense_output: bool
    event_rows: bool
    find_sparsity: bool
    interrupt: Callable[[], bool] | None
    islands: bool
    linear_solver: str
    ode_solver_method: str
    record_events: bool
    save_steps: bool | None

    def __init__(self) -> None: ...
    def set_recorded_signals(self, arg0: Sequence[tuple[str, AnySystem, int]], /) -> None: ...
    @property
    def atol(self) -> float | list[float]: ...
    @atol.setter
    def atol(self, arg1: Any) -> None: ...
    @property
    def event_scan_points(self) -> int | None: ...
    @event_scan_points.setter
    def event_scan_points(self, arg0: int | None) -> None: ...
    @property
    def event_seed(self) -> float: ...
    @event_seed.setter
    def event_seed(self, arg0: float) -> None: ...
    @property
    def first_step(self) -> float | None: ...
    @first_step.setter
    def first_step(self, arg0: float | None) -> None: ...
    @property
    def island_threads(self) -> int: ...
    @island_threads.setter
    def island_threads(self, arg0: int) -> None: ...
    @property
    def max_major_step_length(self) -> float: ...
    @max_major_step_length.setter
    def max_major_step_length(self, arg0: float) -> None: ...
    @property
    def max_major_steps(self) -> int | None: ...
    @max_major_steps.setter
    def max_major_steps(self, arg0: int | None) -> None: ...
    @property
    def max_minor_step_size(self) -> float: ...
    @max_minor_step_size.setter
    def max_minor_step_size(self, arg0: float) -> None: ...
    @property
    def max_passes(self) -> int: ...
    @max_passes.setter
    def max_passes(self, arg0: int) -> None: ...
    @property
    def min_minor_step_size(self) -> float: ...
    @min_minor_step_size.setter
    def min_minor_step_size(self, arg0: float) -> None: ...
    @property
    def rtol(self) -> float | list[float]: ...
    @rtol.setter
    def rtol(self, arg1: Any) -> None: ...
    @property
    def save_at(self) -> list[float]: ...
    @save_at.setter
    def save_at(self, arg0: Sequence[float]) -> None: ...
    @property
    def sensitivity(self) -> list[str]: ...
    @sensitivity.setter
    def sensitivity(self, arg0: Sequence[str]) -> None: ...
    @property
    def zeno_tolerance(self) -> float: ...
    @zeno_tolerance.setter
    def zeno_tolerance(self, arg0: float) -> None: ...

class Plan:
    def __init__(
        self, arg0: AnySystem, arg1: SimulatorOptions, arg2: Any, arg3: str, /
    ) -> None: ...
    @property
    def blocks(self) -> int: ...

class Simulator:
    def __init__(self, arg0: Plan, arg1: Any, /) -> None: ...
    def advance_to(self, arg0: float, /) -> str: ...
    def describe(self) -> str: ...
    def initialize(self, arg0: Context, /) -> None: ...
    def last_results(self) -> tuple[Results, BaseException | None]: ...
    def replace_traces(self) -> bool: ...
    def results(self) -> tuple[Results, BaseException | None]: ...
    @property
    def context(self) -> Context: ...
    @property
    def events(self) -> int: ...
    @property
    def time(self) -> float: ...

class Linearization:
    def method(self) -> str: ...
    @property
    def A(self) -> np.ndarray: ...
    @property
    def B(self) -> np.ndarray: ...
    @property
    def C(self) -> np.ndarray: ...
    @property
    def D(self) -> np.ndarray: ...
    @property
    def differences(self) -> list[str]: ...
    @property
    def frozen(self) -> dict[str, Any]: ...
    @property
    def guards(self) -> list[tuple[str, float, str]]: ...
    @property
    def inputs(self) -> list[str]: ...
    @property
    def outputs(self) -> list[str]: ...
    @property
    def states(self) -> list[str]: ...
    @property
    def time(self) -> float: ...
    @property
    def u(self) -> np.ndarray: ...
    @property
    def x(self) -> np.ndarray: ...
    @property
    def xdot(self) -> np.ndarray: ...
    @property
    def y(self) -> np.ndarray: ...

class Linearizer:
    def __init__(
        self,
        arg0: AnySystem,
        arg1: Sequence[tuple[str, Any]],
        arg2: Sequence[tuple[str, AnySystem, int]],
        arg3: bool,
        arg4: Any,
        /,
    ) -> None: ...
    def at(self, arg0: Context, /) -> Linearization: ...

class Ensemble:
    def __init__(
        self,
        arg0: AnySystem,
        arg1: Context,
        arg2: tuple[float, float],
        arg3: SimulatorOptions,
        arg4: Any,
        arg5: str,
        /,
    ) -> None: ...
    def run(
        self, arg0: int, arg1: Sequence[float], arg2: Any, arg3: Any, /
    ) -> tuple[dict[str, Any], BaseException | None]: ...
    def state_names(self, arg0: str, /) -> list[str]: ...
    def vary(self, arg0: str, arg1: Any, /) -> None: ...
    @property
    def has_modes(self) -> bool: ...
    @property
    def size(self) -> int: ...

class SystemHandle: ...

class SharedSystem(System):
    def __init__(self, arg0: SystemHandle, /) -> None: ...
    def block(self, arg0: str, /) -> SystemHandle: ...
    @property
    def block_names(self) -> list[str]: ...
    @property
    def system_id(self) -> int: ...

class Scene:
    @property
    def context(self) -> Context: ...
    @property
    def growth(self) -> float: ...
    @property
    def invariants(self) -> list[str]: ...
    @property
    def methods(self) -> list[str]: ...
    @property
    def options(self) -> SimulatorOptions: ...
    @property
    def provenance(self) -> str: ...
    @property
    def recorded_signals(self) -> list[tuple[str, SystemHandle, int]]: ...
    @property
    def system(self) -> SystemHandle: ...
    @property
    def t_span(self) -> tuple[float, float]: ...

class WorkOptions:
    def __init__(self) -> None: ...
    @property
    def atol_over_rtol(self) -> float: ...
    @atol_over_rtol.setter
    def atol_over_rtol(self, arg0: float) -> None: ...
    @property
    def least_time(self) -> float: ...
    @least_time.setter
    def least_time(self, arg1: float) -> None: ...
    @property
    def methods(self) -> list[str]: ...
    @methods.setter
    def methods(self, arg0: Sequence[str]) -> None: ...
    @property
    def most_repeats(self) -> int: ...
    @most_repeats.setter
    def most_repeats(self, arg1: int) -> None: ...
    @property
    def rtols(self) -> list[float]: ...
    @rtols.setter
    def rtols(self, arg0: Sequence[float]) -> None: ...
    @property
    def time_limit(self) -> float: ...
    @time_limit.setter
    def time_limit(self, arg0: float) -> None: ...

class Trace:
    def __init__(
        self, arg0: int, arg1: Tape, arg2: Any, arg3: bool, arg4: bool, arg5: bool, arg6: bool, /
    ) -> None: ...

class Traces:
    def __init__(self, arg0: AnySystem, /) -> None: ...
    def blocks(self) -> list[Any]: ...
    def guess_shapes(self) -> None: ...
    def set(self, arg0: int, arg1: Sequence[Trace], /) -> None: ...
    def share(self, arg0: int, arg1: Sequence[int], arg2: Sequence[int], /) -> None: ...
    @property
    def complete(self) -> bool: ...
    @property
    def stale(self) -> bool: ...

def add_invariant(arg0: Scene, arg1: str, arg2: Any, /) -> None: ...
def called_functions() -> dict[str, Any]: ...
def check_derivatives(
    arg0: AnySystem, arg1: Context, arg2: float, /
) -> list[tuple[str, str, int, float, float]]: ...
def context_from_dict(system: AnySystem, data: dict[str, Any]) -> Context:
    """
    The context of `system` that Context.to_dict gave. Raises ModelError for other data.
    """

def entry_names(arg0: Context, /) -> list[str]: ...
def evaluate_input(arg0: AnySystem, arg1: AnySystem, arg2: int, arg3: Context, /) -> Any: ...
def evaluate_output(arg0: AnySystem, arg1: AnySystem, arg2: int, arg3: Context, /) -> Any: ...
def evaluate_time_derivatives(arg0: AnySystem, arg1: Context, arg2: AnySystem, /) -> np.ndarray: ...
def find_entry(arg0: Context, arg1: str, /) -> int: ...
def fix_input(arg0: AnySystem, arg1: int, arg2: Any, /) -> None: ...
def fixes() -> int: ...
def fixes_input(arg0: AnySystem, arg1: int, /) -> bool: ...
def free_input(arg0: AnySystem, arg1: int, /) -> None: ...
def known_names(arg0: str, arg1: Sequence[str], /) -> str:
    """
    The end of a message about an unknown name.
    """

def made(arg0: Any, /) -> bool: ...
def modes_to_mermaid(arg0: AnySystem, /) -> str: ...
def next_name(arg0: str, /) -> str: ...
def numbers(numbers: Any, what: str) -> NDArray[np.float64]:
    """
    Numbers as an array of doubles. ModelError that begins with `what` for what is none.
    """

def scene(arg0: str, arg1: Sequence[tuple[str, float]], /) -> Scene: ...
def scene_parameters(arg0: str, /) -> list[tuple[str, float]]: ...
def set_event_times(arg0: Scene, arg1: Sequence[tuple[str, ArrayLike]], /) -> None: ...
def set_gap(arg0: Scene, arg1: Any, /) -> None: ...
def set_samples(
    arg0: Scene, arg1: Sequence[float], arg2: Sequence[Any], arg3: bool, arg4: str, /
) -> None: ...
def shelf() -> list[tuple[str, str]]: ...
def status_names() -> list[str]: ...
def to_dot(
    arg0: AnySystem, arg1: Sequence[tuple[str, AnySystem, int]] | None, arg2: int | None, /
) -> str: ...
def to_mermaid(
    arg0: AnySystem, arg1: Sequence[tuple[str, AnySystem, int]] | None, arg2: int | None, /
) -> str: ...
def trace(arg0: AnySystem, arg1: Any, /) -> None: ...
def user_scene(
    arg0: AnySystem, arg1: Context, arg2: tuple[float, float], arg3: SimulatorOptions, arg4: Any, /
) -> Scene: ...
def with_entry(arg0: Context, arg1: str, arg2: Any, /) -> Context: ...
def work_precision(arg0: Scene, arg1: WorkOptions, arg2: str, arg3: str, /) -> str: ...

__version__: str
