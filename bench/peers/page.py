"""docs/peers.md: for each scene a table of the time to reach an error, and a chart."""

import math
import platform

import matplotlib
from matplotlib.figure import Figure

import saltus
import saltus.jit
from saltus.report import chart

COLOURS = {
    "Saltus": "#000000", "Saltus, Python": "#888888", "SciPy": "#D55E00", "scikit-sundae": "#009E73", "heyoka": "#0072B2",
    "diffrax": "#CC79A7",
}  # fmt: skip
STYLES = ("-", "--", ":", "-.")  # by method
WANTED = (1e-4, 1e-6, 1e-8, 1e-10)
HEAD = """# Other programs on the same scenes

Time to reach an achieved error, each program with the methods it offers for the scene, the fastest of them and of five tolerances:
warm, in one process each, one after the other on the same machine. `bench/peers/run.py` measures it and writes this page.

The error is the larger one of the state at the end and of the event times, these over max(1 s, t), against closed forms or published
numbers (`bench/peers/reference.py`); with an event missing or too many there is none. The column "Saltus" runs the scenes of its shelf, which
are compiled C++ with events logged; "Saltus, Python" has the plain Python functions that the other programs have too, traced, {jit},
and a simulator that is used again. heyoka and diffrax compile theirs when they are first used, which is not counted here; SciPy and
scikit-sundae call Python functions. That is how each is meant to be used, but the last two are slow by the calls more than by their
methods. A dash: not reached at the five tolerances from 1e-4 to 1e-12 that were tried. The planet of the shelf always has its
monitor, so the column "Saltus" is empty in "kepler-alone", which is the same scene without. heyoka is explicit and is not asked for Robertson.
pathsim, Drake and Collimator have no adapter yet. Adapters are a page each, in `bench/peers/`; better ones are welcome.

Measured on: {machine}. Versions: {versions}.

"""


def versions(folder, peers):
    names = {"SciPy": "scipy", "scikit-sundae": "scikit-sundae", "heyoka": "heyoka",
             "diffrax": "diffrax"}  # fmt: skip
    found = []
    for peer in peers:
        if peer in names:
            lines = (folder / f"{names[peer]}.txt").read_text().splitlines()
            found += [
                line.replace("==", " ") for line in lines if line.startswith(names[peer] + "==")
            ]
    return ", ".join(
        [f"saltus {saltus.__version__}", *found, f"Python {platform.python_version()}"]
    )


def shown(seconds):
    for factor, unit in ((1e6, "us"), (1e3, "ms")):
        if seconds * factor < 1000:
            return f"{seconds * factor:.3g} {unit}"
    return f"{seconds:.3g} s"


def best(rows, wanted):
    good = [row for row in rows if row["error"] <= wanted]
    row = min(good, key=lambda row: row["seconds"], default=None)
    return "-" if row is None else f"{shown(row['seconds'])} ({row['method']})"


def draw(scene, rows, file):
    with matplotlib.rc_context(chart.STYLE):
        figure = Figure(figsize=(5.2, 3.2), layout="constrained")
        axis = figure.subplots()
        for peer, colour in COLOURS.items():
            mine = [row for row in rows if row["peer"] == peer and math.isfinite(row["error"])]
            for style, method in zip(
                STYLES, dict.fromkeys(row["method"] for row in mine), strict=False
            ):
                line = [row for row in mine if row["method"] == method]
                axis.loglog([max(row["error"], chart.LEAST) for row in line],
                            [row["seconds"] for row in line], style, marker=".", color=colour,
                            label=f"{peer} {method}")  # fmt: skip
        axis.minorticks_off()
        axis.set_title(scene, loc="left")
        axis.set_xlabel("achieved error")
        axis.set_ylabel("run time, warm [s]")
        figure.legend(loc="outside right upper", fontsize=7)
        chart.save(figure, file)


def write(rows, said, page, requirements, date):
    peers = [peer for peer in COLOURS if any(row["peer"] == peer for row in rows)]
    e = saltus.work_precision(
        saltus.scene("bouncing-ball"), methods=["dopri5"], rtols=[1e-4]
    ).environment
    machine = f"{e['cpu']}, {e['cores']} cores; {e['compiler']}, SUNDIALS {e['sundials']}; {date}"
    jit = "as machine code" if saltus.jit.is_installed() else "without machine code"
    text = HEAD.format(machine=machine, jit=jit, versions=versions(requirements, peers))
    text += "".join(f"{line}.\n\n" for line in said)
    page.with_suffix("").mkdir(exist_ok=True)
    for scene in dict.fromkeys(row["scene"] for row in rows):
        here = [row for row in rows if row["scene"] == scene]
        text += f"## {scene}\n\n| error | {' | '.join(peers)} |\n| ---: |{' --- |' * len(peers)}\n"
        for wanted in WANTED:
            cells = [best([r for r in here if r["peer"] == peer], wanted) for peer in peers]
            text += f"| {wanted:.0e} | {' | '.join(cells)} |\n"
        draw(scene, here, page.with_suffix("") / f"{scene}.svg")
        text += f"\n![{scene}]({page.stem}/{scene}.svg)\n\n"
        failures = {f"{r['peer']} {r['method']}: {r['failed']}" for r in here if "failed" in r}
        text += "".join(f"- {line}\n" for line in sorted(failures)) + ("\n" if failures else "")
    page.write_text(text.rstrip() + "\n")
    print(page)
