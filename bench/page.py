"""Writes docs/error_against_run_time.md, with its charts, from the results of the benchmarks.

python bench/page.py build/bench/results docs/error_against_run_time.md
"""

import datetime
import json
import math
import sys
from pathlib import Path

from shelf_charts import draw_groups

from saltus.report import WorkPrecision

QUESTIONS = (
    "ball_floor",
    "stiff_floor",
    "stiff_targets",
    "absent",
    "instructions",
    "diagram",
    "many",
)
ALLOWED = 10.0  # achieved error over tolerance and growth: numerics, "error"


def load(folder):
    """The answers by name, those that are there, and the reports of the shelf."""
    names = (*QUESTIONS, "auto_or_best")
    files = {name: folder / f"{name}.json" for name in names}
    answers = {n: json.loads(f.read_text()) for n, f in files.items() if f.exists()}
    reports = [WorkPrecision.from_json(f) for f in sorted((folder / "shelf").glob("*.json"))]
    return answers, reports


def number(value):
    if value is None:
        return "-"
    if isinstance(value, float):
        whole = math.isfinite(value) and abs(value) >= 1000 and abs(value) < 1e7
        return f"{value:.0f}" if whole else f"{value:.3g}"
    return str(value).replace("|", "\\|")


def table(rows):
    """Markdown, numbers to the right; the columns are the keys of the first row."""
    if not rows:
        return "Nothing was measured.\n"
    names = list(max(rows, key=len))
    text = {n for n in names if any(isinstance(row.get(n), str) for row in rows)}
    lines = [names, ["---" if n in text else "---:" for n in names]]
    lines += [[number(row.get(n)) for n in names] for row in rows]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def targets(answers):
    rows = []
    for answer in answers.values():
        for t in answer["targets"]:
            found = math.inf if t["found"] is None else t["found"]
            verdict = "holds" if found <= t["limit"] else "**misses**"
            rows.append({"target": t["what"], "figure": found, "at most": t["limit"], "": verdict})
    return rows


def ratios(rows):
    """Of `ball_floor`: a line for each scene and runner, a column for each tolerance."""
    lines, method = {}, ""
    for row in rows:
        who = row["who"].strip()
        if "inlined" in who or "CVODE" in who:
            floor = who
            continue
        method = who if who.startswith("saltus") else method
        name = who if who == method else f"{method}, {who}"
        line = lines.setdefault((row["scene"], name), {"scene": row["scene"], "who": name})
        line["against"] = floor
        line[f"{row['rtol']:.0e}"] = row["ratio"]
    return list(lines.values())


def judged(report):
    """Rows with what is wrong with them: None, or a few words."""
    limit, bound = ALLOWED * report.growth, report.reference.get("bound", math.nan)
    for row in report:
        times = row["scaled_error"] / report.growth
        if row["status"] in ("failed", "interrupted", "step_limit"):
            yield row, row["message"].split(": the solution")[0] or row["status"]
        elif row["event_mismatch"]:
            yield row, f"{row['event_mismatch']} events too many or too few"
        elif row["scaled_error"] > limit and not row["error"] <= bound:
            yield row, f"error {row['error']:.1e}, {times:.0f} times tolerance and growth"
        else:
            yield row, None


def shelf_rows(reports):
    rows = []
    for report in reports:
        fine = [row for row, wrong in judged(report) if wrong is None]
        worst = max((row["scaled_error"] / report.growth for row in fine), default=None)
        order = {m: f"{p:.1f}" for m, p in report.orders.items() if not math.isnan(p)}
        rows.append({
            "scene": f"[{report.scene}](models/{page_of(report.scene)})",
            "compared with": report.reference["kind"],
            "growth": float(report.growth),
            "worst multiple": None if worst is None or math.isnan(worst) else worst,
            "right": f"{len(fine)} of {len(report)}",
            "order": ", ".join(f"{m} {p}" for m, p in order.items()) or "-",
        })  # fmt: skip
    return rows


def page_of(scene):
    return f"{scene}.md"


def failing(reports):
    """The same reason of one method is one line."""
    lines = {}
    for report in reports:
        for row, wrong in judged(report):
            if wrong is not None:
                same = wrong if row["status"] not in ("interrupted",) else "stopped after 2 s"
                key = (report.scene, row["method"], same)
                lines.setdefault(key, []).append(f"{row['rtol']:.0e}")
    return [
        {"scene": scene, "method": method, "rtol": ", ".join(rtols), "what": what}
        for (scene, method, what), rtols in lines.items()
    ]


def machine(answers, reports):
    e = next(iter(answers.values()))["environment"] if answers else reports[0].environment
    return (
        f"{e['cpu']}, {e['cores']} cores; {e['compiler']} ({e['build']}), SUNDIALS {e['sundials']}, "
        f"Saltus {e['saltus']}; {datetime.date.today()}"
    )


HEAD = """# Error against run time

What each method achieves on each scene of the [shelf](models/README.md) and what that costs; how far the engine is from
hand-written code; what it costs where a scene does not need it. `./dev bench` measures all of it and writes this page: do not edit
it. [How to read these charts](work_precision.md), and how to make one of a scene of your own; [other programs](peers.md) on the same
scenes.

Measured on: {machine}.

Ratios are of processor time, taken within one run, with the runners taking turns, and medians are given; the charts show run time by
the clock. On a busy machine ratios vary by some percent, single times by more. Steps, calls, instructions and errors do not depend on the machine.

## Targets of speed

{held} of {all} hold. 1 means as fast as what is compared with.

{targets}
Not measured here: Python and sweeps, see [performance](performance.md), "From Python"; memory,
which tests count.

"""
SHELF = """## The shelf

A result is right if its error is at most {allowed:g} x (rtol |x| + atol) x growth at every output time, where growth is by how much
the scene itself enlarges an error made on its way, and if it has the right number of events; an error that is smaller than what the
reference may be wrong by cannot be told from a right one. "Worst multiple" is the largest error of the right results, over tolerance
and growth. A growth is a bound, so multiples far below 1 are common.

{rows}
{count} of {all} results are not right by that measure, each of them listed here:

{failing}
"""
TAIL = """
## Again

```
./dev bench              # all of this, some minutes
./dev bench ball_floor   # one question; see bench/README.md for the others
```

Each program also prints its table and writes it as JSON to `build/bench/results/`; the shelf is there as one report a scene, for
`saltus.WorkPrecision.from_json` or `python -m saltus.report FILE.json`. A figure on an unoptimised SUNDIALS, such as Debian's, means
nothing; the bench preset never uses it.
"""
TITLES = {
    "ball_floor": "Ratio to hand-written code by rtol. Each method is compared with the same method, inlined for two states.",
    "stiff_targets": "Cost of an achieved error, in the measure of the shelf, |x - exact| / (atol / rtol + |exact|): time and calls are "
    "interpolated between runs at tolerances ten times apart. The ratio is that of the best of Saltus to CVODE, and where there is no "
    "CVODE that of radau to bdf. A dash: not reached by a run of two seconds or at rtol = 1e-13; for the ratio, the most exact run counts then.",
}


def write(results, page):
    answers, reports = load(Path(results))
    if not answers and not reports:
        sys.exit(f"{results}: no results; run ./dev bench")
    goals = targets(answers)
    held = sum(row[""] == "holds" for row in goals)
    text = HEAD.format(
        machine=machine(answers, reports), held=held, all=len(goals), targets=table(goals)
    )
    wrong = failing(reports)
    text += SHELF.format(
        allowed=ALLOWED, rows=table(shelf_rows(reports)), all=sum(map(len, reports)),
        count=sum(w is not None for r in reports for _, w in judged(r)), failing=table(wrong),
    )  # fmt: skip
    for title, words, chart in draw_groups(reports, page.with_suffix("")):
        text += f"### {title}\n\n{words}\n\n![{title}]({page.stem}/{chart.name})\n\n"
    text += "## Questions of speed\n\n"
    for name, answer in answers.items():
        rows = ratios(answer["rows"]) if name == "ball_floor" else answer["rows"]
        text += f"### {answer['question']}\n\n"
        text += f"{TITLES[name]}\n\n" if name in TITLES else ""
        text += table(rows) + "\n"
    page.write_text(text.rstrip() + "\n" + TAIL)
    print(f"{page}: {held} of {len(goals)} targets hold")


if __name__ == "__main__":
    write(sys.argv[1], Path(sys.argv[2]))
