"""Blocks that put vectors together and cut them apart."""

from __future__ import annotations

from saltus import _core
from saltus.library.block import Block

__all__ = ["Demultiplexer", "Multiplexer"]


class Multiplexer(Block, _core.Multiplexer):
    """y = (u_0, u_1, ...): the inputs, one after the other, as one vector.

    Parameters
    ----------
    n_inputs
        How many inputs there are, 1 or more; each may be a number or a vector.
    name
        How messages, contexts and `diagram[...]` know it; if not said, its class and number.

    Examples
    --------
    >>> from saltus.library import Constant, Multiplexer
    >>> builder = saltus.DiagramBuilder()
    >>> a, b, block = builder.add(Constant(1.0), Constant([2.0, 3.0]), Multiplexer(2))
    >>> builder.connect(a.output(), block.input(0))
    >>> builder.connect(b.output(), block.input(1))
    >>> diagram = builder.build()
    >>> saltus.simulate(
    ...     diagram, diagram.create_context(), (0.0, 0.0), recorded_signals={"y": block.output()}
    ... ).outputs["y"]
    array([[1., 2., 3.]])
    """

    def __init__(self, n_inputs: int, *, name: str | None = None):
        super().__init__(self._named(name), n_inputs)


class Demultiplexer(Block, _core.Demultiplexer):
    """y_k = part k of u, which is cut into equal parts.

    Parameters
    ----------
    n_outputs
        How many parts there are, 1 or more; the width of u must be a multiple.
    name
        How messages, contexts and `diagram[...]` know it; if not said, its class and number.

    Raises
    ------
    ModelError
        When the diagram is used, if u cannot be cut so.

    Examples
    --------
    >>> from saltus.library import Constant, Demultiplexer
    >>> builder = saltus.DiagramBuilder()
    >>> u, block = builder.add(Constant([1.0, 2.0, 3.0, 4.0]), Demultiplexer(2))
    >>> builder.connect(u.output(), block.input())
    >>> _ = builder.export_output(block.output(), "y")
    >>> diagram = builder.build()
    >>> saltus.simulate(
    ...     diagram, diagram.create_context(), (0.0, 0.0), recorded_signals={"y": diagram.output()}
    ... ).outputs["y"]
    array([[1., 2.]])
    """

    def __init__(self, n_outputs: int, *, name: str | None = None):
        super().__init__(self._named(name), n_outputs)
