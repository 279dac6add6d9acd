"""Hybrid ODEs: continuous flow, guards, reset maps, modes and Zeno holds.

A model is a `LeafSystem` of your own or a `Diagram` of blocks from `saltus.library`; `simulate`
runs it.
"""

from saltus import library, simulation
from saltus._core import Context, State, __version__
from saltus.compiled import Compiled, compiled
from saltus.diagram import Diagram, DiagramBuilder
from saltus.errors import Error, ModelError, SimulationError
from saltus.ladder import Explanation, Rung
from saltus.leaf_system import LeafSystem
from saltus.report import WorkPrecision, work_precision
from saltus.results import Event, EventLog, Results, Statistics
from saltus.scenes import Scene, scene, shelf
from saltus.simulation import Simulator, SimulatorOptions, simulate
from saltus.system import InputPort, OutputPort, System

__all__ = [
    "Compiled",
    "Context",
    "Diagram",
    "DiagramBuilder",
    "Error",
    "Event",
    "EventLog",
    "Explanation",
    "InputPort",
    "LeafSystem",
    "ModelError",
    "OutputPort",
    "Results",
    "Rung",
    "Scene",
    "SimulationError",
    "Simulator",
    "SimulatorOptions",
    "State",
    "Statistics",
    "System",
    "WorkPrecision",
    "__version__",
    "compiled",
    "library",
    "scene",
    "shelf",
    "simulate",
    "simulation",
    "work_precision",
]
