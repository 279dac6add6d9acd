"""Radau IIA of Saltus against SciPy's: `python bench/peers/radau.py [SCENE ...]`, with the Python
that has the module of Saltus. Both get the same Python functions and the same exact Jacobian, so
that calls can be compared. Times are those of the traced functions, as users run them. Prints a table of costs at equal
achieved error, and keeps all runs in build/peers/radau.json. Takes some minutes.
"""

import json
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
from run import HERE, ROOT, environment
from stiff_scenes import SCENES

import saltus

LEVELS = (1e-3, 1e-5, 1e-7, 1e-9)
SOLVERS = (("Saltus", "radau"), ("SciPy", "Radau"), ("Saltus", "bdf"), ("SciPy", "BDF"))
TIMED = (("Saltus", "radau traced"), *SOLVERS[1:2], *SOLVERS[:1])
SLOW_PARTS = ("b5", "beam", "cusp", "plate")  # an explicit method comes to their end too


def rows_of(python, script, names):
    done = subprocess.run(
        [python, HERE / script, *names], capture_output=True, text=True, check=True
    )
    return [json.loads(line) for line in done.stdout.splitlines()]


def answer(name):
    """By a run at 1e-13 with the same functions: dop853 where it can, else radau, whose errors at
    this tolerance are below 1e-11 on the shelf's scenes, by the shelf's own answers.
    """
    scene, method = SCENES[name], "dop853" if name in SLOW_PARTS else "radau"
    more = {} if name in SLOW_PARTS else {"jacobian": scene.jacobian}
    done = saltus.solve(
        scene.f, (0.0, scene.times[-1]), scene.start, method=method, t_eval=scene.times,
        rtol=1e-13, atol=1e-13 * scene.scale, python="called", **more,
    )  # fmt: skip
    return done.y.T


def error(name, states, true):
    return float(np.max(np.abs(np.array(states) - true) / (SCENES[name].scale + np.abs(true))))


def cost_at(level, points):
    """As in bench/cost_at.hpp: the least cost of an error of `level`, from (error, cost) by rising
    tightness; between two runs a line in the logarithms.
    """
    least, before = math.inf, None
    for found, cost in points:
        if found <= level:
            least = min(least, cost)
            if before is not None and before[0] > level:
                part = math.log(level / before[0]) / math.log(found / before[0])
                least = min(least, before[1] * (cost / before[1]) ** part)
        before = (found, cost)
    return least


def shown(value):
    return "-" if not math.isfinite(value) else f"{value:.3g}" if value < 100 else f"{value:.0f}"


def cost_of(rows, scene, solver, level, key):
    mine = [row for row in rows if (row["scene"], row["peer"], row["method"]) == (scene, *solver)]
    return cost_at(level, [(row["error"], max(row[key], 1e-9)) for row in mine])


def table(rows, key, solvers, names):
    """For each scene and level the cost of each solver, and the ratio of the first to the second."""
    heads = [f"{peer} {method}" for peer, method in solvers]
    print(f"\n| scene | error | {' | '.join(heads)} | ratio |")
    print(f"| --- |{' ---: |' * (len(heads) + 2)}")
    ratios = []
    for name in names:
        for level in LEVELS:
            costs = [cost_of(rows, name, solver, level, key) for solver in solvers]
            reached = all(map(math.isfinite, costs[:2]))
            ratios += [costs[0] / costs[1]] if reached else []
            cells = " | ".join(map(shown, [*costs, ratios[-1] if reached else math.nan]))
            print(f"| {name} | {level:.0e} | {cells} |")
    mean = math.exp(np.mean(np.log(ratios)))
    print(f"\n{key}: geometric mean of {len(ratios)} ratios {mean:.2f}, worst {max(ratios):.2f}")


def main(names):
    rows = rows_of(sys.executable, "saltus_stiff.py", names)
    rows += rows_of(environment("scipy"), "scipy_stiff.py", names)
    true = {name: answer(name) for name in names}
    for row in [row for row in rows if "failed" in row]:
        print("failed:", row)
    rows = [row for row in rows if "failed" not in row]
    for row in rows:
        row["error"] = error(row["scene"], row.pop("states"), true[row["scene"]])
    Path(ROOT / "build" / "peers" / "radau.json").write_text(json.dumps(rows, indent=1))
    for key, solvers in (("calls", SOLVERS), ("seconds", TIMED)):
        table(rows, key, solvers, names)


if __name__ == "__main__":
    main(sys.argv[1:] or list(SCENES))
