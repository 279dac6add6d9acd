"""The runs of `saltus sweep`. Each is the run that `saltus run` makes with the same settings."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from saltus import __version__
from saltus._entries import entries, entry_names
from saltus._signals import port_of
from saltus._span import rows_within
from saltus._status import WELL
from saltus.cli.one_system import OneSystem
from saltus.cli.scene_of import Chosen, chosen_scene
from saltus.ensemble.columns import STATUS, Columns, empty, failed
from saltus.ensemble.dataset import refuse_reserved
from saltus.ensemble.runs import Outcome, Watch, each, said
from saltus.ensemble.table import Column, Table
from saltus.results import Results
from saltus.simulation import Simulator, simulate

if TYPE_CHECKING:
    from saltus.scene_files import FileScene

__all__ = ["SceneRuns"]


@dataclass(frozen=True)
class SceneRuns:
    """A scene that is made for each row of values, so that a row may vary anything that `--set` may
    set: parameters, arguments of a function, values of the context. Rows of a scene file that
    differ in values of the context alone share one system.
    """

    scene: str
    file: FileScene | None
    """the scene file, which is read once"""
    settings: dict[str, Any]
    span: tuple[float | None, float | None]
    record: tuple[str, ...]
    options: dict[str, Any]
    one: OneSystem = field(default_factory=OneSystem, repr=False, compare=False)
    """the system of rows that differ in values of a context alone"""

    @property
    def is_factory(self) -> bool:
        return True

    @property
    def needs_interpreter(self) -> bool:
        return True

    def chosen(self, row: Mapping[str, Any]) -> Chosen:
        """The scene with the values of one row. ModelError for unknown names."""
        scene = None
        if self.file is not None:
            scene = self.one.of(self.scene, self.file, self.settings, row)
        scene = scene or chosen_scene(self.scene, self.settings | dict(row), self.file)
        return scene.with_span(*self.span)

    def check(self, row: Mapping[str, Any]) -> None:
        """Raises ModelError for unknown names, signals and options, and for a column that would be
        written over another one, before anything is run.
        """
        scene = self.chosen(row)
        overrides = self._overrides(scene)
        recorded = overrides.get("recorded_signals", scene.options.recorded_signals) or {}
        entered = {name.partition("[")[0] for name in row if "[" in name} & recorded.keys()
        shapes = {name: np.shape(recorded[name].eval(scene.context)) for name in entered}
        titles = [title for name, shape in shapes.items() for title in entry_names(name, shape)]
        refuse_reserved(row, [*recorded, *titles])
        Simulator(scene.system, scene.options, **overrides)
        save_at = overrides.get("save_at", scene.options.save_at)
        rows_within("sweep", save_at, scene.required_span())

    def run(
        self, values: Mapping[str, Column], threads: int = 1, watch: Watch | None = None
    ) -> Outcome:
        """The columns of the rows; their signals, as one dict a row, are the `reduced` values."""
        return each(values, watch, self._run_one)

    def _run_one(self, row: Mapping[str, Any]) -> Outcome:
        try:
            results = self._results(row)
        except KeyboardInterrupt as error:
            return failed(1, "interrupted"), error
        except Exception as error:  # a function of the scene raised it, or it refused a value
            return failed(1, said(error)), None
        stopped = KeyboardInterrupt() if results.status == "interrupted" else None
        return _columns(results), stopped

    def _results(self, row: Mapping[str, Any]) -> Results:
        scene = self.chosen(row)
        overrides = self._overrides(scene) | {"throw": False}
        return simulate(
            scene.system, scene.context, scene.required_span(), scene.options, **overrides
        )

    def _overrides(self, scene: Chosen) -> dict[str, Any]:
        if not self.record:
            return self.options
        ports = {name: port_of(scene.system, name) for name in self.record}
        return self.options | {"recorded_signals": ports}

    def fingerprint(self, table: Table) -> dict[str, str]:
        """A digest of each thing on which the rows depend, by name."""
        from saltus.ensemble.fingerprint import digest

        return {
            "scene": digest(
                (self.scene, _source(self.scene) if self.file is None else self.file.tree)
            ),
            "values": digest((self.settings, table.columns)),
            "t_span": digest(self.span),
            "options": digest((self.options, self.record)),
            "saltus": __version__,
        }


def _source(scene: str) -> bytes:
    """The file of a scene of the user's own; nothing for one of the shelf."""
    place = scene if Path(scene).is_file() else scene.rpartition(":")[0]
    if not Path(place).is_file():
        place = getattr(sys.modules.get(place), "__file__", None) or ""
    return Path(place).read_bytes() if place else b""


def _columns(results: Results) -> Columns:
    columns = empty(1)
    columns["status"][:] = list(STATUS).index(results.status)
    columns["end_time"][:] = results.context.time
    columns["wall_time"][:] = results.statistics.wall_time
    columns["events"][:] = sum(results.statistics.events_by_name.values())
    columns["steps"][:] = results.statistics.steps
    columns["continuous_state"] = np.asarray([results.context.continuous_state])
    columns["discrete_state"] = np.asarray([results.context.discrete_state])
    if results.status not in WELL:
        columns["reasons"] = {0: (results.message or "no reason is known", "")}
    columns["reduced"] = {0: _signals(results)}
    return columns


def _signals(results: Results) -> dict[str, float]:
    """The last value of each recorded signal, entry by entry."""
    found: dict[str, float] = {}
    for name, array in results.outputs.items():
        last = array[-1] if len(array) else np.nan
        found |= {key: float(value) for key, value in entries(name, last, before=0)}
    return found
