"""The picture of docs/blocks.md: what blocks with kinks and with states give, from runs.

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
    DeadZone,
    Derivative,
    LookupTable1d,
    MinMax,
    Pulse,
    Quantizer,
    RateLimiter,
    Relay,
    Sign,
    Sine,
    TransferFunction,
    UnitDelay,
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


def blocks():
    """Twelve blocks: the input pale, the output black."""
    figure, axes = plt.subplots(3, 4, figsize=(6.4, 3.9), layout="constrained", sharex=True)
    for axis, (title, block, source) in zip(axes.flat, SCENES, strict=True):
        inputs = [source, Sine(2.0, phase=2.0)][: len(block.input_names)]
        for each in inputs:
            axis.plot(TIMES, saltus.response(each, t=TIMES), color=PALE)
        axis.plot(TIMES, saltus.response(block, *inputs, t=TIMES, rtol=1e-8), color=INK)
        axis.set_title(title)
    for axis in axes[-1]:
        axis.set_xlabel("t [s]")
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path(make.__file__).parent)
    folder = parser.parse_args().out
    folder.mkdir(parents=True, exist_ok=True)
    blocks().savefig(folder / "blocks.svg", metadata={"Date": None, "Creator": None})
    print(folder / "blocks.svg")


if __name__ == "__main__":
    main()
