"""What Saltus raises on its own account. What a function of yours raises comes out of a run as it
was.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from saltus.results import Results

__all__ = ["Error", "ModelError", "SimulationError"]


class Error(Exception):
    """Base of the others."""


class ModelError(Error, ValueError):
    """The model, the context or an option is wrong; most are found before the run starts."""


class SimulationError(Error, RuntimeError):
    """The run could not go on."""

    time: float
    """[s] where the run stood"""
    block: str
    """path of the block at fault, or empty"""
    results: Results | None
    """what was computed until then, with the status"""

    def __init__(
        self,
        message: str,
        time: float = float("nan"),
        block: str = "",
        results: Results | None = None,
    ):
        super().__init__(message)
        self.time = time
        self.block = block
        self.results = results

    def __reduce__(
        self,
    ) -> tuple[
        type, tuple[object, ...]
    ]:  # or a copy, for example one from another process, would lose the fields
        return type(self), (str(self), self.time, self.block, self.results)
