"""saltus run: one run of a scene; how it ended, its events, the values at the end, its cost.

saltus run bouncing-ball --set e=0.9 --t-end 12 --plot ball.svg --csv ball.csv
saltus run robertson --method bdf --rtol 1e-8 --json
saltus run ball.py:make_ball --set e=0.5 --set 'x[0]=3' --t-end 5
"""

from __future__ import annotations

import argparse
import csv
import json
import math
import sys
from pathlib import Path
from typing import Any

import numpy as np

from saltus._entries import entries
from saltus._signals import port_of
from saltus._status import WELL
from saltus.cli.files import require_picture, require_suffix
from saltus.cli.scene_of import Chosen, chosen_scene
from saltus.cli.settings import add_options, add_scene, options_of, recorded_of, settings_of
from saltus.cli.table import print_table
from saltus.errors import ModelError
from saltus.results import Results
from saltus.simulation import simulate

__all__ = ["act", "add_arguments"]

NAME = "run"
INTERRUPTED = 130
MOST_ROWS = 10_000_000  # even rows, each of which takes some hundred bytes until it is written
SHOWN = 12  # values at the end that are shown one by one


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_scene(parser)
    add_options(parser)
    parser.add_argument(
        "--record", action="append", metavar="PORT", help="an output to record, not the usual ones"
    )
    parser.add_argument(
        "--save-at",
        metavar="T,T,... or N",
        help="[s] times of the rows, 5.0 or 1,2.5; or how many even ones, 101; else each step",
    )
    parser.add_argument("--csv", type=Path, metavar="FILE", help="the rows")
    parser.add_argument("--plot", type=Path, metavar="FILE", help="a chart: .svg, .png, .pdf")
    parser.add_argument("--json", action="store_true", help="the summary as one object of JSON")
    parser.add_argument("--quiet", action="store_true", help="no summary")


def act(chosen: argparse.Namespace) -> int:
    require_suffix("--csv", chosen.csv, ".csv", ".txt")
    require_picture("--plot", chosen.plot)
    scene = chosen_scene(chosen.scene, settings_of(chosen.set))
    scene = scene.with_span(chosen.t_begin, chosen.t_end)
    span = scene.required_span()
    overrides = _recording(chosen, scene, span) | options_of(chosen, scene.writes_atol)
    if "throw" in overrides:
        raise ModelError("--option throw: leave it out; the exit code says how the run ended")
    results = simulate(scene.system, scene.context, span, scene.options, throw=False, **overrides)
    _show(results, scene, chosen)
    _write(results, chosen)
    if results.status in WELL:
        return 0
    print(f"saltus run: {results.status}: {_reason(results, scene)}", file=sys.stderr)
    return INTERRUPTED if results.status == "interrupted" else 1


def _reason(results: Results, scene: Chosen) -> str:
    """The message of the run; it begins with the exception of a user's function."""
    message = results.message or "no reason is known"
    return message if scene.made is None else scene.made.explained(message)


def _recording(
    chosen: argparse.Namespace, scene: Chosen, span: tuple[float, float]
) -> dict[str, Any]:
    found: dict[str, Any] = {}
    if names := recorded_of(chosen.record):
        found["recorded_signals"] = {name: port_of(scene.system, name) for name in names}
    if chosen.save_at:
        found["save_at"] = _times(chosen.save_at, span)
        found["save_steps"] = False
    return found


def _times(text: str, span: tuple[float, float]) -> list[float]:
    try:
        if "," not in text and text.isdigit() and int(text) > 1:
            if int(text) > MOST_ROWS:
                raise ModelError(f"--save-at: expected at most {MOST_ROWS} rows, found {text}")
            return list(np.linspace(*span, int(text)))
        times = [float(t) for t in text.split(",")]
    except ModelError:
        raise
    except ValueError:
        raise ModelError(f"--save-at: expected times or how many, found '{text}'") from None
    for time in times:
        if not span[0] <= time <= span[1]:
            raise ModelError(
                f"--save-at: expected times in the run, {span[0]:g} s to {span[1]:g} s, or how "
                f"many, found {time:g}"
            )
    return times


def _summary(results: Results, scene: Chosen) -> dict[str, Any]:
    """The content of `--json`. JSON has neither nan nor inf, so they become null."""
    s = results.statistics
    context = results.context
    return {
        "scene": scene.name,
        "status": results.status,
        "message": results.message,
        "time": context.time,
        "events": dict(s.events_by_name),
        "zeno_holds": [
            {"block": e.block, "time": e.time, "accumulation": _null(e.predicted)}
            for e in results.events
            if e.kind == "zeno_enter"
        ],
        "final": {name: _values(array) for name, array in results.outputs.items() if len(array)},
        "continuous_state": _values([context.continuous_state]),
        "discrete_state": _values([context.discrete_state]),
        "modes": list(context.modes),
        "rows": sum(len(island.time) for island in results.islands) or len(results.time),
        "cost": {
            "method": s.method,
            "steps": s.steps,
            "rejected": s.rejected,
            "restarts": s.restarts,
            "right_hand_side_calls": s.right_hand_side_calls,
            "guard_calls": s.guard_calls,
            "jacobian_calls": s.jacobian_calls,
            "wall_time": s.wall_time,
        },
    }


def _null(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None


def _values(rows: Any) -> Any:
    """The last row: a number, or a list of them, of a matrix a list of its rows."""
    last = np.asarray(rows[-1], dtype=float)
    return _null(float(last)) if last.ndim == 0 else [_values([part]) for part in last]


def _show(results: Results, scene: Chosen, chosen: argparse.Namespace) -> None:
    if chosen.quiet:
        return
    summary = _summary(results, scene)
    if chosen.json:
        print(json.dumps(summary, indent=1))
        return
    lines = [
        (scene.name, scene.title),
        ("status", f"{summary['status']}, t = {summary['time']:g} s"),
    ]
    events = ", ".join(f"{name} {n}" for name, n in summary["events"].items())
    lines.append(("events", events or "none"))
    for hold in summary["zeno_holds"]:
        lines.append(("Zeno hold", f"{hold['block']} from t = {hold['time']:.10g} s"))
    lines += [(name, _shown(value)) for name, value in summary["final"].items()]
    if not summary["final"]:
        lines.append(("state", _shown(summary["continuous_state"])))
    cost = summary["cost"]
    lines.append(
        ("cost", f"{cost['method']}: {cost['steps']} steps, {cost['right_hand_side_calls']} "
         f"right-hand sides, {cost['guard_calls']} guard calls, {1e3 * cost['wall_time']:.3g} ms")
    )  # fmt: skip
    print_table(lines)


def _shown(value: Any) -> str:
    if not isinstance(value, list):
        return "nan" if value is None else f"{value:.10g}"
    more = f", ... ({len(value)})" if len(value) > SHOWN else ""
    return "[" + ", ".join(map(_shown, value[:SHOWN])) + more + "]"


def _write(results: Results, chosen: argparse.Namespace) -> None:
    if chosen.csv:
        _write_csv(results, chosen.csv)
    if chosen.plot:
        import matplotlib

        matplotlib.use("Agg")  # draws into a file without a window
        np.ravel(results.plot())[0].figure.savefig(chosen.plot)


def _write_csv(results: Results, path: Path) -> None:
    """A column for each number: time, jump, 'y' of a scalar, 'y[0]', ... of a vector, 'y[0,0]', ...
    of a matrix.
    """
    titles, columns = ["time", "jump"], [results.time, results.jump]
    for name, array in results.outputs.items():
        for title, column in entries(name, array):
            titles.append(title)
            columns.append(column)
    with open(path, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(titles)
        writer.writerows(zip(*(column.tolist() for column in columns), strict=True))
