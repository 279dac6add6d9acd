"""The blocks that a builder has collected, and their ports by path."""

from __future__ import annotations

from saltus import _core
from saltus.errors import ModelError
from saltus.ports import core_port
from saltus.system import InputPort, OutputPort, System

__all__ = ["BuilderParts", "port_in_core"]


def port_in_core(port: object, kind: type[OutputPort] | type[InputPort]) -> tuple[System, int]:
    """The system and the position of a port; ModelError for anything but a port of this kind."""
    if not isinstance(port, kind):
        wanted = "an input" if kind is InputPort else "an output"
        wanted = wanted if isinstance(port, (InputPort, OutputPort)) else "a port"
        example = "input_ports[0]" if kind is InputPort else "output_ports[0]"
        if isinstance(port, System):
            method = "input" if kind is InputPort else "output"
            raise ModelError(f"expected {wanted}, found the block {port!r}; write block.{method}()")
        raise ModelError(f"expected {wanted}, such as block.{example}, found {port!r}")
    return core_port(port)


class BuilderParts:
    """The blocks of a diagram that is being built, by their names."""

    def __init__(self) -> None:
        self._core = _core.DiagramBuilder()
        self._children: dict[str, System] = {}
        self._exported: list[OutputPort] = []

    def _output(self, where: str, port: OutputPort | str) -> OutputPort:
        if not isinstance(port, str):
            return port
        block, name = self._from(where, port, "output")
        return block.output(name)

    def _input(self, where: str, port: InputPort | str) -> InputPort:
        if not isinstance(port, str):
            return port
        block, name = self._from(where, port, "input")
        return block.input(name)

    def _from(self, where: str, path: str, kind: str) -> tuple[System, str]:
        """The block and the name of its port for a path such as "gain.out"; of a block with one
        port of the kind, "output", "input", "event_output" or "event_input", also for its name.
        """
        name, dot, port = path.partition(".")
        if not dot and name in self._children:
            return self._children[name], self._only(where, name, kind)
        if name not in self._children or not dot:
            known = _core.known_names(name, list(self._children))
            raise ModelError(
                f"{where}: expected the names of a block and of a port, such as 'gain.out', found "
                f"'{path}'{known}"
            )
        if "." in port:
            raise ModelError(
                f"{where}: '{path}' is a port inside of diagram '{name}'; export it there, and "
                f"take the exported port"
            )
        return self._children[name], port

    def _only(self, where: str, name: str, kind: str) -> str:
        """The name of the only port of a block; ModelError if there are several, or none."""
        ports: list[str] = getattr(self._children[name], f"{kind}_names")
        if len(ports) == 1:
            return ports[0]
        listed = ", ".join(f"'{name}.{port}'" for port in ports)
        what = kind.replace("_", " ")
        raise ModelError(
            f"{where}: block '{name}' has "
            + (f"{len(ports)} {what}s; say which: {listed}" if ports else f"no {what}")
        )
