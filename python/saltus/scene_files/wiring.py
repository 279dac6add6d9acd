"""What moves the inputs of blocks, along the wires of a diagram: an equality of what moves between
events is no guard.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import cached_property
from typing import Any

from saltus.scene_files.moving import ALWAYS, NEVER, Doubt, Motions

__all__ = ["DiagramPart", "Part", "part_of"]

MOVING = {"Clock", "Sine", "Chirp", "Sawtooth", "TransferFunction", "LTISystem"}
PASSING = {
    "Gain", "Offset", "Adder", "Product", "Abs", "Power", "SquareRoot", "Reciprocal", "Exponent",
    "Logarithm", "Trigonometric", "SumOfElements",
}  # fmt: skip
"""blocks whose output moves with each of their inputs"""
LIMITS = {"lower_limit", "upper_limit", "enable_limits"}
"""arguments of an integrator that may rest at a limit"""


class Part:
    """A block: what moves its outputs, and the equalities that depend on its inputs."""

    def __init__(self, motions: Motions, doubts: tuple[Doubt, ...] = ()):
        self.motions, self.doubts = motions, doubts


def part_of(system: Any, table: Mapping[str, Any]) -> Part:
    """The part of a block that is no diagram. Of a block that is not known here nothing moves."""
    if hasattr(system, "doubts"):
        return Part(system.motions, system.doubts)
    block = table.get("block")
    always = block in MOVING or (block == "Integrator" and not LIMITS & table.keys())
    moved = ALWAYS if always else frozenset(system.input_names) if block in PASSING else NEVER
    return Part({name: moved for name in system.output_names} if moved else {})


class DiagramPart(Part):
    """The parts of a diagram, and its wires, by the names of blocks and ports.

    `sources` leads from an input to the output that is wired to it, `inputs` from an input to that
    of the diagram, `outputs` from an output of the diagram to that of a block. Wrong for an
    equality of what moves.
    """

    def __init__(
        self,
        parts: dict[str, Part],
        sources: dict[str, str],
        inputs: dict[str, str],
        outputs: dict[str, str],
    ):
        self.parts, self.sources, self.inputs, self.outputs = parts, sources, inputs, outputs
        self.doubts = tuple(self._doubts())

    @cached_property
    def motions(self) -> Motions:  # type: ignore[override]
        return {name: self._moved.get(port, NEVER) for name, port in self.outputs.items()}

    def _doubts(self) -> Iterator[Doubt]:
        for name, part in self.parts.items():
            for doubt in part.doubts:
                ports = (f"{name}.{each}" for each in doubt.causes)
                causes = NEVER.union(*map(self._input, ports))
                if causes & ALWAYS:
                    raise doubt.refusal()
                if causes:
                    yield replace(doubt, causes=causes)

    def _input(self, port: str) -> frozenset[str]:
        """What moves an input of a block."""
        if port in self.inputs:
            return frozenset({self.inputs[port]})
        return self._moved.get(self.sources.get(port, ""), NEVER)

    @cached_property
    def _moved(self) -> dict[str, frozenset[str]]:
        """What moves each output of a block: that of the outputs and inputs behind it, along all
        wires and loops.
        """
        moved: dict[str, frozenset[str]] = {}
        behind: dict[str, list[str]] = {}
        for block, part in self.parts.items():
            for name, motion in part.motions.items():
                port, inputs = f"{block}.{name}", [f"{block}.{each}" for each in motion - ALWAYS]
                given = {self.inputs[each] for each in inputs if each in self.inputs}
                moved[port] = (motion & ALWAYS) | given
                for each in inputs:
                    behind.setdefault(self.sources.get(each, ""), []).append(port)
        waiting = list(moved)
        while waiting:
            port = waiting.pop()
            for each in behind.get(port, ()):
                if not moved[port] <= moved[each]:
                    moved[each] |= moved[port]
                    waiting.append(each)
        return moved
