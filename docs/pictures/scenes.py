"""The runs that make.py draws."""

import itertools

import numpy as np
import saltus
from saltus.library import Step

G = 9.81  # [m/s^2]
FALLING = "positive_then_non_positive"
RISING = "negative_then_non_negative"


class Leaf(saltus.LeafSystem):
    """A leaf whose declarations its maker adds."""


def ball(e=0.6, name="ball", floor_is_input=False):
    """State: height y [m], velocity v [m/s]; the floor is at 0, or input 0."""
    leaf = Leaf(name=name)
    if floor_is_input:
        leaf.declare_input_port("floor")
    leaf.declare_continuous_state(2, ode=lambda t, s, *u: np.array([s.continuous_state[1], -G]))
    leaf.declare_continuous_state_output(name="state")

    def height(t, s, floor=0.0):
        return s.continuous_state[0] - floor

    def bounce(t, s, floor=0.0):
        return s.with_continuous_state([floor, -e * s.continuous_state[1]])

    leaf.declare_zero_crossing(height, bounce, name="bounce", direction=FALLING)
    return leaf


def grid(end, count=400):
    return {"save_at": np.linspace(0, end, count)}


def ball_rows(fine, end=1.6, e=0.6):
    """A ball dropped from 1 m: rows at many times, or at the solver's steps."""
    leaf = ball(e)
    context = leaf.create_context().with_continuous_state([1.0, 0.0])
    options = grid(end, 1200) if fine else {"max_minor_step_size": 0.1}
    recorded = {"state": leaf.output("state")}
    return saltus.simulate(leaf, context, (0, end), recorded_signals=recorded, **options)


def ball_from_floor(v):
    """A ball that starts exactly on its floor with velocity v."""
    leaf = ball(e=0.6)
    leaf.declare_output_port(lambda t, s: s.continuous_state[0], name="g")
    context = leaf.create_context().with_continuous_state([0.0, float(v)])
    recorded = {"g": leaf.output("g")}
    return saltus.simulate(leaf, context, (0, 1.1), recorded_signals=recorded, **grid(1.1))


def orbit():
    """One turn a second, ended where it crosses the line from which it starts."""
    turn = 2 * np.pi
    leaf = Leaf(name="orbit")

    def ode(t, s):
        x, y = s.continuous_state
        return np.array([-turn * y, turn * x])

    leaf.declare_continuous_state(2, ode=ode)
    leaf.declare_output_port(lambda t, s: s.continuous_state[1], name="g")
    leaf.declare_zero_crossing(
        lambda t, s: s.continuous_state[1], name="finish", direction=RISING, terminal=True
    )
    context = leaf.create_context().with_continuous_state([1.0, 0.0])
    recorded = {"g": leaf.output("g")}
    return saltus.simulate(leaf, context, (0, 2), recorded_signals=recorded, **grid(2, 800))


def domino(number):
    """A number that becomes 1 when its input has; the first one does at t = 1 s."""
    leaf = Leaf(name=f"block {number}")
    leaf.declare_discrete_state([0.0])
    leaf.declare_discrete_state_output(name="z")
    if number == 1:
        leaf.declare_continuous_state(1, ode=lambda t, s: np.ones(1))
        guard = lambda t, s: s.continuous_state[0] - 1.0  # noqa: E731
    else:
        leaf.declare_input_port("before")
        guard = lambda t, s, before: np.ravel(before)[0] - 0.5  # noqa: E731
    leaf.declare_zero_crossing(
        guard, lambda t, s, *u: s.with_discrete_state([1.0]), name="push", direction=RISING
    )
    return leaf


def dominoes():
    """Five blocks, each of which pushes the next."""
    builder = saltus.DiagramBuilder()
    blocks = [builder.add(domino(i)) for i in range(1, 6)]
    for before, after in itertools.pairwise(blocks):
        builder.connect(before.output("z"), after.input(0))
    diagram = builder.build()
    recorded = {block.name: block.output("z") for block in blocks}
    return saltus.simulate(
        diagram,
        diagram.create_context(),
        (0, 2),
        recorded_signals=recorded,
        save_at=np.linspace(0, 2, 9),
    )


def ball_on_step(after):
    """A ball that comes to rest on a floor which at 2 s steps to `after` [m]."""
    builder = saltus.DiagramBuilder()
    leaf = builder.add(ball(e=0.5, floor_is_input=True))
    ground = builder.add(Step(0.0, after, step_time=2.0, name="floor"))
    builder.connect(ground.output(), leaf.input("floor"))
    diagram = builder.build()
    start = leaf.create_context().with_continuous_state([0.5, 0.0])
    context = diagram.create_context().with_subcontext(leaf.system_id, start)
    recorded = {"state": leaf.output("state"), "floor": ground.output()}
    return saltus.simulate(diagram, context, (0, 3.2), recorded_signals=recorded, **grid(3.2, 1600))


def swing(reset):
    """x'' = -x with a guard at x = 0, which only looks, or halves and turns the velocity."""
    leaf = Leaf(name="swing")
    leaf.declare_continuous_state(
        2, ode=lambda t, s: np.array([s.continuous_state[1], -s.continuous_state[0]])
    )
    leaf.declare_continuous_state_output(name="x")

    def turn(t, s):
        _, v = s.continuous_state
        return s.with_continuous_state([0.0, -v / 2])

    leaf.declare_zero_crossing(
        lambda t, s: s.continuous_state[0], turn if reset else None, name="axis"
    )
    context = leaf.create_context().with_continuous_state([1.0, 0.0])
    recorded = {"x": leaf.output("x")}
    return saltus.simulate(leaf, context, (0, 12), recorded_signals=recorded, **grid(12))


def relay(width):
    """x' = -1 above, x' = +1 below: it switches at +width and -width."""
    leaf = Leaf(name="relay")
    leaf.declare_default_mode(1)
    leaf.declare_continuous_state([0.3], ode=lambda t, s: np.array([-float(s.mode)]))
    leaf.declare_continuous_state_output(name="x")
    leaf.declare_zero_crossing(
        lambda t, s: s.continuous_state[0] + width,
        name="down",
        direction=FALLING,
        start_mode=1,
        end_mode=-1,
    )
    leaf.declare_zero_crossing(
        lambda t, s: s.continuous_state[0] - width,
        name="up",
        direction=RISING,
        start_mode=-1,
        end_mode=1,
    )
    recorded = {"x": leaf.output("x")}
    return saltus.simulate(
        leaf, leaf.create_context(), (0, 1), recorded_signals=recorded, throw=False, **grid(1)
    )
