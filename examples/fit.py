"""How much a ball keeps of its speed: g and e from noisy heights, and e from the times of impacts.

The confidence intervals are to have the truth, g = 9.81 m/s² and e = 0.8, nineteen times of twenty.
"""

import argparse

import numpy as np
import saltus

TRUTH = {"g": 9.81, "e": 0.8}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--noise", type=float, default=0.005, help="[m] default: %(default)s")
    parser.add_argument("--seed", type=int, default=1, help="default: %(default)s")
    parser.add_argument("--plot", metavar="FILE", help="draw the fit and its residuals")
    args = parser.parse_args()

    ball = saltus.scene("bouncing-ball").system
    start = ball.create_context().with_continuous_state([1.0, 0.0])  # 1 m, at rest
    truth = saltus.simulate(
        ball,
        start.with_parameters(TRUTH),
        (0.0, 1.5),
        recorded_signals={"state": "ball:y"},
        save_at=np.linspace(0.02, 1.5, 75),
        event_rows=False,
    )
    noise = args.noise * np.random.default_rng(args.seed).standard_normal(truth.time.size)
    heights = {"time": truth.time, "state[0]": truth["state"][:, 0] + noise}
    begin = {"g": 9.0, "e": (0.1, 1.0)}
    found = saltus.fit(ball, heights, begin, context=start, signals={"state": "ball:y"})
    print(found)

    impacts = {"bounce": saltus.EventTimes(truth.events.times("bounce").round(3))}
    print(saltus.fit(ball, impacts, {"e": (0.1, 1.0)}, context=start))
    if args.plot:
        found.plot()[0, 0].figure.savefig(args.plot)


if __name__ == "__main__":
    main()
