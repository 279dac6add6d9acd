"""The common part of the adapters of stiff scenes: a run for each tolerance, with counts and
states.
"""

import contextlib
import json
import sys
import time

RTOLS = tuple(10.0**-k for k in range(3, 12))
LONGEST = 6.0  # [s] a scene of which one run takes longer is not tightened further


def warm_up(scene, method, run):
    """Times runs. The work that a program does once, such as tracing a function, is not timed."""
    with contextlib.suppress(RuntimeError):
        run(scene, method, RTOLS[0])


def rows(peer, methods, scenes, run):
    """Prints a JSON line for each run. `run(scene, method, rtol)` gives counts and the states at
    `scene.times`; a RuntimeError, that of a run that does not come to its end, is a row too.
    """
    for name, scene in scenes.items():
        for method in methods:
            warm_up(scene, method, run)
            for rtol in RTOLS:
                row = {"scene": name, "peer": peer, "method": method, "rtol": rtol}
                start = time.process_time()
                try:
                    counts, row["states"] = run(scene, method, rtol)
                    row |= counts
                except RuntimeError as failure:
                    row["failed"] = str(failure)[:200]
                row["seconds"] = time.process_time() - start
                print(json.dumps(row))
                sys.stdout.flush()
                if row["seconds"] > LONGEST:
                    break
