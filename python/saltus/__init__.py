"""Hybrid ODEs: continuous flow, guards, reset maps, modes and Zeno holds.

A model is a `LeafSystem` of your own or a `Diagram` of blocks from `saltus.library`; `simulate`
runs it.
"""

from typing import TYPE_CHECKING

from saltus import library, simulation
from saltus._core import Context, State, __version__
from saltus.callbacks import ExplainedCallback, Explanation
from saltus.compiled import Compiled, compiled
from saltus.diagram import Diagram, DiagramBuilder
from saltus.ensemble import sweep
from saltus.errors import Error, ModelError, SimulationError
from saltus.leaf_system import LeafSystem
from saltus.progress import Progress
from saltus.report import WorkPrecision, work_precision
from saltus.response import response
from saltus.results import Event, EventLog, Results, Statistics, Values, load_results
from saltus.results import load_results as load
from saltus.scenes import Scene, load_scene, scene, shelf
from saltus.simulation import Simulator, SimulatorOptions, simulate
from saltus.solving.guard import Guard
from saltus.solving.solution import Solution
from saltus.solving.solve import solve
from saltus.solving.system_of import system_of
from saltus.system import InputPort, OutputPort, System

if TYPE_CHECKING:
    from saltus.fitting import EventTimes, Experiment, FitProgress, FitResult, Free
    from saltus.fitting.fit import fit as fit

__all__ = [
    "Compiled",
    "Context",
    "Diagram",
    "DiagramBuilder",
    "Error",
    "Event",
    "EventLog",
    "EventTimes",
    "Experiment",
    "ExplainedCallback",
    "Explanation",
    "FitProgress",
    "FitResult",
    "Free",
    "Guard",
    "InputPort",
    "LeafSystem",
    "ModelError",
    "OutputPort",
    "Progress",
    "Results",
    "Scene",
    "SimulationError",
    "Simulator",
    "SimulatorOptions",
    "Solution",
    "State",
    "Statistics",
    "System",
    "Values",
    "WorkPrecision",
    "__version__",
    "compiled",
    "fit",
    "library",
    "load",
    "load_results",
    "load_scene",
    "response",
    "scene",
    "shelf",
    "simulate",
    "simulation",
    "solve",
    "sweep",
    "system_of",
    "work_precision",
]

_FITTING = frozenset({"EventTimes", "Experiment", "FitProgress", "FitResult", "Free", "fit"})


def __getattr__(name: str) -> object:
    """Loads `saltus.fitting` when one of its names is first used."""
    if name not in _FITTING:
        raise AttributeError(f"module 'saltus' has no attribute {name!r}")
    from saltus import fitting

    found: object = getattr(fitting, name)
    globals()[name] = found
    return found
