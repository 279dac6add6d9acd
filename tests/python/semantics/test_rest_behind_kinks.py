"""Blocks at rest whose trigger reads kinks, and resets that have no fixed point (semantics 4.5)."""

import numpy as np
import pytest
import saltus
from saltus.library import (
    Abs,
    Comparator,
    Constant,
    DeadZone,
    Integrator,
    LookupTable1d,
    Saturate,
    Sign,
    Sine,
    Step,
    ZeroOrderHold,
)

METHODS = ["dopri5", "dop853", "radau", "bdf"]
START, RATE, AMPLITUDE, FREQUENCY, PHASE, OFFSET = 0.79, 1.4, 1.138, 3.177, 1.4836, -0.097
KINKS = {
    "none": None,
    "Abs": Abs,
    "Saturate": lambda: Saturate(-2.0, 2.0),
    "DeadZone": lambda: DeadZone(0.1),
    "LookupTable1d": lambda: LookupTable1d([-1.0, 0.0, 2.0], [-1.0, 0.0, 2.0]),
}


def tick(builder, x, level):
    builder.connect(x, builder.add(ZeroOrderHold(0.37)).input())


def step(builder, x, level):
    builder.connect(
        builder.add(Step(0.0, 1.0, 1.0)).output(), builder.add(Integrator()).input("in")
    )


def sign(builder, x, level):
    side = builder.add(Sign())
    builder.connect(level, side.input())
    builder.connect(side.output(), builder.add(Integrator()).input("in"))


def scene(kink, other):
    """x' = 1.4, reset to 0.79 while x is above a sine: it rests where the sine is below 0.79."""
    builder = saltus.DiagramBuilder()
    x = builder.add(Integrator(START, enable_reset=True, name="x"))
    level = builder.add(Sine(AMPLITUDE, FREQUENCY, PHASE, OFFSET))
    above = builder.add(Comparator(">"))
    builder.connect(builder.add(Constant(RATE)).output(), x.input("in"))
    signal = x.output()
    if kink:
        block = builder.add(kink())
        builder.connect(signal, block.input(0))
        signal = block.output()
    builder.connect(signal, above.input(0))
    builder.connect(level.output(), above.input(1))
    builder.connect(above.output(), x.input("reset_trigger"))
    if other:
        other(builder, x.output(), level.output())
    return builder.build()


def level_is_the_start():
    """The time at which the rising sine is at 0.79."""
    angle = np.arcsin((START - OFFSET) / AMPLITUDE)
    return (2.0 * np.pi + angle - PHASE) / FREQUENCY


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("other", [None, tick, step, sign], ids=lambda f: f.__name__ if f else "-")
@pytest.mark.parametrize("kink", KINKS.values(), ids=KINKS)
def test_it_is_released_when_its_trigger_falls_beside_other_events(kink, other, method):
    results = saltus.simulate(
        scene(kink, other), (0.0, 2.2), ode_solver_method=method, rtol=1e-9, atol=1e-11
    )
    released = results.events.times(kind="zeno_release")
    # The root of a sine that no state moves is located to some roundings of the time, or to the
    # error of the dense output where the solver carries the time: 100 tolerances.
    assert released == pytest.approx([level_is_the_start()], abs=1e-7)


MAPS = {
    "x + 0.3 z": lambda t, x, z: (x + 0.3 * z, 0.5 * z),
    "x + 0.3 (1.6 - t)": lambda t, x, z: (x + 0.3 * (1.6 - t), z),
    "0.999 x + 0.3 (1.6 - t)": lambda t, x, z: (0.999 * x + 0.3 * (1.6 - t), z),
    "0.3 z": lambda t, x, z: (0.3 * z, 0.5 * z),
}


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("cut", [None, 2.0])
@pytest.mark.parametrize("of", MAPS.values(), ids=MAPS)
def test_a_reset_without_a_fixed_point_on_its_surface_leaves_the_block_there(of, cut, method):
    """x' = -1, and at 0 a dose that halves, or dies out linearly: it accumulates at 1.6 s."""
    block = saltus.LeafSystem(name="block")
    block.declare_continuous_state([1.0], ode=lambda t, s: [-1.0])
    block.declare_discrete_state([1.0])

    def reset(t, s):
        x, z = of(t, s.continuous_state[0], s.discrete_state[0])
        return s.with_continuous_state([x]).with_discrete_state([z])

    block.declare_zero_crossing(lambda t, s: s.continuous_state[0], reset, direction="falling")
    results = saltus.simulate(block, (0.0, cut or 3.0), ode_solver_method=method)
    if cut:
        results = saltus.simulate(block, results.context, (cut, 3.0), ode_solver_method=method)
    # The last flight is shorter than the Zeno tolerance, and as long as it is high.
    assert abs(results.context.continuous_state[0]) < 2e-6
