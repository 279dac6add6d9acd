"""What a fit costs: the fit of a bouncing ball that SciML documents, beside its runs.

A ball falls from 50 m with g = 9.8, and e is sought so that it comes nearest to 20 m at 15 s, from
e = 0.8 on. The documentation of SciMLSensitivity reports 0.091 s for 300 iterations of its
optimizer on a machine of its own. Times of two machines are no ratio, so this prints evaluations
and the time of a fit in plain runs too. `python bench/fit.py` prints the table; `--batch` changes
how many fits are timed.
"""

import argparse
import time

import numpy as np
import saltus

SCIML = 0.091  # [s]


def timed(run, count):
    """[s] The least processor time of some batches."""
    run()
    spent = []
    for _ in range(5):
        before = time.process_time()
        for _ in range(count):
            run()
        spent.append((time.process_time() - before) / count)
    return min(spent)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--batch", type=int, default=20, help="default: %(default)s")
    count = parser.parse_args().batch
    ball = saltus.scene("bouncing-ball").system
    start = ball.create_context().with_continuous_state([50.0, 0.0])
    start = start.with_parameters({"g": 9.8, "e": 0.8})
    signals = {"state": "ball:y"}
    options = {"rtol": 1e-8, "atol": 1e-10}

    def plain():
        return saltus.simulate(ball, start, (0.0, 15.0), recorded_signals=signals, **options)

    run = timed(plain, 10 * count)
    print(f"{'a plain run':34}{1e6 * run:10.1f} us")
    t = np.linspace(0.1, 15.0, 150)
    many = plain_heights(ball, start, t)
    one = {"time": [15.0], "state[0]": [20.0]}
    for name, data in (("SciML's: 1 datum", one), ("150 exact heights", many)):
        begin = {"e": saltus.Free(0.8, 0.1, 1.0)}

        def fit(data=data, begin=begin):
            return saltus.fit(ball, data, begin, context=start, signals=signals)

        found, spent = fit(), timed(fit, count)
        each = spent / found.evaluations
        print(f"{name:34}{1e3 * spent:10.2f} ms  {found.evaluations} evaluations of "
              f"{each / run:.1f} runs, e = {found.parameters['e']:.7f}, "
              f"{SCIML / spent:.0f} times faster than 0.091 s")  # fmt: skip


def plain_heights(ball, start, t):
    """The heights of a ball with e = 0.8666."""
    run = saltus.simulate(
        ball,
        start.with_parameter("e", 0.8666),
        (0.0, 15.0),
        recorded_signals={"state": "ball:y"},
        save_at=t,
        event_rows=False,
        rtol=1e-10,
        atol=1e-12,
    )
    return {"time": t, "state[0]": run["state"][:, 0]}


if __name__ == "__main__":
    main()
