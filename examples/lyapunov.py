"""The Lyapunov exponents of an oscillator with a switch, chaotic by a closed form.

u'' - 2 b u' + ((2 pi)^2 + b^2)(u - s) = 0, and s becomes the sign of u where u' = 0. The exponents
are b and 0 (N. Corron, J. Blakely, M. Stahl, Chaos 20 (2010) 023123).
"""

import argparse
import math
from typing import Any

import saltus


class Oscillator(saltus.LeafSystem):
    """States: u, u'. Discrete state: s, -1 or 1."""

    def __init__(self, b: float) -> None:
        super().__init__(name="oscillator")
        self.b = b  # [1/s]
        self.declare_continuous_state([0.4, 0.0], ode=self.ode)
        self.declare_discrete_state([1.0])
        self.declare_zero_crossing(self.rate, self.choose, name="top")

    def ode(self, time: float, state: saltus.State) -> list[float]:
        u, v = state.continuous_state
        stiffness = (2.0 * math.pi) ** 2 + self.b**2
        return [v, 2.0 * self.b * v - stiffness * (u - state.discrete_state[0])]

    def rate(self, time: float, state: saltus.State) -> Any:
        return state.continuous_state[1]

    def choose(self, time: float, state: saltus.State) -> saltus.State:
        return state.with_discrete_state([1.0 if state.continuous_state[0] >= 0.0 else -1.0])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--b", type=float, default=0.5, help="[1/s]; default: %(default)s")
    parser.add_argument("--time", type=float, default=300.0, help="[s]; default: %(default)s")
    args = parser.parse_args()

    found = saltus.lyapunov(Oscillator(args.b), time=args.time, transient=10.0)
    print(found)
    print(f"exact: {args.b} and 0 1/s, error {abs(found.exponents[0] - args.b):.1e} 1/s")


if __name__ == "__main__":
    main()
