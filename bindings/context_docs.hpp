// The docstrings of Context and State, which Python gets from C++ in many places.
#pragma once

namespace saltus::python::docs {

inline constexpr const char* context =
    R"(All values of a system at one time. Made by `system.create_context()`.

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
)";

inline constexpr const char* has_system =
    R"(Whether these are values of a system or of a block in it.

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
)";

inline constexpr const char* with_time = R"(This context at another time.

Parameters
----------
time
    [s]

Examples
--------
>>> from saltus.library import Clock
>>> Clock().create_context().with_time(2.5).time
2.5
)";

inline constexpr const char* with_continuous_state = R"(All continuous states replaced.

Parameters
----------
continuous_state
    A vector of all of them, or a number where there is one.

Examples
--------
>>> from saltus.library import Integrator
>>> Integrator([0.0, 0.0]).create_context().with_continuous_state([1.0, 2.0])
Context(time=0, continuous_state=[1, 2], mode=0)
)";

inline constexpr const char* with_discrete_state = R"(All discrete states replaced.

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
)";

inline constexpr const char* with_mode = R"(Another mode, of a context of one block.

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
)";

inline constexpr const char* with_parameter = R"(One parameter replaced.

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
)";

inline constexpr const char* with_parameters = R"(Several parameters replaced.

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
)";

inline constexpr const char* subcontext =
    "The context of one block or inner diagram, given it or its `system_id`.";

inline constexpr const char* with_subcontext = R"(The values of one block or inner diagram replaced.

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
)";

inline constexpr const char* to_dict = R"(Everything in it as plain data, block by block.

Returns
-------
dict
    Of strings, numbers and lists: for JSON or the like.

Examples
--------
>>> from saltus.library import Integrator
>>> Integrator(1.0).create_context().to_dict()["time"]
0.0
)";

inline constexpr const char* to_json = R"(The same as `to_dict`, as text.

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
)";

inline constexpr const char* state =
    R"(What a callback sees of its block, as a value: read-only arrays, and `with_*` that return a new
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
)";

}  // namespace saltus::python::docs
