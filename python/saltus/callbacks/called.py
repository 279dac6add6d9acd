"""The Python functions of a system of which none is traced."""

from __future__ import annotations

from typing import Any

from saltus import _core
from saltus.callbacks.callbacks import Callbacks
from saltus.callbacks.function import Block

__all__ = ["Called"]


class Called(Callbacks):
    """The callbacks with the option `python="called"`.

    They are searched all the same for values outside of the system that they share.
    """

    def __init__(self, system: Any):
        super().__init__(system)
        for number, block in enumerate(self.traces.blocks()):
            self.trace_block(number, block)

    def trace_block(self, number: int, block: Block) -> list[_core.Trace]:
        """No function has a trace."""
        self.outcomes[number] = [None for _ in block["functions"]]
        self._runs[number] = []
        self._add_ways(self.outcomes[number])
        return []
