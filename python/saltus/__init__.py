"""Hybrid ODEs: continuous flow, guards, reset maps, modes and Zeno holds.

A model is a `LeafSystem` of your own or a `Diagram` of blocks from `saltus.library`; `simulate`
runs it.
"""

from typing import TYPE_CHECKING, Any

from saltus import _starting  # isort: skip  # before the imports that Ctrl-C may interrupt
from saltus import library, simulation
from saltus._core import Context, State, __version__
from saltus._core import known_names as _known_names
from saltus.callbacks import ExplainedCallback, Explanation
from saltus.compiled import Compiled, compiled
from saltus.diagram import Diagram, DiagramBuilder
from saltus.errors import Error, ModelError, SimulationError
from saltus.leaf_system import LeafSystem
from saltus.parameter import Parameter
from saltus.progress import Progress
from saltus.response import response
from saltus.results import Event, EventLog, Results, Statistics, Values, load_results
from saltus.results import load_results as load
from saltus.scenes import Scene, load_scene, scene, shelf
from saltus.simulation import Simulator, SimulatorOptions, simulate
from saltus.solving.guard import Guard
from saltus.solving.solution import Solution
from saltus.solving.solve import solve
from saltus.solving.system_of import system_of
from saltus.ports import EventInputPort, EventOutputPort
from saltus.system import InputPort, OutputPort, System

if TYPE_CHECKING:
    from saltus import drawings as drawings
    from saltus import sbml as sbml
    from saltus import scene_files as scene_files
    from saltus.derivative_checks import WrongDerivative, check_derivatives
    from saltus.differentiable import RunValues
    from saltus.differentiable.jax_function import jax_function as jax_function
    from saltus.differentiable.torch_function import torch_function as torch_function
    from saltus.ensemble import sweep as sweep
    from saltus.ensemble.heat_map import plot_sweep as plot_sweep
    from saltus.exponents import LyapunovSpectrum
    from saltus.exponents.lyapunov import lyapunov as lyapunov
    from saltus.fitting import EventTimes, Experiment, FitProgress, FitResult, Free
    from saltus.fitting.fit import fit as fit
    from saltus.linearization import Linearization, linearize
    from saltus.operating import Equilibria, OperatingPoint
    from saltus.operating.equilibria import equilibria as equilibria
    from saltus.operating.trim import trim as trim
    from saltus.orbits import PeriodicOrbit, PeriodMap, periodic_orbit
    from saltus.orbits.period_map import period_map as period_map
    from saltus.report import WorkPrecision, work_precision
    from saltus.viewing.view import view as view

__all__ = [
    "Compiled",
    "Context",
    "Diagram",
    "DiagramBuilder",
    "Equilibria",
    "Error",
    "Event",
    "EventInputPort",
    "EventLog",
    "EventOutputPort",
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
    "Linearization",
    "LyapunovSpectrum",
    "ModelError",
    "OperatingPoint",
    "OutputPort",
    "Parameter",
    "PeriodMap",
    "PeriodicOrbit",
    "Progress",
    "Results",
    "RunValues",
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
    "WrongDerivative",
    "__version__",
    "check_derivatives",
    "compiled",
    "drawings",
    "equilibria",
    "fit",
    "jax_function",
    "library",
    "linearize",
    "load",
    "load_results",
    "load_scene",
    "lyapunov",
    "period_map",
    "periodic_orbit",
    "plot_sweep",
    "response",
    "sbml",
    "scene",
    "scene_files",
    "shelf",
    "simulate",
    "simulation",
    "solve",
    "sweep",
    "system_of",
    "torch_function",
    "trim",
    "view",
    "work_precision",
]

_LATER = {
    **dict.fromkeys(("RunValues", "jax_function", "torch_function"), "differentiable"),
    **dict.fromkeys(("LyapunovSpectrum", "lyapunov"), "exponents"),
    **dict.fromkeys(
        ("EventTimes", "Experiment", "FitProgress", "FitResult", "Free", "fit"), "fitting"
    ),
    **dict.fromkeys(("Equilibria", "OperatingPoint", "equilibria", "trim"), "operating"),
    **dict.fromkeys(("PeriodMap", "PeriodicOrbit", "period_map", "periodic_orbit"), "orbits"),
    **dict.fromkeys(("WrongDerivative", "check_derivatives"), "derivative_checks"),
    **dict.fromkeys(("Linearization", "linearize"), "linearization"),
    **dict.fromkeys(("WorkPrecision", "work_precision"), "report"),
    "drawings": "drawings",
    "plot_sweep": "ensemble.heat_map",
    "sbml": "sbml",
    "scene_files": "scene_files",
    "sweep": "ensemble",
    "view": "viewing",
}
"""names that most scripts leave alone -> their package, loaded when they are used; its own name is
the package itself
"""


def __getattr__(name: str) -> Any:
    if name not in _LATER:
        raise _missing(name)
    from importlib import import_module

    if name == _LATER[name]:
        return import_module(f"saltus.{name}")
    found = getattr(import_module(f"saltus.{_LATER[name]}"), name)
    globals()[name] = found
    return found


def _missing(name: str) -> AttributeError:
    said = f"module 'saltus' has no attribute {name!r}"
    if not name.startswith("_"):
        if name in library.__all__:
            said += f"; it is saltus.library.{name}"
        else:
            said += _known_names(name, __all__)
    return AttributeError(said)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


_starting.end()
