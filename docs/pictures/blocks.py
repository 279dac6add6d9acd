"""The pictures of docs/blocks.md: what blocks give, from runs.

`python docs/pictures/blocks.py [--out FOLDER]`
"""

import argparse
from pathlib import Path

import make  # its style
import numpy as np
import saltus
from make import INK, PALE, plt
from saltus.library import (
    PID,
    Abs,
    Backlash,
    Chirp,
    Comparator,
    Constant,
    Counter,
    DataSource,
    DeadZone,
    DelayN,
    Derivative,
    DerivativeDiscrete,
    DiscreteClock,
    EdgeDetection,
    EnabledSubsystem,
    FilterDiscrete,
    Gain,
    Integrator,
    IntegratorDiscrete,
    LookupTable1d,
    LookupTable2d,
    LookupTableNd,
    LTISystemDiscrete,
    MassWithFriction,
    MinMax,
    PIDDiscrete,
    Pulse,
    Quantizer,
    RandomNumber,
    RateLimiter,
    RateTransition,
    Relay,
    RigidBody,
    Saturate,
    Sawtooth,
    SecondOrderIntegrator,
    Sign,
    Sine,
    SlewRateLimiter,
    StateMachine,
    TransferFunction,
    TransferFunctionDiscrete,
    Transition,
    TransportDelay,
    TriggeredSubsystem,
    UnitDelay,
    WhiteNoise,
)

TIMES = np.linspace(0.0, 10.0, 801)
SINE = Sine(2.0)
TABLE = LookupTable1d([-2.0, -0.5, 0.5, 2.0], [-1.0, 1.0, -1.0, 1.0])
STEP = Pulse(1.0, period=10.0, pulse_width=0.6, phase_delay=1.0)
SCENES = [
    ("Sign", Sign(), SINE),
    ("DeadZone", DeadZone(1.0), SINE),
    ("DeadZone, shifted", DeadZone(1.0, shifted=True), SINE),
    ("Quantizer", Quantizer(0.5), SINE),
    ("Relay", Relay(1.0, -1.0, off_value=-1.0), SINE),
    ("LookupTable1d", TABLE, SINE),
    ("MinMax, of two sines", MinMax("max"), SINE),
    ("TransferFunction", TransferFunction([4.0], [1.0, 0.8, 4.0]), STEP),
    ("Derivative", Derivative(2.0), STEP),
    ("PID, limited", PID(0.5, ki=0.5, lower_limit=-1.5, upper_limit=1.5), STEP),
    ("RateLimiter", RateLimiter(0.25, 0.5, -1.0), STEP),
    ("UnitDelay", UnitDelay(1.0), SINE),
]


COSINE = Sine(2.0, phase=np.pi / 2)
SECOND = Sine(2.0, phase=2.0)
SAMPLED = [
    ("DelayN, 3", DelayN(0.5, 3), [SINE]),
    ("RateTransition", RateTransition(0.5), [SINE]),
    ("FilterDiscrete", FilterDiscrete(0.5, [0.25] * 4), [SINE]),
    ("DerivativeDiscrete", DerivativeDiscrete(0.5), [SINE]),
    ("IntegratorDiscrete", IntegratorDiscrete(0.5), [SINE]),
    ("TransferFunctionDiscrete", TransferFunctionDiscrete(0.5, [0.3], [1.0, -0.7]), [STEP]),
    (
        "LTISystemDiscrete",
        LTISystemDiscrete(0.5, [[1, 0.4], [-0.4, 0.6]], [[0], [0.4]], [[1, 0]]),
        [STEP],
    ),
    ("PIDDiscrete", PIDDiscrete(0.5, 0.5, ki=0.5, upper_limit=1.5), [STEP]),
    ("EdgeDetection, either", EdgeDetection(0.5, "either"), [STEP]),
    ("DiscreteClock", DiscreteClock(1.0), []),
    ("RandomNumber", RandomNumber(0.5, seed=1), []),
    ("WhiteNoise", WhiteNoise(0.05, power=0.05), []),
    ("Chirp", Chirp(0.5, 6.0, 8.0), []),
    ("Sawtooth", Sawtooth(1.0, 0.4), []),
    ("DataSource", DataSource([0, 2, 3, 5, 8], [0, 2, -1, -1, 1]), []),
    ("DataSource, held", DataSource([0, 2, 3, 5, 8], [0, 2, -1, -1, 1], "zero_order_hold"), []),
    ("Backlash", Backlash(1.5), [SINE, COSINE]),
    ("MassWithFriction, v", MassWithFriction(coulomb=0.8, static=1.5), [SINE], 1),
    (
        "LookupTable2d",
        LookupTable2d([-1, 0, 1], [-2, 2], [[1, 0], [-1, 1], [1, 0]]),
        [SINE, COSINE],
    ),
    ("TransportDelay", TransportDelay(1.5), [STEP]),
]

PUMP = StateMachine(
    ["filling", "draining"],
    [
        Transition("filling", "draining", guard=lambda u: u > 1.0),
        Transition("draining", "filling", after=2.0),
    ],
    inputs=["u"],
    outputs={"pump": {"filling": 0.0, "draining": 1.0}},
)
STATES = [
    (
        "Integrator, limited",
        Integrator(enable_limits=True, lower_limit=-1, upper_limit=1.5),
        [SINE],
    ),
    (
        "SecondOrderIntegrator,\nrebound",
        SecondOrderIntegrator(3.0, lower_limit=0.0, restitution=0.7),
        [Constant(-2.0)],
    ),
    (
        "SecondOrderIntegrator,\nlimited speed",
        SecondOrderIntegrator(upper_velocity_limit=0.5),
        [STEP],
    ),
    ("SlewRateLimiter", SlewRateLimiter(0.5, -1.0), [STEP]),
    ("Quantizer, hysteresis", Quantizer(1.0, hysteresis=0.5), [SINE]),
    ("Saturate", Saturate(lower_limit=-1.0, upper_limit=1.5), [SINE]),
    ("Abs", Abs(), [SINE]),
    ("Comparator, >", Comparator(">"), [SINE, SECOND]),
    ("Counter", Counter(), [Pulse(1.0, period=2.0)]),
    ("StateMachine", PUMP, [SINE]),
    (
        "LookupTableNd",
        LookupTableNd([[-2, 0, 2], [-2, 2]], [[1, 0], [0, 1], [1, -1]]),
        [SINE, COSINE],
    ),
    (
        "RigidBody, its rates",
        RigidBody(inertia=np.diag([1.0, 2.0, 3.0]), initial_rates=[0.01, 2.0, 0.0]),
        [Constant(np.zeros(3)), Constant(np.zeros(3))],
        3,
    ),
    ("EnabledSubsystem,\nof a Gain", EnabledSubsystem(Gain(1.0)), [SINE, SECOND]),
    (
        "EnabledSubsystem,\nof an Integrator, reset",
        EnabledSubsystem(Integrator(), states="reset", outputs="reset"),
        [Constant(1.0), SINE],
    ),
    ("TriggeredSubsystem,\nof a Gain, rising", TriggeredSubsystem(Gain(1.0)), [SINE, SECOND]),
    (
        "TriggeredSubsystem,\nof a UnitDelay, either",
        TriggeredSubsystem(UnitDelay(-1), edge="either"),
        [SINE, SECOND],
    ),
]


def draw(axis, title, block, inputs, port=0):
    """The inputs pale, the output black."""
    for each in inputs:
        axis.plot(TIMES, saltus.response(each, t=TIMES), color=PALE)
    output = saltus.response(block, *inputs, t=TIMES, rtol=1e-8, max_minor_step_size=0.1)
    axis.plot(TIMES, output[port] if isinstance(output, tuple) else output, color=INK)
    axis.set_title(title)


def sheet(scenes, rows):
    """Four blocks in a row."""
    figure, axes = plt.subplots(
        rows, 4, figsize=(6.4, 1.3 * rows), layout="constrained", sharex=True, squeeze=False
    )
    for axis, scene in zip(axes.flat, scenes, strict=True):
        draw(axis, *scene)
    for axis in axes[-1]:
        axis.set_xlabel("t [s]")
    return figure


def blocks():
    """Twelve blocks with kinks and states."""
    return sheet(
        [
            (title, block, [source, SECOND][: len(block.input_names)])
            for title, block, source in SCENES
        ],
        3,
    )


def more_blocks():
    """Twenty blocks that are sampled, sources, and parts with contact."""
    return sheet(SAMPLED, 5)


def blocks_with_states():
    """Sixteen blocks, most of them with states of their own."""
    return sheet(STATES, 4)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path(make.__file__).parent)
    folder = parser.parse_args().out
    folder.mkdir(parents=True, exist_ok=True)
    sheets = {
        "blocks.svg": blocks(),
        "blocks_states.svg": blocks_with_states(),
        "blocks_sampled.svg": more_blocks(),
    }
    for name, figure in sheets.items():
        figure.savefig(folder / name, metadata={"Date": None, "Creator": None})
        print(folder / name)


if __name__ == "__main__":
    main()
