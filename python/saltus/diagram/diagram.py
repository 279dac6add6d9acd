"""`Diagram`: the system of blocks and wires."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from saltus import _core
from saltus._quantities import says
from saltus._signals import block_of
from saltus.errors import ModelError
from saltus.parameter import Parameter
from saltus.system import OutputPort, System, remember

__all__ = ["Diagram"]


class Diagram(System, _core.Diagram):
    """A system of blocks and wires, made by `DiagramBuilder.build`.

    `diagram["gain"]` is the block with that name. A diagram is a system like any other: it can be
    added to another diagram, to any depth. It keeps its blocks alive.

    Examples
    --------
    >>> from saltus.library import Constant, Integrator
    >>> builder = saltus.DiagramBuilder()
    >>> speed, x = builder.add(Constant(2.0, name="speed"), Integrator(name="x"))
    >>> builder.connect(speed.output(), x.input())
    >>> builder.export_output(x.output(), "position")
    0
    >>> diagram = builder.build("car")
    >>> diagram["x"].name, [block.name for block in diagram.blocks]
    ('x', ['speed', 'x'])
    >>> results = saltus.simulate(diagram, diagram.create_context(), (0.0, 3.0))
    >>> results.context[diagram["x"]].continuous_state
    array([6.])
    """

    def __init__(
        self,
        builder: _core.DiagramBuilder,
        name: str,
        children: dict[str, System],
        parameters: Mapping[str, Parameter] = {},
        exported: Sequence[OutputPort] = (),
    ):
        super().__init__(builder, name)
        self._children = children
        self._expressions = dict(parameters)
        self._exported = tuple(exported)
        self._says = any(map(says, children.values()))
        remember(self)

    def __getitem__(self, name: str) -> System:
        """A block of this diagram by name. ModelError lists the known names."""
        if not isinstance(name, str):
            raise TypeError(f"expected the name of a block, such as 'gain', found {name!r}")
        if name not in self._children:
            self.require(name)  # raises
        return self._children[name]

    @property
    def blocks(self) -> tuple[System, ...]:
        """The blocks of this diagram, in the order of `add`."""
        return tuple(self._children.values())

    @property
    def nodes(self) -> tuple[System, ...]:
        """The blocks of this diagram, as `blocks`."""
        return self.blocks

    @property
    def num_systems(self) -> int:
        """How many blocks this diagram has, an inner diagram counted as one."""
        return len(self._children)

    def find_system_with_path(self, path: str) -> System:
        """The block at a path of names, such as "car.engine"; ModelError if there is none.

        Examples
        --------
        >>> from saltus.library import Clock
        >>> builder = saltus.DiagramBuilder()
        >>> clock = builder.add(Clock(name="clock"))
        >>> builder.build().find_system_with_path("clock")
        <Clock 'clock'>
        """
        if not isinstance(path, str):
            raise ModelError(f"expected a path such as 'car.engine', found {path!r}")
        system: System = self
        for name in path.split("."):
            system = block_of(system, name)
        return system

    @property
    def parameters(self) -> dict[str, float | np.ndarray]:
        """The default value of each parameter: of its blocks by path, such as 'gain.gain', and its
        own by name.
        """
        return self.create_context().parameters
