"""A class of Python functions at the speed of C++: the functions are traced, not rewritten.

A pendulum with drag swings against a stop. `explain()` says of each function whether it was traced;
the option python="called" calls it instead, which gives the same answer and costs the ratio below.
"""

import argparse
import time
from typing import Any

import numpy as np
import saltus


class Pendulum(saltus.LeafSystem):
    """Angle [rad] and angular velocity [rad/s]; the stop stands at 0."""

    def __init__(self, e: float = 0.8, drag: float = 0.1):
        super().__init__(name="pendulum")
        self.e = e  # coefficient of restitution: an attribute, read when the function is traced
        self.declare_continuous_state(2, ode=self.ode)
        self.declare_continuous_state_output(name="state")
        self.declare_dynamic_parameter("drag", drag)  # [1/s] lives in the context
        self.declare_zero_crossing(
            self.angle, self.bounce, name="stop", direction="positive_then_non_positive"
        )

    def ode(self, time: float, state: saltus.State, *, drag: float) -> Any:
        angle, speed = state.continuous_state
        return np.array([speed, -9.81 * np.sin(angle) - drag * speed])

    def angle(self, time: float, state: saltus.State, *, drag: float) -> Any:
        return state.continuous_state[0]

    def bounce(self, time: float, state: saltus.State, *, drag: float) -> saltus.State:
        angle, speed = state.continuous_state
        return state.with_continuous_state([abs(angle), -self.e * speed])


def timed(system: saltus.System, context: saltus.Context, python: str) -> tuple[float, Any]:
    """Best time of three runs [s], and the state at the end."""
    times = []
    for _ in range(3):
        start = time.perf_counter()
        results = saltus.simulate(system, context, (0.0, 5.0), rtol=1e-9, python=python)
        times.append(time.perf_counter() - start)
    return min(times), results.context.continuous_state


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--e", type=float, default=0.8, help="restitution (default: %(default)s)")
    args = parser.parse_args()

    pendulum = Pendulum(e=args.e)
    print(pendulum.explain())
    context = pendulum.create_context().with_continuous_state([1.0, 0.0])
    traced, end = timed(pendulum, context, "traced")
    called, other = timed(pendulum, context, "called")
    print(
        f"traced {traced * 1e3:.2f} ms, called {called * 1e3:.2f} ms: {called / traced:.0f} times"
    )
    print(f"the two differ by {np.abs(end - other).max():.1e} at the end")


if __name__ == "__main__":
    main()
