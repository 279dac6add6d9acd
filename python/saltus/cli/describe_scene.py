"""saltus describe: the parts of a scene, the values that a run computes, and its known answer.

saltus describe water-tanks
saltus describe ball.py:make_ball --set e=0.5 --method bdf
"""

from __future__ import annotations

import argparse
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from saltus import _core
from saltus._porting import OPTIONS, refuse
from saltus.cli.scene_of import Chosen, chosen_scene
from saltus.cli.settings import add_options, add_scene, options_of, settings_of
from saltus.cli.table import print_table
from saltus.simulation import Simulator, SimulatorOptions

__all__ = ["act", "add_arguments"]

NAME = "describe"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_scene(parser)
    add_options(parser)


def act(chosen: argparse.Namespace) -> int:
    scene = chosen_scene(chosen.scene, settings_of(chosen.set))
    scene = scene.with_span(chosen.t_begin, chosen.t_end)
    overrides = options_of(chosen, scene.writes_atol)
    refuse("--option", overrides, SimulatorOptions.__dataclass_fields__, OPTIONS)
    options = replace(scene.options, **overrides)
    plan = Simulator(scene.system, options).describe()  # refuses wrong options before a line is out
    print_table(_facts(scene, options))
    print()
    print(plan, end="")
    return 0


def _facts(chosen: Chosen, options: SimulatorOptions) -> list[tuple[str, str]]:
    facts = [("scene", f"{chosen.name}: {chosen.title}".rstrip(": "))]
    if chosen.span is not None:
        facts.append(("span", f"t = {chosen.span[0]:g} to {chosen.span[1]:g} s"))
    if chosen.parameters:
        facts.append(("parameters", _listed(chosen.parameters)))
    names = [n for n in _core.entry_names(chosen.context) if n.rpartition(".")[2] != "mode"]
    facts.append(("values", ", ".join(names) or "none"))
    facts.append(("tolerances", f"rtol {_shown(options.rtol)}, atol {_shown(options.atol)}"))
    facts.append(("recorded", ", ".join(options.recorded_signals or {}) or "nothing"))
    if chosen.scene is not None:
        facts.append(("methods", ", ".join(chosen.scene.methods)))
        facts.append(("known answer", chosen.scene.provenance or "none"))
        if chosen.scene.invariants:
            facts.append(("invariants", ", ".join(chosen.scene.invariants)))
    return facts


def _shown(tolerance: ArrayLike) -> str:
    """A number, or one for each state."""
    return ", ".join(f"{number:g}" for number in np.atleast_1d(np.asarray(tolerance, dtype=float)))


def _listed(values: dict[str, Any]) -> str:
    shown = {n: v if isinstance(v, list) else f"{v:g}" for n, v in values.items()}
    return ", ".join(f"{name} = {value}" for name, value in shown.items())
