"""saltus sweep: a run for each value of a parameter or of an initial state; a row for each run.

saltus sweep bouncing-ball --vary e=0.5,0.7,0.9
saltus sweep ball.toml --vary 'e=0.1:0.9:9' --vary y0=1,10 --csv ball.csv
"""

from __future__ import annotations

import argparse
import csv
import itertools
import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from saltus._signals import port_of
from saltus.cli.files import require_suffix
from saltus.cli.scene_of import Chosen, chosen_scene
from saltus.cli.settings import add_options, add_scene, options_of, settings_of
from saltus.cli.table import print_table
from saltus.errors import ModelError
from saltus.simulation import simulate

__all__ = ["act", "add_arguments"]

NAME = "sweep"
WELL = ("reached_end", "terminal", "zeno_stop")
MOST_RUNS = 1_000_000


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


def act(chosen: argparse.Namespace) -> int:
    require_suffix("--csv", chosen.csv, ".csv", ".txt")
    settings = settings_of(chosen.set)
    first = chosen_scene(chosen.scene, settings)
    varied = _varied(chosen.vary) or first.varied
    if not varied:
        raise ModelError("expected values to vary: --vary NAME=V,V,...")
    paired = chosen.paired or (not chosen.vary and first.paired)
    rows = [_row(chosen, first, settings | values, values) for values in _points(varied, paired)]
    _show(rows, chosen)
    return 0 if any(row["status"] in WELL for row in rows) else 1


def _varied(texts: list[str]) -> dict[str, list[Any]]:
    found: dict[str, list[Any]] = {}
    for text in texts:
        name, equals, values = text.partition("=")
        if not equals or not name.strip() or name.strip() in found:
            raise ModelError(f"--vary: expected NAME=V,V,... once for each name, found '{text}'")
        found[name.strip()] = _values(text, values)
    return found


def _values(text: str, values: str) -> list[Any]:
    try:
        if values.count(":") != 2:
            return [float(value) for value in values.split(",")]
        begin, end, count = values.split(":")
        if 1 <= int(count) <= MOST_RUNS:
            return [float(value) for value in np.linspace(float(begin), float(end), int(count))]
    except ValueError:
        pass
    raise ModelError(
        f"--vary: expected numbers V,V,... or BEGIN:END:COUNT, found '{text}'"
    ) from None


def _points(varied: dict[str, list[Any]], paired: bool) -> Iterator[dict[str, Any]]:
    """The values of each run."""
    lengths = [len(values) for values in varied.values()]
    if paired and len(set(lengths)) > 1:
        raise ModelError(f"paired values: expected equally many of each name, found {lengths}")
    if not paired and math.prod(lengths) > MOST_RUNS:
        raise ModelError(f"expected at most {MOST_RUNS} runs, found {math.prod(lengths)}")
    rows = zip(*varied.values(), strict=True) if paired else itertools.product(*varied.values())
    return (dict(zip(varied, row, strict=True)) for row in rows)


def _row(
    chosen: argparse.Namespace, first: Chosen, settings: dict[str, Any], values: dict[str, Any]
) -> dict[str, Any]:
    """One run with these settings, which include the values that vary. `saltus run` with the same
    settings gives the same result.
    """
    scene = first.again(chosen.scene, settings)
    scene = scene.with_span(chosen.t_begin, chosen.t_end)
    overrides = _recording(chosen, scene) | options_of(chosen)
    results = simulate(
        scene.system, scene.context, scene.required_span(), scene.options, throw=False, **overrides
    )
    row = values | {"status": results.status, "time": results.context.time,
                    "events": sum(results.statistics.events_by_name.values())}  # fmt: skip
    for name, array in results.outputs.items():
        last = np.asarray(array[-1]) if len(array) else np.asarray(math.nan)
        entries = (
            {f"{name}[{i}]": v for i, v in enumerate(last.ravel())} if last.ndim else {name: last}
        )
        row |= {key: float(value) for key, value in entries.items()}
    return row


def _recording(chosen: argparse.Namespace, scene: Chosen) -> dict[str, Any]:
    if not chosen.record:
        return {}
    return {"recorded_signals": {name: port_of(scene.system, name) for name in chosen.record}}


def _show(rows: list[dict[str, Any]], chosen: argparse.Namespace) -> None:
    titles = list(dict.fromkeys(title for row in rows for title in row))
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
