"""A picture of each block for its part of the reference, from a run.

`python docs/pictures/each_block.py [NAME ...] [--out FOLDER]`
"""

import argparse
import sys
from pathlib import Path

import numpy as np
import saltus
from blocks import COSINE, SAMPLED, SCENES, SECOND, SINE, STATES, STEP, TIMES
from make import INK, MID, PALE, plt
from saltus import library
from saltus.library import (
    Adder,
    BusCreator,
    BusSelector,
    Clock,
    Constant,
    ControlPort,
    CrossProduct,
    Demultiplexer,
    DotProduct,
    Exponent,
    FunctionBlock,
    Gain,
    HitCrossing,
    IfThenElse,
    Logarithm,
    LogicalOperator,
    LTISystem,
    MatrixConcatenation,
    MatrixInversion,
    MatrixMultiplication,
    MatrixTransposition,
    Multiplexer,
    MultiportSwitch,
    Offset,
    Power,
    Product,
    ProductOfElements,
    Pulse,
    Ramp,
    Reciprocal,
    ReduceBlock,
    Reshape,
    ScalarBroadcast,
    Sine,
    Slice,
    SourceBlock,
    SquareRoot,
    Step,
    Stop,
    SubsystemOutput,
    SumOfElements,
    Switch,
    Trigonometric,
    ZeroOrderHold,
)

sys.path.insert(0, str(Path(__file__).parents[1] / "site"))

from style import save  # noqa: E402

FOLDER = Path(__file__).parent / "blocks"
WITHOUT = {"Transition": "a part of a StateMachine", "FeedthroughBlock": "a FunctionBlock"}
"""names of the library that are no blocks of their own"""

RISING = Sine(0.8, bias=1.0)  # above zero
SWITCHED = Pulse(1.0, period=4.0)
PAIR = Sine([2.0, 1.0], phase=[0.0, 1.0])
THREE = Sine([2.0, 1.0, 0.5], frequency=[1.0, 2.0, 0.5])


def matrix():
    """A matrix of 2 x 2 that moves and has an inverse: (2 + sin t, 0.5; sin 2t, 2)."""
    builder = saltus.DiagramBuilder()
    numbers = builder.add(
        Sine([1.0, 0.0, 1.0, 0.0], [1.0, 1.0, 2.0, 1.0], bias=[2.0, 0.5, 0.0, 2.0], name="numbers")
    )
    shaped = builder.add(Reshape((2, 2), name="shaped"))
    builder.connect(numbers.output(), shaped.input())
    builder.export_output(shaped.output(), "matrix")
    return builder.build("matrices")


def selector():
    """A selector behind its bus: it reads the names of the bus's signals."""
    builder = saltus.DiagramBuilder()
    made = builder.add(BusCreator(["position", "speed"], name="bus"))
    chosen = builder.add(BusSelector(made, ["speed"], name="chosen"))
    builder.connect(made.output(), chosen.input())
    for name in ("position", "speed"):
        builder.export_input(made.input(name), name)
    builder.export_output(chosen.output(), "speed")
    return builder.build("car")


MORE = {
    "Adder": (Adder("+-"), [SINE, SECOND]),
    "BusCreator": (BusCreator(["position", "speed"]), [SINE, COSINE]),
    "BusSelector": (selector(), [SINE, COSINE]),
    "Clock": (Clock(), []),
    "Constant": (Constant(1.5), []),
    "ControlPort": (ControlPort(), [SINE]),
    "CrossProduct": (CrossProduct(), [THREE, Constant([0.0, 0.0, 1.0])]),
    "Demultiplexer": (Demultiplexer(2), [PAIR]),
    "DotProduct": (DotProduct(), [PAIR, PAIR]),
    "Exponent": (Exponent(), [Sine(1.0)]),
    "FunctionBlock": (FunctionBlock(lambda u: u * u), [SINE]),
    "Gain": (Gain(-0.5), [SINE]),
    "IfThenElse": (IfThenElse(), [SWITCHED, SINE, SECOND]),
    "LTISystem": (LTISystem([[0, 1], [-4, -0.8]], [[0], [4]], [[1, 0]]), [STEP]),
    "Logarithm": (Logarithm(), [RISING]),
    "LogicalOperator": (LogicalOperator("and"), [SWITCHED, Pulse(1.0, period=3.0)]),
    "MatrixConcatenation": (MatrixConcatenation(2), [matrix(), Constant([[0.5, -0.5]])]),
    "MatrixInversion": (MatrixInversion(), [matrix()]),
    "MatrixMultiplication": (MatrixMultiplication(), [matrix(), PAIR]),
    "MatrixTransposition": (MatrixTransposition(), [matrix()]),
    "Multiplexer": (Multiplexer(2), [SINE, SECOND]),
    "MultiportSwitch": (
        MultiportSwitch(3), [Ramp(0.0, 0.25, 0.0), SINE, Constant(1.0), SECOND],
    ),
    "Offset": (Offset(1.0), [SINE]),
    "Power": (Power(3.0), [Sine(1.2)]),
    "Product": (Product("**"), [SINE, SECOND]),
    "ProductOfElements": (ProductOfElements(), [PAIR]),
    "Pulse": (Pulse(1.5, period=4.0, pulse_width=0.25, phase_delay=1.0), []),
    "Ramp": (Ramp(0.0, 0.5, 2.0), []),
    "Reciprocal": (Reciprocal(), [RISING]),
    "ReduceBlock": (ReduceBlock(2, lambda u: np.hypot(u[0], u[1])), [SINE, SECOND]),
    "Reshape": (Reshape((2, 1)), [PAIR]),
    "ScalarBroadcast": (ScalarBroadcast(2), [SINE]),
    "Sine": (Sine(2.0, 1.5, phase=0.5, bias=0.5), []),
    "Slice": (Slice([0, 2]), [THREE]),
    "SourceBlock": (SourceBlock(lambda t: np.sin(t) * np.exp(-0.2 * t)), []),
    "SquareRoot": (SquareRoot(), [RISING]),
    "Step": (Step(0.0, 1.0, step_time=3.0), []),
    "SubsystemOutput": (SubsystemOutput(), [SINE, SWITCHED]),
    "SumOfElements": (SumOfElements(), [PAIR]),
    "Switch": (Switch(threshold=0.5), [SINE, SWITCHED, SECOND]),
    "Trigonometric": (Trigonometric("tanh"), [SINE]),
    "ZeroOrderHold": (ZeroOrderHold(0.5), [SINE]),
}  # fmt: skip


def scenes():
    """{name of a block: (title, block, inputs, output)} of all blocks that have outputs."""
    first = [
        (title, block, [source, SECOND][: len(block.input_names)])
        for title, block, source in SCENES
    ]
    found = {name: (name, *rest) for name, rest in MORE.items()}
    for title, *rest in [*first, *SAMPLED, *STATES]:
        found.setdefault(title.split(",")[0], (title, *rest))
    return found


def panel():
    figure, axis = plt.subplots(figsize=(3.2, 1.5), layout="constrained")
    axis.set_xlabel("t [s]")
    return figure, axis


def flat(rows):
    return np.asarray(rows, dtype=float).reshape(len(TIMES), -1)


def picture(title, block, inputs, port=0):
    """The inputs pale, the output black, each of their entries."""
    figure, axis = panel()
    for each in inputs:
        axis.plot(TIMES, flat(saltus.response(each, t=TIMES)), color=PALE)
    output = saltus.response(block, *inputs, t=TIMES, rtol=1e-8, max_minor_step_size=0.1)
    shown = output[port] if isinstance(output, tuple) else output
    axis.plot(TIMES, flat(shown), color=INK)
    axis.set_title(title.replace("\n", " "))
    return figure


def without_outputs(block, events):
    """A signal with what the block does to its run: a mark where it logs, an end where it stops."""
    builder = saltus.DiagramBuilder()
    source = builder.add(Sine(2.0, name="source"))
    builder.add(block)
    builder.connect(source.output(), block.input())
    builder.export_output(source.output(), "u")
    results = saltus.simulate(
        builder.build(), (0.0, 10.0), dense_output=True, max_minor_step_size=0.1
    )
    figure, axis = panel()
    end = results.context.time
    shown = TIMES[end >= TIMES]
    axis.plot(shown, results(shown)["u"], color=PALE)
    times = [e.time for e in results.events if e.name in events]
    axis.plot(times, results(times)["u"], "o", color=INK, ms=4)
    axis.axhline(0.0, color=MID, lw=0.6)
    axis.set_xlim(-0.5, 10.5)
    axis.set_title(f"{type(block).__name__}, at {len(times)} events")
    return figure


def stop():
    """A run that ends where a signal passes 1.5."""
    figure, axis = panel()
    builder = saltus.DiagramBuilder()
    source, limit, above = builder.add(
        Sine(2.0, name="u"), Constant(1.5, name="limit"), library.Comparator(">", name="above")
    )
    end = builder.add(Stop(name="stop"))
    builder.connect(source.output(), above.input(0))
    builder.connect(limit.output(), above.input(1))
    builder.connect(above.output(), end.input())
    builder.export_output(source.output(), "u")
    results = saltus.simulate(builder.build(), (0.0, 10.0), dense_output=True)
    last = results.context.time
    shown = np.append(TIMES[last > TIMES], last)
    axis.plot(shown, results(shown)["u"], color=PALE)
    axis.plot(last, 1.5, "o", color=INK, ms=4)
    axis.axhline(1.5, color=MID, lw=0.6)
    axis.set_xlim(-0.5, 10.5)
    axis.set_title("Stop, where u > 1.5")
    return figure


def figure_of(name):
    if name == "HitCrossing":
        return without_outputs(HitCrossing(name="hits"), ("hit",))
    return stop() if name == "Stop" else picture(*scenes()[name])


def names():
    """The blocks of the library."""
    return sorted(set(library.__all__) - set(WITHOUT))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", help="blocks; all if none is given")
    parser.add_argument("--out", type=Path, default=FOLDER)
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    for name in arguments.names or names():
        save(figure_of(name), arguments.out / f"{name}.svg")


if __name__ == "__main__":
    main()
