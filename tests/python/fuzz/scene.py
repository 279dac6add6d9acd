"""A random scene as plain data, which prints as the code that makes it again, and the diagram it
describes.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
import saltus
from leaves import Ball, Leaf
from saltus import library

FUNCTIONS = {  # of the blocks that call Python
    "less": lambda u: u[0] < u[1],
    "both": lambda u: (u[0] > 0) and (u[1] > 0),
    "larger": lambda u: max(u[0], u[1]),
    "sum": lambda u: u[0] + u[1],
    "sine": lambda u: float(np.sin(u)),
    "positive": lambda u: u > 0,
}


@dataclass(frozen=True)
class Part:
    """One block. `sources` has for each input the (part, output) it is connected to; None makes a
    source of its own.
    """

    kind: str
    arguments: dict[str, Any] = field(default_factory=dict)
    sources: tuple[tuple[int, int] | None, ...] = ()


@dataclass(frozen=True)
class Scene:
    parts: tuple[Part, ...]
    span: tuple[float, float] = (0.0, 1.0)
    options: dict[str, Any] = field(default_factory=dict)


def make(part: Part, name: str) -> saltus.System:
    arguments = dict(part.arguments)
    if part.kind in ("Leaf", "Ball"):
        return {"Leaf": Leaf, "Ball": Ball}[part.kind](name=name, **arguments)
    if part.kind in ("ReduceBlock", "FunctionBlock"):
        function = FUNCTIONS[arguments.pop("function")]
        inputs = (len(part.sources),) if part.kind == "ReduceBlock" else ()
        return getattr(library, part.kind)(*inputs, function, name=name, **arguments)
    return getattr(library, part.kind)(name=name, **arguments)


def own_source(port: saltus.InputPort, name: str) -> saltus.System:
    if port.name.endswith(("trigger", "control")):
        return library.Pulse(period=0.7, name=name)
    return library.Constant(0.5, name=name)


def build(scene: Scene) -> saltus.Diagram:
    builder = saltus.DiagramBuilder()
    blocks = [make(part, f"{part.kind}{i}") for i, part in enumerate(scene.parts)]
    for block in blocks:
        builder.add(block)
    for part, block in zip(scene.parts, blocks, strict=True):
        for port, source in zip(block.input_ports, part.sources, strict=True):
            if source is None:
                spare = builder.add(own_source(port, f"{block.name}_{port.name}"))
                builder.connect(spare.output(), port)
            else:
                builder.connect(blocks[source[0]].output(source[1]), port)
    return builder.build("inside")


def signals(diagram: saltus.Diagram) -> dict[str, saltus.OutputPort]:
    """Every output, by block and port."""
    return {f"{b.name}.{port.name}": port for b in diagram.blocks for port in b.output_ports}
