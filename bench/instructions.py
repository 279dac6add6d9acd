"""Instructions that absent machinery costs: `absent NAME on|off` under callgrind, a run twice as
long less the run, so that the plan and the start drop out. Exact, and the same on a busy machine.

    python bench/instructions.py build/bench/bin/absent build/bench/results
"""

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

PAIRS = {
    "guard": ("a guard that never fires", 5.0),
    "guard_dop853": ("the same guard, dop853", 5.0),
    "guard_inlined": ("the same guard, dopri5 inlined", 5.0),
    "guard_inlined_853": ("the same guard, dop853 inlined", 5.0),
    "guard_plan": ("the same guard in another block", 5.0),
    "recorder": ("two signals recorded", None),  # mostly memory: judged by time
    "zeno": ("the Zeno monitor", 2.0),
    "monitor": ("a monitor guard, located 20 times", 20.0),
    "monitor_dop853": ("the same monitor, dop853", 20.0),
    "ballast": ("unread blocks, constants to fold", 0.0),
}


def counted(program, name, side, stretch):
    command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null"]
    done = subprocess.run(
        [*command, program, name, side, str(stretch)], capture_output=True, text=True, check=True
    )
    return int(re.search(r"Collected : (\d+)", done.stderr)[1])


def in_the_loop(program, name, side):
    return counted(program, name, side, 2) - counted(program, name, side, 1)


def main(program, results):
    if shutil.which("valgrind") is None:
        print("instructions: valgrind is not installed, so none are counted")
        (Path(results) / "instructions.json").unlink(missing_ok=True)
        return
    rows, targets = [], []
    for name, (what, limit) in PAIRS.items():
        off, on = (in_the_loop(program, name, side) for side in ("off", "on"))
        percent = 100.0 * (on - off) / off
        rows.append({"what": what, "without": off, "with": on, "more [%]": percent})
        print(f"{what:36} {off:12} {on:12} instructions, {percent:+.2f} %")
        if limit is not None:
            targets.append({"what": f"{what}: instructions [%]", "found": percent, "limit": limit})
    question = "The same in instructions within the loop, which no other program disturbs"
    answer = {"name": "instructions", "question": question, "targets": targets, "rows": rows}
    (Path(results) / "instructions.json").write_text(json.dumps(answer, indent=1) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
