"""`LeafSystem`: a block of your own, declared in its constructor."""

from __future__ import annotations

from saltus import _core
from saltus._porting import refusing
from saltus._quantities import Declared
from saltus.leaf_system.event_inputs import DeclaresEventInputs
from saltus.leaf_system.guards import DeclaresGuards
from saltus.leaf_system.ports import DeclaresPorts
from saltus.leaf_system.refused import RefusesDeclarations
from saltus.leaf_system.times import DeclaresTimes
from saltus.leaf_system.values import DeclaresValues
from saltus.system import System

__all__ = ["LeafSystem"]


class LeafSystem(
    System,
    DeclaresValues,
    DeclaresPorts,
    DeclaresGuards,
    DeclaresTimes,
    DeclaresEventInputs,
    RefusesDeclarations,
):
    """A block with equations of its own. Call `super().__init__(name=...)`, then declare.

    A callback runs in one of three ways; `system.explain()` names the way, and the reason if it is
    not a faster one:

    - *traced*: before a run it is called once with symbols and becomes an expression that runs
      without the interpreter, with an exact Jacobian. If a value that it read has changed, such as
      an attribute, it is traced again before the next run, and between two pieces of a run;
    - *called*: a callback that cannot be traced, for example because it branches on a value, prints
      or counts, is called for every value. With the option `python="called"` all callbacks are
      called;
    - *compiled*: a pointer to a compiled function in place of a Python one, see `saltus.compiled`.

    Every callback is called as `f(time, state, *inputs, **parameters)`:

    - `time` [s] is a float;
    - `state` has `continuous_state`, `discrete_state` (read-only arrays of the declared shapes) and
      `mode`, `relations`, and `with_continuous_state(x)`, `with_discrete_state(z)`, `with_mode(m)`,
      which return a new state;
    - inputs come in the order of the ports, a float for one number, else a read-only array.
      `requires_inputs` chooses them: True means all, False none, a list of positions those. Be
      precise: an input that is not read is neither computed nor part of a loop;
    - parameters come by keyword, a float for a number, otherwise a read-only array.

    A callback returns numbers as a list, a tuple or an array, one number as itself too; a Jacobian
    also as a sparse matrix of SciPy. A reset map or an update returns a state, or numbers alone,
    which are the one state that the block has. If the block has a continuous and a discrete state,
    the numbers of an update are the discrete state, and a reset map has to return a state. A wrong
    number of numbers is a `ModelError`.

    Every array may be kept: it never changes. A callback must not have side effects: the engine
    calls it any number of times, from the thread that runs the simulation. `simulate` raises the
    exception of a callback unchanged.

    A callback that returns numbers may fill an array instead, which is quicker. If it has an
    argument called `out`, the last or by keyword, it gets an array: of the shape of the state for
    an ode, n by n for a Jacobian, otherwise with an entry for each number. It sets every entry
    (they begin as NaN) and returns nothing; an output then has to say its `shape`.

    Examples
    --------
    >>> import saltus
    >>> class Oscillator(saltus.LeafSystem):
    ...     def __init__(self):
    ...         super().__init__(name="oscillator")
    ...         self.declare_continuous_state(default_value=[1.0, 0.0], ode=self.ode)
    ...
    ...     def ode(self, time, state, out):
    ...         x, v = state.continuous_state
    ...         out[0], out[1] = v, -x
    >>> print(Oscillator().explain())
    oscillator: ode  traced

    A room that a thermostat heats, and that counts its hours:

    >>> class Room(saltus.LeafSystem):
    ...     def __init__(self):
    ...         super().__init__(name="room")
    ...         self.declare_continuous_state(default_value=[20.0], ode=self.flow)
    ...         self.declare_discrete_state(default_value=[0.0])
    ...         self.declare_default_mode(1)
    ...         self.declare_dynamic_parameter("power", 30.0)
    ...         self.declare_input_port("outside")
    ...         self.declare_output_port(self.gap, name="gap")
    ...         self.declare_continuous_state_output("temperature")
    ...         self.declare_discrete_state_output("hours")
    ...         self.declare_mode_output("on")
    ...         self.declare_zero_crossing(self.warm, name="warm", start_mode=1, end_mode=0)
    ...         self.declare_zero_crossing(self.cold, name="cold", start_mode=0, end_mode=1)
    ...         self.declare_periodic_update(self.count, period=1.0, offset=1.0)
    ...         self.declare_one_shot(self.open_window, 0.5)
    ...
    ...     def flow(self, time, state, outside, *, power):
    ...         return [power * state.mode + outside - state.continuous_state[0]]
    ...
    ...     def gap(self, time, state, outside, *, power):
    ...         return state.continuous_state[0] - outside
    ...
    ...     def warm(self, time, state, outside, *, power):
    ...         return state.continuous_state[0] - 21.0
    ...
    ...     def cold(self, time, state, outside, *, power):
    ...         return state.continuous_state[0] - 19.0
    ...
    ...     def count(self, time, state, outside, *, power):
    ...         return state.with_discrete_state(state.discrete_state + 1.0)
    ...
    ...     def open_window(self, time, state, outside, *, power):
    ...         return state.with_continuous_state(state.continuous_state - 2.0)
    >>> from saltus.library import Constant
    >>> builder = saltus.DiagramBuilder()
    >>> room, outside = builder.add(Room(), Constant(5.0))
    >>> builder.connect(outside.output(), room.input("outside"))
    >>> house = builder.build()
    >>> end = saltus.simulate(house, house.create_context(), (0.0, 3.5)).context[room]
    >>> end.discrete_state, bool(19.0 - 2.0 <= end.continuous_state[0] <= 21.0)
    (array([3.]), True)
    """

    __slots__ = (
        "_callbacks",
        "_declared_quantities",
        "_made",
    )  # not in __dict__, which is watched for traced functions

    @refusing
    def __init__(self, name: str | None = None):
        super().__init__(name or _core.next_name(type(self).__name__))
        self._declared_quantities = Declared()
        self._made = True  # earlier, a declaration would find no block
