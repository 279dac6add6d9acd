"""The shelf: ready scenes, each with the known facts about its outcome."""

from __future__ import annotations

import operator
import os
from dataclasses import fields
from typing import TYPE_CHECKING, Any

from saltus import _core
from saltus._engine import PYTHON_ONLY
from saltus._porting import missing
from saltus.errors import ModelError
from saltus.results import Results
from saltus.simulation import SimulatorOptions, simulate
from saltus.system import OutputPort, System, remember

if TYPE_CHECKING:
    from saltus.scene_files import FileScene

__all__ = ["OF_SCENE", "Scene", "SharedSystem", "load_scene", "scene", "shelf"]


class SharedSystem(System, _core.SharedSystem):
    """A system that was made in C++, such as that of a scene of the shelf.

    It is a system like any other: it has ports and contexts, can be run, and added to a diagram.

    Examples
    --------
    >>> system = saltus.scene("bouncing-ball-blocks").system
    >>> [block.name for block in system.blocks][:2]
    ['integrator_v', 'integrator_y']
    """

    def __init__(self, handle: _core.SystemHandle, again: tuple[Any, ...] | None = None):
        super().__init__(handle)
        self._again = again
        remember(self)

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickles a system of the shelf, or a block in it, as the recipe to make it again."""
        if self._again is None:
            raise TypeError(f"cannot pickle system '{self.name}': it was made in C++")
        return self._again

    def __getitem__(self, name: str) -> SharedSystem:
        """A block of a diagram by name. ModelError lists the names there are."""
        again = None if self._again is None else (operator.getitem, (self, name))
        return SharedSystem(self.block(name), again)

    @property
    def blocks(self) -> tuple[SharedSystem, ...]:
        """The blocks of a diagram, in the order of `add`; none of a leaf."""
        return tuple(self[name] for name in self.block_names)


OF_SCENE = {
    **dict.fromkeys(("run", "solve", "sim"), "it is scene.simulate()"),
    **dict.fromkeys(("params", "parameter"), "it is scene.parameters"),
}
"""names that are tried -> those here"""


class Scene:
    """A system with all that a run of it needs, and its known answer.

    Made by `saltus.scene`.

    Examples
    --------
    >>> scene = saltus.scene("bouncing-ball")
    >>> scene.t_span, scene.context.continuous_state
    ((0.0, 12.0), array([10.,  0.]))
    >>> scene.simulate(rtol=1e-9).status
    'reached_end'
    """

    name: str
    """the name for `saltus.scene`"""
    parameters: dict[str, float]
    """the parameters that `saltus.scene` can change, with their values here"""
    title: str
    """one line: the scene and its difficulty"""
    system: SharedSystem
    context: _core.Context
    """the values at the begin of the span"""
    t_span: tuple[float, float]
    """[s] begin and end"""
    options: SimulatorOptions
    """the options of a run, with the signals of the known answer, in its order"""
    provenance: str
    """the origin of the known answer and its digits; empty if no answer is known"""
    methods: list[str]
    """the methods that suit the scene"""
    growth: float
    """the factor, >= 1, by which the problem enlarges an error made on its way"""
    invariants: list[str]
    """names of the quantities that are constant along the true solution"""

    def __init__(self, core: _core.Scene, name: str, title: str, parameters: dict[str, float]):
        self._core = core
        self.name = name
        self.title = title
        self.parameters = parameters
        self.system = SharedSystem(core.system, _made_again(name, parameters))
        self.context = core.context
        self.t_span = core.t_span
        self.options = self._options(core)
        self.provenance = core.provenance
        self.methods = core.methods
        self.growth = core.growth
        self.invariants = core.invariants

    if not TYPE_CHECKING:  # a type checker knows the names that are there

        def __getattr__(self, name: str) -> Any:
            return missing(self, name, OF_SCENE)

    def _options(self, core: _core.Scene) -> SimulatorOptions:
        same = {f.name for f in fields(SimulatorOptions)} - set(PYTHON_ONLY)
        values: dict[str, Any] = {name: getattr(core.options, name) for name in same}
        signals = {
            name: OutputPort(self.system if block == core.system else SharedSystem(block), index)
            for name, block, index in core.recorded_signals
        }
        return SimulatorOptions(recorded_signals=signals, **values)

    def simulate(self, time_span: tuple[float, float] | None = None, **options: Any) -> Results:
        """Runs the scene.

        Parameters
        ----------
        time_span
            [s] Begin and end of the run; by default those of the scene.
        options
            Options by name, such as `rtol=1e-9`; they replace those of the scene.

        Raises
        ------
        ModelError, SimulationError
            As `saltus.simulate` does.

        Examples
        --------
        >>> results = saltus.scene("kepler").simulate(ode_solver_method="dop853")
        >>> results.statistics.method
        'dop853'
        """
        span = self.t_span if time_span is None else time_span
        return simulate(self.system, self.context, span, self.options, **options)

    def __repr__(self) -> str:
        begin, end = self.t_span
        return f"<Scene '{self.name}': {self.title}; t = {begin:g} to {end:g} s>"


def shelf() -> dict[str, str]:
    """The names of all ready scenes, with their titles; hybrid ones first.

    Examples
    --------
    >>> for name, title in saltus.shelf().items():
    ...     print(f"{name}: {title}")
    bouncing-ball: ...
    """
    return dict(_core.shelf())


def scene(name: str, **parameters: float) -> Scene:
    """A ready scene, with its usual parameters or with others.

    Parameters
    ----------
    name : str
        One of the names in `saltus.shelf()`.
    **parameters : float
        Some of those in ``scene(name).parameters``: constants of the model, its start, and
        ``t_end`` [s]. The known answer is that of these values; if it is known for the usual values
        only, ``provenance`` says so.

    Returns
    -------
    Scene

    Raises
    ------
    ModelError
        If a name is unknown (the message has the nearest), or a value has no meaning in the scene.

    Examples
    --------
    >>> import saltus
    >>> results = saltus.scene("bouncing-ball", e=0.5, y0=2.0).simulate(rtol=1e-9)
    >>> results.status
    'reached_end'
    """
    try:
        chosen = [(key, float(value)) for key, value in parameters.items()]
    except (TypeError, ValueError):
        raise ModelError(f"scene '{name}': expected numbers, found {parameters}") from None
    if str(name).lower().endswith((".toml", ".json")):
        raise ModelError(f"'{name}' is a file: saltus.load_scene('{name}')")
    if name not in (known := list(shelf())):
        raise ModelError(f"no scene '{name}' on the shelf{_core.known_names(str(name), known)}")
    core = _core.scene(name, chosen)
    return Scene(core, name, shelf()[name], {**dict(_core.scene_parameters(name)), **dict(chosen)})


def load_scene(path: str | os.PathLike[str], /, **parameters: Any) -> FileScene:
    """A scene from a file, TOML or JSON; see the guide to scene files.

    Nothing in a file executes code: its expressions are parsed, checked and traced.

    Parameters
    ----------
    path
        A file whose name ends in .toml or .json.
    **parameters
        Values of parameters of the scene, in place of those in the file. Other parameters that are
        expressions of them follow.

    Returns
    -------
    FileScene

    Raises
    ------
    SceneError
        A ModelError with the file, the line and the column, for a mistake in a file.
    ModelError
        If a parameter is unknown; the message has the nearest name.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> file = pathlib.Path(tempfile.mkdtemp(), "decay.toml")
    >>> _ = file.write_text('''
    ... version = 1
    ... parameters = { k = 2.0 }
    ... states = { x = { start = 1.0, rate = "-k * x" } }
    ... outputs = { x = "x" }
    ... run = { until = 1.0, rtol = 1e-9 }
    ... ''')
    >>> scene = saltus.load_scene(file, k=1.0)
    >>> round(float(scene.simulate().outputs["x"][-1]), 6)
    0.367879
    """
    from saltus import scene_files

    return scene_files.load(path, **parameters)


def _made_again(name: str, parameters: dict[str, float]) -> tuple[Any, ...]:
    """The recipe of this system for pickle: another process makes it anew."""
    return _system_of, (name, parameters)


def _system_of(name: str, parameters: dict[str, float]) -> SharedSystem:
    return scene(name, **parameters).system
