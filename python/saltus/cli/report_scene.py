"""saltus report: error against run time of a scene, for each method at each tolerance.

saltus report bouncing-ball
saltus report robertson --methods bdf,auto --rtols 1e-4,1e-6,1e-8 --plot robertson.svg
"""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import Any

import numpy as np

from saltus._status import WELL
from saltus.cli.files import require_picture, require_suffix
from saltus.cli.scene_of import Chosen, chosen_scene
from saltus.cli.settings import add_scene, add_span, settings_of
from saltus.errors import ModelError
from saltus.report import WorkPrecision, work_precision

__all__ = ["act", "add_arguments"]

NAME = "report"


def _numbers(text: str) -> list[float]:
    try:
        return [float(number) for number in text.split(",")]
    except ValueError:
        raise argparse.ArgumentTypeError(
            f"expected numbers 1e-4,1e-8,..., found '{text}'"
        ) from None


def _words(text: str) -> list[str]:
    return [word.strip() for word in text.split(",")]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_scene(parser)
    add_span(parser)
    parser.add_argument("--methods", type=_words, help="dopri5,bdf,...; those that suit the scene")
    parser.add_argument("--rtols", type=_numbers, help="1e-4,1e-8,...; 1e-4 to 1e-12 if not said")
    parser.add_argument(
        "--time-limit", type=float, default=5.0, metavar="T", help="[s] of one run; 5"
    )
    parser.add_argument("--least-time", type=float, default=0.1, metavar="T",
                        help="[s] runs are repeated for so long; 0.1")  # fmt: skip
    parser.add_argument("--plot", type=Path, metavar="FILE", help="a chart: .svg, .png, .pdf")
    parser.add_argument("--csv", type=Path, metavar="FILE", help="the rows")
    parser.add_argument("--json", type=Path, metavar="FILE", help="the rows and all about them")


def act(chosen: argparse.Namespace) -> int:
    _check(chosen)
    scene = chosen_scene(chosen.scene, settings_of(chosen.set))
    scene = scene.with_span(chosen.t_begin, chosen.t_end)
    how: dict[str, Any] = {"time_limit": chosen.time_limit, "least_time": chosen.least_time}
    if chosen.methods:
        how["methods"] = chosen.methods
    if chosen.rtols:
        how["rtols"] = chosen.rtols
    table = _table(scene, how)
    print(table)
    _write(table, chosen)
    return 0 if any(row["status"] in WELL for row in table) else 1


def _check(chosen: argparse.Namespace) -> None:
    """ModelError for values that cannot be meant, before anything is measured."""
    for rtol in chosen.rtols or ():
        if not 0.0 < rtol < math.inf:
            raise ModelError(f"--rtols: expected positive numbers, found {rtol:g}")
    if not 0.0 < chosen.time_limit:
        raise ModelError(f"--time-limit: expected a time above 0 s, found {chosen.time_limit:g}")
    if not 0.0 <= chosen.least_time < math.inf:
        raise ModelError(f"--least-time: expected a time from 0 s, found {chosen.least_time:g}")
    require_suffix("--csv", chosen.csv, ".csv", ".txt")
    require_suffix("--json", chosen.json, ".json", ".txt")
    require_picture("--plot", chosen.plot)


def _table(scene: Chosen, how: dict[str, Any]) -> WorkPrecision:
    """Measures against the known answer, if the answer is true of the scene with these settings."""
    if scene.scene is not None:
        return work_precision(scene.scene, **how)
    options = scene.options
    return work_precision(
        scene.system,
        scene.context,
        scene.required_span(),
        recorded_signals=options.recorded_signals or None,
        atol_over_rtol=float(np.min(options.atol) / np.min(options.rtol)),
        **how,
    )


def _write(table: WorkPrecision, chosen: argparse.Namespace) -> None:
    if chosen.csv:
        table.to_csv(chosen.csv)
    if chosen.json:
        table.to_json(chosen.json)
    if chosen.plot:
        table.plot(chosen.plot)
