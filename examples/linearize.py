"""A pole on a cart: its standing equilibrium, the matrices there, poles and step response.

The pole falls at the rate sqrt((M + m) g / (M l)).
"""

import argparse
import math
from typing import Any

import numpy as np
import saltus

CART, BOB, LENGTH, G = 1.2, 0.3, 0.5, 9.81


class CartPole(saltus.LeafSystem):
    """A point mass on a massless rod, which stands on a cart; the angle is 0 at the top."""

    def __init__(self) -> None:
        super().__init__(name="cart")
        self.declare_input_port(name="force")
        names = ["position", "speed", "angle", "rate"]
        self.declare_continuous_state([0.0, 0.1, 0.2, 0.0], names=names, ode=self.ode)

    def ode(self, time: float, state: saltus.State, force: Any) -> list[Any]:
        _, speed, angle, rate = state.continuous_state
        sin, cos = np.sin(angle), np.cos(angle)
        push = (force + BOB * LENGTH * rate**2 * sin) / (CART + BOB)
        turn = (G * sin - cos * push) / (LENGTH * (1.0 - BOB * cos**2 / (CART + BOB)))
        return [speed, push - BOB * LENGTH * turn * cos / (CART + BOB), rate, turn]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--plot", metavar="FILE", help="a picture of poles and step response")
    args = parser.parse_args()

    cart = CartPole()
    point = saltus.trim(cart, ["force", "speed", "angle", "rate"], hold=["position"])
    if not point.success:
        raise SystemExit(f"{point.status}: {point.message}")
    lin = saltus.linearize(cart, point.context, inputs=point.inputs, outputs=["position", "angle"])
    exact = math.sqrt((CART + BOB) * G / (CART * LENGTH))
    found = lin.poles().real[-1]
    print(lin)
    print(f"{point.stability}: the largest pole is {found:.9f} /s, error {abs(found - exact):.1e}")
    if args.plot:
        lin.plot(t_end=0.6)[0].figure.savefig(args.plot)


if __name__ == "__main__":
    main()
