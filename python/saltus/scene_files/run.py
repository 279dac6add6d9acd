"""The tables `run` and `sweep` of a scene: span, options, recorded signals, values to vary."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from saltus._signals import port_of
from saltus._span import ROUNDING
from saltus.options import SimulatorOptions, atol_beside
from saltus.ports import OutputPort
from saltus.scene_files.functions import number_of, value_of
from saltus.scene_files.names import text_at
from saltus.scene_files.scene_leaf import SceneLeaf
from saltus.scene_files.wrong import Path, Wrong, found, placed, require_keys, table_at
from saltus.system import System

__all__ = ["Run", "Sweep", "run_of", "sweep_of"]

NAMES = {"method": "ode_solver_method"}
NUMBERS = (
    "max_major_steps", "max_major_step_length", "min_minor_step_size", "max_minor_step_size",
    "first_step", "zeno_tolerance", "event_scan_points", "max_passes", "event_seed",
    "island_threads",
)  # fmt: skip
COUNTS = ("max_major_steps", "event_scan_points", "max_passes", "island_threads")
TRUTHS = (
    "find_sparsity", "save_steps", "event_rows", "dense_output", "record_events", "islands",
)  # fmt: skip
WORDS = ("method", "linear_solver", "machine_code")
KEYS = ("begin", "until", "rtol", "atol", "save_at", "record", *NUMBERS, *TRUTHS, *WORDS)
MOST_ROWS = 10_000_000


@dataclass(frozen=True)
class Run:
    """The settings of a run of the scene."""

    begin: float
    until: float | None
    options: SimulatorOptions


@dataclass(frozen=True)
class Sweep:
    """The values that a sweep of the scene varies."""

    values: dict[str, list[Any]]
    paired: bool


def run_of(table: Any, system: System, values: dict[str, Any]) -> Run:
    """The table `run`. Wrong for a mistake in it."""
    path: Path = ("run",)
    table = table_at(path, table, "{ until = 10.0 }")
    require_keys(path, table, KEYS)
    begin = number_of((*path, "begin"), table.get("begin", 0.0), values)
    until = number_of((*path, "until"), table["until"], values) if "until" in table else None
    if not math.isfinite(begin) or (until is not None and not begin <= until < math.inf):
        raise Wrong(
            (*path, "until"),
            f"expected finite times [s], begin <= until, found {begin} and {until}",
        )
    options: dict[str, Any] = {}
    for key in (*NUMBERS, *TRUTHS, *WORDS):
        if key in table:
            options[NAMES.get(key, key)] = _option((*path, key), key, table[key], values)
    for key in ("rtol", "atol"):
        if key in table:
            options[key] = _tolerance((*path, key), table[key], values)
    if "rtol" in options and "atol" not in options:
        options["atol"] = atol_beside(options["rtol"])
    if "save_at" in table:
        options["save_at"] = _times((*path, "save_at"), table["save_at"], begin, until, values)
        options.setdefault("save_steps", False)
    options["recorded_signals"] = _recorded((*path, "record"), table.get("record"), system)
    with placed(path):
        return Run(begin, until, SimulatorOptions(**options))


def _option(path: Path, key: str, value: Any, values: dict[str, Any]) -> Any:
    if key in WORDS:
        return text_at(path, value, "bdf")
    if key in TRUTHS:
        if not isinstance(value, bool):
            raise Wrong(path, f"expected true or false, found {found(value)}")
        return value
    if isinstance(value, bool):
        raise Wrong(path, f"expected a number, found {found(value)}")
    number = number_of(path, value, values)
    if key not in COUNTS:
        return number
    if not number.is_integer():
        raise Wrong(path, f"expected a whole number, found {number:g}")
    return int(number)


def _tolerance(path: Path, value: Any, values: dict[str, Any]) -> Any:
    """A number, or one for each state."""
    for each in value if isinstance(value, list) else [value]:
        if isinstance(each, (bool, list)):
            raise Wrong(
                path, f"expected a number, or a list with one for each state, found {found(value)}"
            )
    return value_of(path, value, values)


def _times(path: Path, value: Any, begin: float, until: float | None, values: Any) -> list[float]:
    """A list of times, or the number of even times from the begin to the end."""
    if isinstance(value, list):
        times = [number_of((*path, i), time, values) for i, time in enumerate(value)]
        end = math.inf if until is None else until
        near = ROUNDING * max(abs(begin), 0.0 if until is None else abs(until))
        for i, time in enumerate(times):
            if not begin - near <= time <= end + near:
                raise Wrong(
                    (*path, i), f"expected a time from {begin:g} s to {end:g} s, found {time:g}"
                )
        return times
    if type(value) is not int or not 2 <= value <= MOST_ROWS:
        raise Wrong(
            path, f"expected a list of times [s], or how many even ones, found {found(value)}"
        )
    if until is None or not math.isfinite(until):
        raise Wrong(path, "a number of even times needs a finite 'until'")
    return [float(time) for time in np.linspace(begin, until, value)]


def _recorded(path: Path, value: Any, system: System) -> dict[str, OutputPort]:
    """The recorded signals by name; without the key all outputs that the file names."""
    if value is None:
        shown = system.shown if isinstance(system, SceneLeaf) else system.output_names
        return {name: system.output(name) for name in shown}
    if isinstance(value, list):
        signals = {text_at((*path, i), port, "plant.y"): (*path, i) for i, port in enumerate(value)}
        named = [(name, name, at) for name, at in signals.items()]
    else:
        table = table_at(path, value, "{ y = 'plant.y' }")
        named = [(name, text_at((*path, name), port, "plant.y"), (*path, name))
                 for name, port in table.items()]  # fmt: skip
    return {name: _port(at, system, port) for name, port, at in named}


def _port(path: Path, system: System, port: str) -> OutputPort:
    with placed(path):
        return port_of(system, port)


def sweep_of(table: Any, values: dict[str, Any]) -> Sweep:
    """The table `sweep`. Wrong for a mistake in it."""
    path: Path = ("sweep",)
    table = table_at(path, table, "{ values = { e = [0.5, 0.9] } }")
    require_keys(path, table, ("values", "paired"), ("values",))
    columns = table_at((*path, "values"), table["values"], "{ e = [0.5, 0.9] }")
    paired = table.get("paired", False)
    if not isinstance(paired, bool):
        raise Wrong((*path, "paired"), f"expected true or false, found {found(paired)}")
    return Sweep({n: _column((*path, "values", n), c, values) for n, c in columns.items()}, paired)


def _column(path: Path, value: Any, values: dict[str, Any]) -> list[Any]:
    if isinstance(value, list) and value:
        return [value_of((*path, i), each, values) for i, each in enumerate(value)]
    if not isinstance(value, dict):
        raise Wrong(
            path,
            "expected a list of values, or { from = 0, to = 1, count = 11 }, found "
            f"{found(value)}",
        )
    require_keys(path, value, ("from", "to", "count"), ("from", "to", "count"))
    ends = [number_of((*path, key), value[key], values) for key in ("from", "to")]
    count = value["count"]
    if type(count) is not int or not 1 <= count <= MOST_ROWS or not all(map(math.isfinite, ends)):
        raise Wrong(path, "expected finite ends and a whole number 'count' above 0")
    return [float(number) for number in np.linspace(ends[0], ends[1], count)]
