"""What Saltus raises on its own account. What a function of yours raises comes out of a run as it
was.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from saltus.results import Results

__all__ = ["Error", "ModelError", "SimulationError"]


class Error(Exception):
    """Base of what Saltus raises on its own account.

    Examples
    --------
    >>> from saltus.library import Gain
    >>> try:
    ...     Gain("much")
    ... except saltus.Error as error:
    ...     print(type(error).__name__)
    ModelError
    """


class ModelError(Error, ValueError):
    """The model, the context or an option is wrong; most are found before the run starts.

    The message says what was expected, what was found, and where; a misspelt name gets the nearest
    one there is. It is a `ValueError` as well.

    Examples
    --------
    >>> saltus.SimulatorOptions(rtoll=1e-9)
    Traceback (most recent call last):
        ...
    saltus.errors.ModelError: SimulatorOptions: unknown option 'rtoll'; did you mean 'rtol'? ...
    """


class SimulationError(Error, RuntimeError):
    """The run could not go on. It is a `RuntimeError` as well.

    Parameters
    ----------
    message
        What happened, when, where, and what can be done.
    time
        [s] Where the run stood.
    block
        Path of the block at fault, or empty.
    results
        What was computed until then, with the status.

    Examples
    --------
    dx/dt = x² has no solution beyond t = 1 s:

    >>> from saltus.library import FunctionBlock, Integrator
    >>> builder = saltus.DiagramBuilder()
    >>> x, square = builder.add(Integrator(1.0), FunctionBlock(lambda u: u * u))
    >>> builder.connect(x.output(), square.input())
    >>> builder.connect(square.output(), x.input())
    >>> diagram = builder.build()
    >>> try:
    ...     saltus.simulate(diagram, diagram.create_context(), (0.0, 2.0))
    ... except saltus.SimulationError as error:
    ...     print(f"stopped at t = {error.time:.3f} s: {error.results.status}")
    stopped at t = 1.000 s: failed
    """

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

    def __reduce__(self) -> tuple[type, tuple[object, ...]]:
        # Without this a copy, for example one from another process, would lose the fields.
        return type(self), (str(self), self.time, self.block, self.results)
