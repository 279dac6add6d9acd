"""The steady walk of a rimless wheel: its period, and how fast deviations from it die out.

The square of the rate keeps the part cos^2(2 alpha) of a deviation in each step, alpha = pi / 8.
"""

import argparse
import math

import saltus


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--steps", type=int, default=1, help="in a period; default: %(default)s")
    parser.add_argument("--method", default="auto", help="default: %(default)s")
    args = parser.parse_args()

    wheel = saltus.scene("rimless-wheel")
    orbit = saltus.periodic_orbit(
        wheel.system,
        wheel.context,
        "wheel.spoke",
        firings=args.steps,
        ode_solver_method=args.method,
    )
    if orbit.status != "converged":
        raise SystemExit(f"{orbit.status}: {orbit.message}")
    exact = math.cos(math.pi / 4) ** (2 * args.steps)
    found = orbit.multipliers[0].real
    print(f"period {orbit.period:.6f} s after {orbit.iterations} Newton steps")
    print(f"multiplier {found:.9f}, error {abs(found - exact):.1e}")


if __name__ == "__main__":
    main()
