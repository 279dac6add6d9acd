"""How long a dropped ball takes to rest: 10 000 balls, one plan, all cores.

A ball dropped from y0 [m] with restitution e rests at t1 (1 + e) / (1 - e), t1 = sqrt(2 y0 / g).
"""

import argparse

import numpy as np
import saltus


def rest_time(results: saltus.Results) -> float:
    """[s] The accumulation time that the engine found; nan if the ball still bounces."""
    found = [event.predicted for event in results.events if event.kind == "zeno_enter"]
    return found[0] if found else np.nan


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=10_000, help="default: %(default)s")
    parser.add_argument("--executor", choices=["threads", "processes", "serial"])
    parser.add_argument("--progress", action="store_true", help="show how many runs are done")
    args = parser.parse_args()

    side = max(2, round(args.runs**0.5))
    ball = saltus.scene("bouncing-ball").system
    grid = {"e": np.linspace(0.3, 0.8, side), "x[0]": np.linspace(1.0, 10.0, side)}
    rest = saltus.sweep(
        ball,
        grid,
        (0.0, 20.0),
        reduce=rest_time,
        executor=args.executor,
        progress=args.progress,
        rtol=1e-9,
    )
    print(rest)
    e, y0 = rest["e"], rest["x[0]"]
    exact = np.sqrt(2 * y0 / 9.81) * (1 + e) / (1 - e)
    worst = float(abs(rest["rest_time"] - exact).max())
    print(f"{side * side} balls at {rest.attrs['runs_per_second']:.0f} runs/s, "
          f"worst error {worst:.1e} s")  # fmt: skip


if __name__ == "__main__":
    main()
