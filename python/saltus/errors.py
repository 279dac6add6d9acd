"""The exceptions of Saltus. A run raises an exception of your own function unchanged."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from saltus.results import Results

__all__ = [
    "AlgebraicLoopError",
    "BlockParameterError",
    "BuilderError",
    "EmptyDiagramError",
    "Error",
    "InputNotConnectedError",
    "ModelError",
    "SceneError",
    "ShapeMismatchError",
    "SimulationError",
    "StaticError",
    "SystemNameNotUniqueError",
]


class Error(Exception):
    """The base class of Saltus's own exceptions.

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

    The message says what was expected, what was found, and where. For a misspelt name it has the
    nearest known name. It is a `ValueError` as well.

    Examples
    --------
    >>> saltus.SimulatorOptions(rtoll=1e-9)
    Traceback (most recent call last):
        ...
    saltus.errors.ModelError: SimulatorOptions: unknown option 'rtoll'; did you mean 'rtol'? ...
    """


class BuilderError(ModelError):
    """A call of `DiagramBuilder` is wrong.

    Examples
    --------
    >>> from saltus.errors import BuilderError
    >>> builder = saltus.DiagramBuilder()
    >>> try:
    ...     builder.export_output(saltus.library.Clock(name="clock").output())
    ... except BuilderError as error:
    ...     print(error)
    block 'clock' was not added to this diagram; its blocks: none
    """


class SystemNameNotUniqueError(BuilderError):
    """Two blocks of a diagram have one name."""


class EmptyDiagramError(BuilderError):
    """A diagram without a block was built."""


class StaticError(ModelError):
    """A block, or the way the blocks are connected, is wrong."""


class BlockParameterError(StaticError):
    """A value or a word that a block was made with is impossible."""


class InputNotConnectedError(StaticError):
    """An input has no source."""


class AlgebraicLoopError(StaticError):
    """Outputs depend on one another at the same time."""


class ShapeMismatchError(StaticError):
    """An input expects another number of values than its source has."""


class SceneError(ModelError):
    """A scene file is wrong: the message begins with its name, and the line and column.

    Parameters
    ----------
    message
        The text: what was expected, what was found, and where.
    file
        The name of the file as the caller gave it, or '<text>'.
    line, column
        The place of the mistake, counted from 1; None if it has no place, as for a missing file.
    key
        The place in the tables of the file, such as 'states.v.rate'.

    Examples
    --------
    >>> from saltus.scene_files import loads
    >>> try:
    ...     loads('version = 1\\n[states]\\nv = { rate = "-g" }')
    ... except saltus.errors.SceneError as error:
    ...     print(error.line, error.column, error.key)
    3 16 states.v.rate
    """

    file: str
    line: int | None
    column: int | None
    key: str

    def __init__(
        self,
        message: str,
        file: str = "",
        line: int | None = None,
        column: int | None = None,
        key: str = "",
    ):
        super().__init__(message)
        self.file, self.line, self.column, self.key = file, line, column, key

    def __reduce__(self) -> tuple[type, tuple[object, ...]]:
        # Without this a copy from another process would lose the place.
        return type(self), (str(self), self.file, self.line, self.column, self.key)


class SimulationError(Error, RuntimeError):
    """The run could not continue. It is a `RuntimeError` as well.

    Parameters
    ----------
    message
        The failure, its time and place, and a remedy.
    time
        [s] The time that the run had reached.
    block
        Path of the block at fault, or empty.
    results
        The run until then, with its status.

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
    """[s] the time that the run had reached"""
    block: str
    """path of the block at fault, or empty"""
    results: Results | None
    """the run until then, with its status"""

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

    def __reduce__(self) -> tuple[type, tuple[object, ...], dict[str, object]]:
        # Without this a copy, for example one from another process, would lose the fields. The
        # results refer to this error as their cause, so they come after it, as its state.
        return type(self), (str(self), self.time, self.block), dict(self.__dict__)


NAMES_OF_OTHERS = {
    "BlockInitializationError": "ModelError",
    "BlockRuntimeError": "SimulationError",
    "CallbackIsNotDifferentiableError": "ModelError",
    "CollimatorError": "Error",
    "DtypeMismatchError": "",
    "LegacyBlockConfigurationError": "",
    "ModelInitializationError": "ModelError",
    "ParameterError": "ModelError",
    "PythonScriptError": "SimulationError",
    "StaticParameterError": "ModelError",
}
"""exceptions of pycollimator -> what is raised here, if anything can be"""


if not TYPE_CHECKING:  # a type checker knows the names that are there

    def __getattr__(name: str) -> None:
        if name not in NAMES_OF_OTHERS:
            raise AttributeError(f"module 'saltus.errors' has no attribute '{name}'")
        here = NAMES_OF_OTHERS[name]
        says = f"it is {here} here" if here else "nothing raises it here: leave it out"
        # not an AttributeError, whose text `from saltus.errors import ...` would replace
        raise ImportError(f"saltus.errors has no '{name}'; {says}")
