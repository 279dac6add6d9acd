"""The argument SCENE: a system with its values, span and options."""

from __future__ import annotations

import importlib
import importlib.util
import inspect
import math
import sys
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

from saltus import _core
from saltus.errors import ModelError
from saltus.scenes import Scene, load_scene, scene, shelf
from saltus.simulation import SimulatorOptions
from saltus.system import System

if TYPE_CHECKING:
    from saltus.scene_files import FileScene

__all__ = ["Chosen", "chosen_scene", "with_values"]


OTHER_TEXTS = {".txt", ".yaml", ".yml", ".tml", ".ini", ".cfg", ".mo", ".slx"}


@dataclass(frozen=True)
class Chosen:
    """Everything that a run needs."""

    name: str
    title: str
    system: System
    context: _core.Context
    span: tuple[float, float] | None
    """[s] None if the command line does not give it"""
    options: SimulatorOptions
    scene: Scene | None
    """the scene of the shelf, if its known answer is true of these settings"""
    parameters: dict[str, Any] = field(default_factory=dict)
    """the parameters of the scene as a whole, with their values"""
    varied: dict[str, list[Any]] = field(default_factory=dict)
    """the values of the sweep that the scene defines, by name"""
    paired: bool = False
    """whether these values belong together, row by row"""
    file: FileScene | None = None
    """the scene file that was read"""
    made: FileScene | None = None
    """the scene of the file, with the settings"""

    @property
    def writes_atol(self) -> bool:
        """Whether the scene file says the absolute tolerance, which `--rtol` leaves as it is."""
        return self.file is not None and self.file.writes_atol

    def with_span(self, begin: float | None, end: float | None) -> Chosen:
        """The scene with the span from the command line in place of the usual one."""
        if begin is None and end is None:
            return self
        for flag, time in (("--t-begin", begin), ("--t-end", end)):
            if time is not None and not math.isfinite(time):
                raise ModelError(f"{flag}: expected a finite time in seconds, found {time:g}")
        usual = self.span or (0.0, None)
        begin, end = usual[0] if begin is None else begin, usual[1] if end is None else end
        if end is None:
            return replace(self, span=None, scene=None)
        # the rows that the scene asks for, as far as this run goes
        rows = [time for time in self.options.save_at if begin <= time <= end]
        options = replace(self.options, save_at=rows) if len(self.options.save_at) else self.options
        return replace(self, span=(begin, end), scene=None, options=options)

    def required_span(self) -> tuple[float, float]:
        """The span; ModelError if neither the scene nor the command line has one."""
        if self.span is None:
            raise ModelError(f"'{self.name}' says no end of the run; say --t-end T, in seconds")
        return self.span


def chosen_scene(name: str, settings: dict[str, Any], file: FileScene | None = None) -> Chosen:
    """The scene with this name and these settings; of a `file` that was read, if it is given.
    ModelError for unknown names.
    """
    if file is not None:
        return _of_file(file, settings)
    if name.lower().endswith((".toml", ".json")):
        return _of_file(load_scene(name), settings)
    if name.lower().endswith((".xml", ".sbml")):
        return _sbml(name, settings)
    if ":" in name:
        return _own(name, settings)
    names = list(shelf())
    if name.endswith(".py"):
        raise ModelError(f"which scene of '{name}'? Say {name}:NAME, of a system in that file")
    if name not in names:
        if Path(name).exists() or Path(name).suffix.lower() in OTHER_TEXTS:
            raise ModelError(
                f"'{name}': a scene file ends in .toml or .json; one of Python is file.py:name"
            )
        hint = _core.known_names(name, names)
        raise ModelError(
            f"no scene '{name}' on the shelf{hint}. One of your own is file.py:name or module:name"
        )
    return _of_shelf(name, settings)


def _split(settings: dict[str, Any], known: set[str]) -> tuple[dict[str, Any], dict[str, Any]]:
    """The settings of the scene's own parameters, and those of the context."""
    own = {name: value for name, value in settings.items() if name in known}
    return own, {name: value for name, value in settings.items() if name not in known}


def _of_shelf(name: str, settings: dict[str, Any]) -> Chosen:
    usual = scene(name)
    known = set(usual.parameters)
    own, rest = _split(settings, known)
    made = scene(name, **own) if known else usual
    context = with_values(made.context, rest, known)
    same = made if not rest else None
    return Chosen(
        name,
        made.title,
        made.system,
        context,
        made.t_span,
        made.options,
        same,
        dict(made.parameters) if same else {},
    )


def _of_file(file: FileScene, settings: dict[str, Any]) -> Chosen:
    known = set(file.parameters)
    own, rest = _split(settings, known)
    scene = file.with_parameters(**own) if own else file
    values = {}
    for name, value in rest.items():
        entry = scene.entry_named(name)
        if entry in values:
            raise ModelError(f"'{entry}' and '{name}' are the same value; leave one of them out")
        values[entry] = value
    context = with_values(scene.context, values, known)
    return Chosen(
        scene.name,
        scene.title,
        scene.system,
        context,
        scene.t_span,
        scene.options,
        None,
        scene.parameters,
        scene.swept.values,
        scene.swept.paired,
        file,
        scene,
    )


def _sbml(name: str, settings: dict[str, Any]) -> Chosen:
    """A model in SBML, which has no span. Settings are values at the start, by id."""
    from saltus.sbml import load

    model = load(name, values=settings)
    options = SimulatorOptions(recorded_signals={port.name: port for port in model.output_ports})
    title = f"a model in SBML, {name}"
    return Chosen(model.name, title, model, model.create_context(), None, options, None)


def _own(name: str, settings: dict[str, Any]) -> Chosen:
    place, _, attribute = name.rpartition(":")
    found = _attribute(_module(place), attribute, place)
    arguments: set[str] = set()
    if not isinstance(found, (System, Scene)) and callable(found):
        arguments = _arguments_of(found, settings, name)
        found = _made(found, _split(settings, arguments)[0], name)
    if isinstance(found, Scene):
        context, span, options = found.context, found.t_span, found.options
        system: System = found.system
    elif isinstance(found, System):
        system, span, options = found, None, SimulatorOptions()
        context = system.create_context()
    else:
        raise ModelError(
            f"'{name}': expected a system, or a function that makes one, found {found!r}"
        )
    rest = _split(settings, arguments)[1]
    if not options.recorded_signals:
        ports = {port.name: port for port in system.output_ports}
        options = replace(options, recorded_signals=ports)
    context = with_values(context, rest, arguments)
    return Chosen(name, system.name, system, context, span, options, None)


def _module(place: str) -> Any:
    """A module by name, found from the present directory, or a file. It may print."""
    try:
        if not place.endswith(".py"):
            sys.path.insert(0, "")
            return importlib.import_module(place)
        path = Path(place)
        if not path.is_file():
            raise ModelError(f"there is no file '{place}'")
        sys.path.insert(0, str(path.resolve().parent))
        spec = importlib.util.spec_from_file_location(path.stem, path)
        assert spec is not None and spec.loader is not None  # of a .py file
        module = importlib.util.module_from_spec(spec)
        sys.modules[path.stem] = module
        spec.loader.exec_module(module)
        return module
    except ModelError:
        raise
    except Exception as error:  # any exception of the module
        raise ModelError(f"'{place}' cannot be imported: {_where(error, place)}") from error


def _where(error: BaseException, place: str) -> str:
    """The exception, and the line of the user's file that raised it."""
    said = f"{type(error).__name__}: {error}"
    trace, line = error.__traceback__, None
    while trace is not None:
        if trace.tb_frame.f_code.co_filename.endswith(place):
            line = trace.tb_lineno
        trace = trace.tb_next
    return said if line is None else f"{said} (line {line})"


def _attribute(module: Any, attribute: str, place: str) -> Any:
    try:
        return getattr(module, attribute)
    except AttributeError:
        names = [
            name
            for name, value in vars(module).items()
            if not name.startswith("_") and not isinstance(value, ModuleType)
        ]
        hint = _core.known_names(attribute, names)
        raise ModelError(f"'{place}' has no '{attribute}'{hint}") from None


def _arguments_of(make: Callable[..., Any], settings: dict[str, Any], name: str) -> set[str]:
    """The names of all arguments of a function. ModelError if a needed argument is not set."""
    try:
        parameters = inspect.signature(make).parameters.values()
    except (TypeError, ValueError):
        raise ModelError(f"'{name}': expected a function that makes a system") from None
    known = {p.name for p in parameters if p.kind in (p.POSITIONAL_OR_KEYWORD, p.KEYWORD_ONLY)}
    for parameter in parameters:
        needed = parameter.default is parameter.empty and parameter.name in known
        if needed and parameter.name not in settings:
            raise ModelError(
                f"'{name}' needs a value of '{parameter.name}': --set {parameter.name}=VALUE"
            )
    if any(p.kind is p.VAR_KEYWORD for p in parameters):
        known |= {n for n in settings if n.isidentifier()}
    return known


def _made(make: Callable[..., Any], arguments: dict[str, Any], name: str) -> Any:
    try:
        return make(**arguments)
    except ModelError:
        raise
    except Exception as error:  # any exception of the function
        raise ModelError(f"'{name}': {_where(error, name.rpartition(':')[0])}") from error


def with_values(context: _core.Context, values: dict[str, Any], more: set[str]) -> _core.Context:
    """The context with parameters and initial states in place of the usual ones."""
    for name, value in values.items():
        try:
            _core.find_entry(context, name)
        except ModelError as error:
            if "unknown" not in str(error):
                raise
            hint = _core.known_names(
                name, list(dict.fromkeys([*sorted(more), *_core.entry_names(context)]))
            )
            raise ModelError(f"unknown parameter or state '{name}'{hint}") from None
        context = _core.with_entry(context, name, _numbers(name, value))
    return context


def _numbers(name: str, value: Any) -> np.ndarray:
    try:
        return np.atleast_1d(np.asarray(value, dtype=float))
    except (TypeError, ValueError):
        raise ModelError(
            f"--set {name}: expected a number or a list of numbers, found {value!r}"
        ) from None
