"""The same scenes through other programs: `python bench/peers/run.py [PEER ...]`, with the Python
that has the module of Saltus, such as .venv/bin/python. Each peer gets an environment of its own
under build/peers, with the versions of requirements/. The program names each peer that cannot be
installed, or fails. Writes docs/peers.md and its charts. Takes some minutes.
"""

import datetime
import json
import math
import subprocess
import sys
import venv
from pathlib import Path

HERE = Path(__file__).parent
ROOT = HERE.parent.parent
PEERS = {
    "scipy": "scipy_ivp.py",
    "scikit-sundae": "sundae.py",
    "heyoka": "heyoka_taylor.py",
    "diffrax": "diffrax_jit.py",
}
LONGEST = 400  # [s] of one peer


def environment(peer):
    """The Python of its environment, which the first call makes and fills."""
    folder = ROOT / "build" / "peers" / peer
    python = folder / "bin" / "python"
    if not python.exists():
        venv.create(folder, with_pip=True)
    wanted = HERE / "requirements" / f"{peer}.txt"
    subprocess.run([python, "-m", "pip", "install", "-q", "-r", wanted], check=True)
    return python


def rows_of(python, script):
    done = subprocess.run(
        ["timeout", str(LONGEST), python, HERE / script], capture_output=True, text=True
    )
    rows = [json.loads(line) for line in done.stdout.splitlines() if line.startswith("{")]
    if done.returncode:
        last = (done.stderr.strip().splitlines() or ["no message"])[-1]
        print(f"{script} ended with {done.returncode} after {len(rows)} runs: {last}")
    return rows


def error(row, true):
    """The larger of the errors of the end state, absolute, and of event times over max(1 s, t);
    infinite where events are missing or too many.
    """
    times, state = true[row["scene"]]
    if row["scene"] == "kepler-alone":
        row["events"] = []
    if "end" not in row or len(row["events"]) != len(times):
        return math.inf
    late = [abs(a - b) / max(1.0, b) for a, b in zip(row["events"], times, strict=True)]
    apart = [abs(a - b) for a, b in zip(row["end"], state, strict=True)]
    return max(late + apart)


def main(chosen):
    sys.path.insert(0, str(HERE))
    from page import write
    from reference import answers

    true, rows, said = answers(), [], []
    for script in ("saltus_shelf.py", "saltus_traced.py"):
        rows += rows_of(sys.executable, script)
    for peer in chosen or PEERS:
        try:
            rows += rows_of(environment(peer), PEERS[peer])
        except (subprocess.CalledProcessError, OSError) as failure:
            said.append(f"{peer} was not run: {failure}")
            print(said[-1])
    for row in rows:
        row["error"] = error(row, true)
    out = ROOT / "build" / "peers" / "results.json"
    out.write_text(json.dumps(rows, indent=1))
    write(rows, said, ROOT / "docs" / "peers.md", HERE / "requirements", datetime.date.today())


if __name__ == "__main__":
    main(sys.argv[1:])
