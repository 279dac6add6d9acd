"""A bouncing ball as a block of your own: fall, bounce, come to rest.

Height y [m] and velocity v [m/s] follow dy/dt = v, dv/dt = -g. Where y falls to 0 the ball bounces:
v becomes -e v. With e < 1 the bounces pile up at t1 (1 + e) / (1 - e), t1 = sqrt(2 y0 / g).
"""

import argparse
import math
from typing import Any

import numpy as np
import saltus


class BouncingBall(saltus.LeafSystem):
    def __init__(self, g: float = 9.81, e: float = 0.8):
        super().__init__(name="ball")
        self.e = e  # coefficient of restitution, 0 <= e <= 1
        self.declare_continuous_state(2, ode=self.ode)
        self.declare_continuous_state_output(name="state")
        self.declare_dynamic_parameter("g", g)
        self.declare_zero_crossing(
            guard=self.height,
            reset_map=self.bounce,
            name="bounce",
            direction="positive_then_non_positive",
        )

    def ode(self, time: float, state: saltus.State, *, g: float) -> list[float]:
        return [state.continuous_state[1], -g]

    def height(self, time: float, state: saltus.State, *, g: float) -> Any:
        return state.continuous_state[0]

    def bounce(self, time: float, state: saltus.State, *, g: float) -> saltus.State:
        y, v = state.continuous_state
        return state.with_continuous_state([abs(y), -self.e * v])


def draw(results: saltus.Results, args: argparse.Namespace) -> None:
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(figsize=(8, 3), layout="constrained")
    axes.plot(results.time, results.outputs["state"][:, 0])
    axes.set(xlabel="time [s]", ylabel="height [m]", title=f"A ball dropped, e = {args.e:g}")
    axes.grid(alpha=0.3)
    if args.save:
        figure.savefig(args.save, dpi=150)
    if args.show:
        plt.show()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--e", type=float, default=0.8, help="restitution (default: %(default)s)")
    parser.add_argument("--y0", type=float, default=10.0, help="[m] height (default: %(default)s)")
    parser.add_argument("--end", type=float, default=15.0, help="[s] end (default: %(default)s)")
    parser.add_argument("--save", metavar="FILE", help="write a picture")
    parser.add_argument("--show", action="store_true", help="open a picture")
    args = parser.parse_args()

    g = 9.81
    ball = BouncingBall(g=g, e=args.e)
    context = ball.create_context().with_continuous_state([args.y0, 0.0])
    results = saltus.simulate(
        ball,
        context,
        (0.0, args.end),
        recorded_signals={"state": ball.output("state")},
        save_at=np.linspace(0.0, args.end, 1001),
    )
    print(results)

    t1 = math.sqrt(2 * args.y0 / g)
    exact = t1
    print(f"{'bounce':>6} {'time [s]':>18} {'error [s]':>10}")
    for k, time in enumerate(results.events.times("bounce")[:8]):
        print(f"{k + 1:6} {time:18.15f} {abs(time - exact):10.1e}")
        exact += 2 * t1 * args.e ** (k + 1)
    for event in results.events:
        if event.kind == "zeno_enter":
            error = abs(event.predicted - t1 * (1 + args.e) / (1 - args.e)) if args.e < 1 else 0
            print(f"at rest from t = {event.predicted:.12f} s, error {error:.1e} s")
    if args.save or args.show:
        draw(results, args)


if __name__ == "__main__":
    main()
