"""Taylor series of Saltus against heyoka's: `python bench/peers/taylor.py [SCENE ...]`, with the
Python that has the module of Saltus. Both are called from Python as their users would, on the same
equations, and used again: what is compiled or traced once is not counted. Prints a table of times
at equal achieved error, and keeps all runs in build/peers/taylor.json. Takes some minutes.
"""

import json
import math
import subprocess
import sys

from flights import FLIGHTS
from radau import cost_at
from run import HERE, ROOT, environment

LEVELS = (1e-6, 1e-8, 1e-10)
OURS = ("taylor", "dop853", "dopri5")


def rows_of(python, script, names):
    done = subprocess.run(
        [python, HERE / script, *names], capture_output=True, text=True, check=True
    )
    return [json.loads(line) for line in done.stdout.splitlines()]


def error(row, true):
    """The larger of the errors of the end state, over the largest entry, and of event times over
    max(1 s, t); infinite where events are missing or too many.
    """
    if "end" not in row or len(row["events"]) != len(true["events"]):
        return math.inf
    pairs = zip(sorted(row["events"]), sorted(true["events"]), strict=True)
    late = [abs(a - b) / max(1.0, b) for a, b in pairs]
    size = max(abs(x) for x in true["end"])
    return max(late + [abs(a - b) / size for a, b in zip(row["end"], true["end"], strict=True)])


def times(rows, scene, method, true):
    """The time of each level, in us."""
    mine = [r for r in rows if (r["scene"], r["method"]) == (scene, method)]
    points = [(max(1e-17, error(r, true)), 1e6 * r.get("seconds", math.inf)) for r in mine]
    points = [point for point in points if math.isfinite(point[0])]
    return [cost_at(level, points) for level in LEVELS]


def missed(rows, scene, method, true):
    """At how many tolerances events were missing or too many."""
    mine = [r for r in rows if (r["scene"], r["method"]) == (scene, method) and "events" in r]
    return sum(len(r["events"]) != len(true["events"]) for r in mine)


def table(rows, names):
    answers = {row["scene"]: row for row in rows if row["peer"] == "answer"}
    head = (
        "| scene | events | "
        + " | ".join(f"{level:.0e}" for level in LEVELS)
        + " | runs with other events |"
    )
    print(head, "| --- | ---: " + "| --- " * (len(LEVELS) + 1) + "|", sep="\n")
    for name in names:
        true = answers[name]
        theirs = times(rows, name, "Taylor", true)
        ours = {method: times(rows, name, method, true) for method in OURS}
        cells = []
        for k in range(len(LEVELS)):
            best = min(OURS, key=lambda method: ours[method][k])
            if math.isinf(ours[best][k]):
                cells.append("-")
            elif math.isinf(theirs[k]):
                cells.append(f"{ours[best][k]:.3g} us ({best}), heyoka -")
            else:
                own = ours["taylor"][k] / theirs[k]
                cells.append(
                    f"{ours[best][k] / theirs[k]:.2f} ({best}), taylor {own:.2f} of {theirs[k]:.3g} us"
                )
        wrong = f"Saltus {missed(rows, name, 'taylor', true)}, heyoka {missed(rows, name, 'Taylor', true)}"
        print(f"| {name} | {len(true['events'])} | {' | '.join(cells)} | {wrong} |")


def main(names):
    rows = rows_of(environment("heyoka"), "flights_heyoka.py", names)
    rows += rows_of(sys.executable, "flights_saltus.py", names)
    kept = ROOT / "build" / "peers" / "taylor.json"
    kept.write_text(json.dumps(rows))
    table(rows, names)


if __name__ == "__main__":
    main(sys.argv[1:] or list(FLIGHTS))
