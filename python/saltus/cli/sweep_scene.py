"""saltus sweep: a run for each value of a parameter or of an initial state; a row for each run.

saltus sweep bouncing-ball --vary e=0.5,0.7,0.9
saltus sweep ball.toml --vary 'e=0.1:0.9:9' --vary y0=1,10 --csv ball.csv
saltus sweep ball.toml --vary 'e=0.1:0.9:10000' --workers 4 --store balls --progress
"""

from __future__ import annotations

import argparse
import csv
import json
import math
from pathlib import Path
from typing import Any

from saltus._status import WELL
from saltus.cli.files import require_suffix
from saltus.cli.scene_of import chosen_scene
from saltus.cli.settings import add_options, add_scene, options_of, recorded_of, settings_of
from saltus.cli.sweep_runs import SceneRuns
from saltus.cli.sweep_values import table_of_runs, varied_of
from saltus.cli.table import print_table
from saltus.ensemble.columns import STATUS, Columns
from saltus.ensemble.executors import run, store_of
from saltus.ensemble.progress import Progress
from saltus.ensemble.runs import Outcome
from saltus.ensemble.table import Table, entry
from saltus.errors import ModelError

__all__ = ["act", "add_arguments"]

NAME = "sweep"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_scene(parser)
    parser.add_argument(
        "--vary",
        action="append",
        default=[],
        metavar="NAME=V,V,...",
        help="the values of one name, or NAME=BEGIN:END:COUNT for even ones; as often as wanted. "
        "Those of the scene file if not said",
    )
    parser.add_argument("--paired", action="store_true", help="the values belong together by row")
    add_options(parser)
    parser.add_argument("--record", action="append", metavar="PORT", help="an output to record")
    parser.add_argument("--csv", type=Path, metavar="FILE", help="the rows")
    parser.add_argument("--json", action="store_true", help="the rows as a list of JSON")
    parser.add_argument("--workers", type=int, metavar="N", help="run in N processes")
    parser.add_argument("--progress", action="store_true", help="show how many runs are done")
    parser.add_argument(
        "--store",
        metavar="DIRECTORY",
        help="keep finished chunks of runs there: the same command after a kill runs the rest only",
    )
    parser.add_argument("--chunk", type=int, metavar="N", help="runs of a chunk of the store")
    parser.add_argument(
        "--retries",
        type=int,
        default=0,
        metavar="N",
        help="how often a chunk is tried again whose process ended; with --store",
    )


def act(chosen: argparse.Namespace) -> int:
    require_suffix("--csv", chosen.csv, ".csv", ".txt")
    settings = settings_of(chosen.set)
    varied = varied_of(chosen.vary)
    begin = {name: values[0] for name, values in varied.items()}
    first = chosen_scene(chosen.scene, settings | begin)
    twice = settings.keys() & (varied or first.varied).keys()
    if twice:
        what = "--vary" if varied else "the table 'sweep' of the scene"
        raise ModelError(
            f"--set: '{min(twice)}' is varied by {what}, so a single value of it is never used; "
            "leave it out, or say with --vary what to vary"
        )
    table = table_of_runs(varied or first.varied, chosen.paired or (not varied and first.paired))
    span, record = (chosen.t_begin, chosen.t_end), recorded_of(chosen.record)
    options = options_of(chosen, first.writes_atol)
    runs = SceneRuns(chosen.scene, first.file, settings, span, record, options)
    runs.check({name: entry(column, 0) for name, column in table.columns.items()})
    columns, raised = _made(runs, table, chosen)
    _show(_rows(columns, table), chosen)
    if raised is not None:
        raise raised
    return 0 if any(status in WELL for status in STATUS[columns["status"]]) else 1


def _made(runs: SceneRuns, table: Table, chosen: argparse.Namespace) -> Outcome:
    if chosen.store is None and (chosen.retries or chosen.chunk):
        raise ModelError("--chunk and --retries are of a store: say --store DIRECTORY too")
    store = store_of(chosen.store, chosen.chunk, chosen.retries, runs, table)
    with Progress(table.runs, chosen.progress) as shown:
        columns, raised, _, _ = run(
            runs, table, None, chosen.workers, shown.watch, store, chosen.retries
        )
    return columns, raised


def _rows(columns: Columns, table: Table) -> list[dict[str, Any]]:
    """The values, the end and the signals of each run; of one that did not end well, the reason."""
    rows = []
    for i in range(table.runs):
        row = {name: entry(column, i) for name, column in table.columns.items()}
        row |= {"status": str(STATUS[columns["status"][i]])}
        row |= {"time": float(columns["end_time"][i]), "events": int(columns["events"][i])}
        row |= columns["reduced"].get(i, {})
        if i in columns["reasons"]:
            row["message"] = columns["reasons"][i][0]
        rows.append(row)
    return rows


def _show(rows: list[dict[str, Any]], chosen: argparse.Namespace) -> None:
    titles = list(dict.fromkeys(title for row in rows for title in row))
    titles.sort(key=lambda title: title == "message")  # the last column
    if chosen.csv:
        with open(chosen.csv, "w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(titles)
            writer.writerows([row.get(title, "") for title in titles] for row in rows)
    if chosen.json:
        finite = [{k: _null(v) for k, v in row.items()} for row in rows]
        print(json.dumps(finite, indent=1))
        return
    print_table([tuple(titles), *(tuple(_shown(row.get(t)) for t in titles) for row in rows)])


def _null(value: Any) -> Any:
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _shown(value: Any) -> str:
    if value is None:
        return ""
    return f"{value:.10g}" if isinstance(value, float) else str(value)
