"""A heater that a thermostat switches: two functions, two guards, one call.

Temperature T [°C] follows dT/dt = (heat P - (T - T_out)) / tau. The heater goes on at 19 °C, off at
21 °C; between the two, T is an exponential, so the length of a cycle is known.
"""

import argparse
import math

import numpy as np
import saltus

TAU, POWER, OUTSIDE = 3600.0, 30.0, 5.0  # [s], [K], [°C]
LOW, HIGH = 19.0, 21.0  # [°C]


def flow(t: float, x: np.ndarray) -> list[float]:
    temperature, heat = x
    return [(heat * POWER - (temperature - OUTSIDE)) / TAU, 0.0]


def cycle() -> float:
    """[s] From one switching on to the next, by the closed form."""
    rise = math.log((OUTSIDE + POWER - LOW) / (OUTSIDE + POWER - HIGH))
    fall = math.log((HIGH - OUTSIDE) / (LOW - OUTSIDE))
    return TAU * (rise + fall)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--hours", type=float, default=6.0, help="default: %(default)s")
    parser.add_argument("--method", default="auto", help="default: %(default)s")
    parser.add_argument("--save", metavar="FILE", help="write a picture")
    args = parser.parse_args()

    cold = saltus.Guard(
        lambda t, x: x[0] - LOW, reset=lambda t, x: [x[0], 1.0], direction="falling", name="cold"
    )
    warm = saltus.Guard(
        lambda t, x: x[0] - HIGH, reset=lambda t, x: [x[0], 0.0], direction="rising", name="warm"
    )
    solution = saltus.solve(
        flow,
        (0.0, 3600.0 * args.hours),
        [20.0, 1.0],
        events=[cold, warm],
        method=args.method,
        rtol=1e-10,
        dense_output=True,
    )
    print(solution)
    on = solution.events.times("cold")
    print(f"a cycle is {np.diff(on)[0]:.6f} s long, by the closed form {cycle():.6f} s")
    print(f"after one hour: {solution(3600.0)['x'][0]:.4f} °C")
    if args.save:
        axes = solution.plot("x[0]")
        axes.set(ylabel="temperature [°C]")
        axes.figure.savefig(args.save, dpi=150)


if __name__ == "__main__":
    main()
