"""The common part of the adapters: it runs each tolerance once for the answer, then repeatedly for
the time.
"""

import json
import statistics
import sys
import time

RTOLS = (1e-4, 1e-6, 1e-8, 1e-10, 1e-12)
LIMIT = 10.0  # [s] a scene of which one run takes longer is not tightened further


def measured(run):
    """The cold time, the median of the warm times [s], and the answer of the run."""
    start = time.perf_counter()
    answer = run()
    cold, times = time.perf_counter() - start, []
    timed = getattr(run, "timed", run)  # without what only a comparison needs
    while sum(times) < 0.2 or len(times) < 2:
        start = time.perf_counter()
        timed()
        times.append(time.perf_counter() - start)
        if times[-1] > LIMIT:
            break
    return cold, statistics.median(times), answer


def main(name, methods, scenes, rtols=RTOLS):
    """Prints a JSON line for each run. `methods` is {label: (scene, rtol) -> run, or None where it
    does not suit}; `run()` returns the event times, ascending, and the state at the end.
    """
    for scene_name, scene in scenes.items():
        for label, make in methods.items():
            for rtol in rtols:
                row = {"peer": name, "method": label, "scene": scene_name, "rtol": rtol}
                try:
                    run = make(scene, rtol)
                    if run is None:
                        break
                    cold, warm, (events, end) = measured(run)
                    row |= {"cold": cold, "seconds": warm}
                    row |= {
                        "events": [float(t) for t in events if t > 0.0],
                        "end": [float(x) for x in end],
                    }
                except Exception as error:
                    row["failed"] = f"{type(error).__name__}: {error}"[:200]
                print(json.dumps(row))
                sys.stdout.flush()
                if row.get("seconds", 0.0) > LIMIT / 5:
                    break
