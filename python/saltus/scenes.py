"""The shelf: ready scenes, each with what is known about its outcome."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

from saltus import _core
from saltus.results import Results
from saltus.simulation import PYTHON_ONLY, SimulatorOptions, simulate
from saltus.system import OutputPort, System

__all__ = ["Scene", "SharedSystem", "scene", "shelf"]


class SharedSystem(System, _core.SharedSystem):
    """A system that was made in C++, such as that of a scene of the shelf.

    It is a system like any other: it has ports and contexts, can be run, and added to a diagram.
    """

    def __getitem__(self, name: str) -> SharedSystem:
        """A block of a diagram by name. ModelError lists the names there are."""
        return SharedSystem(self.block(name))

    @property
    def blocks(self) -> tuple[SharedSystem, ...]:
        """The blocks of a diagram, in the order of `add`; none of a leaf."""
        return tuple(self[name] for name in self.block_names)


class Scene:
    """A system with all that a run of it needs, and what is known about the outcome."""

    name: str
    """by which `saltus.scene` knows it"""
    title: str
    """one line: what it is, and what it is hard for"""
    system: SharedSystem
    context: _core.Context
    """the values at the begin of the span"""
    t_span: tuple[float, float]
    """[s] begin and end"""
    options: SimulatorOptions
    """with the signals that the known answer speaks of, in its order"""
    provenance: str
    """where the known answer comes from, and to how many digits it is known; empty if none is"""
    methods: list[str]
    """those that suit the scene"""
    growth: float
    """by how much the problem enlarges an error made on its way, >= 1"""
    invariants: list[str]
    """names of what does not change along the true solution"""

    def __init__(self, core: _core.Scene, name: str, title: str):
        self._core = core
        self.name = name
        self.title = title
        self.system = SharedSystem(core.system)
        self.context = core.context
        self.t_span = core.t_span
        self.options = self._options(core)
        self.provenance = core.provenance
        self.methods = core.methods
        self.growth = core.growth
        self.invariants = core.invariants

    def _options(self, core: _core.Scene) -> SimulatorOptions:
        same = {f.name for f in fields(SimulatorOptions)} - set(PYTHON_ONLY)
        values: dict[str, Any] = {name: getattr(core.options, name) for name in same}
        signals = {
            name: OutputPort(self.system if block == core.system else SharedSystem(block), index)
            for name, block, index in core.recorded_signals
        }
        return SimulatorOptions(recorded_signals=signals, **values)

    def simulate(self, **options: Any) -> Results:
        """Runs the scene. Options given here, such as `rtol=1e-9`, replace those of the scene.

        Raises what `saltus.simulate` raises.
        """
        return simulate(self.system, self.context, self.t_span, self.options, **options)

    def __repr__(self) -> str:
        begin, end = self.t_span
        return f"<Scene '{self.name}': {self.title}; t = {begin:g} to {end:g} s>"


def shelf() -> dict[str, str]:
    """The names of all ready scenes, with their titles; hybrid ones first.

    >>> for name, title in saltus.shelf().items():
    ...     print(name, title)
    """
    return dict(_core.shelf())


def scene(name: str) -> Scene:
    """The ready scene of that name, with its usual parameters. ModelError lists the names there
    are.

    >>> results = saltus.scene("bouncing-ball").simulate(rtol=1e-9)
    """
    core = _core.scene(name)
    return Scene(core, name, shelf()[name])
