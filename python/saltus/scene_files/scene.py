"""`FileScene`: a scene of a file, with its system, its span and its options."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from saltus import _core
from saltus._porting import missing
from saltus.ensemble.sweep import sweep
from saltus.errors import SimulationError
from saltus.results import Results
from saltus.scene_files.followed import Structural, followed, names_in
from saltus.scene_files.followed_columns import FollowedColumns
from saltus.scene_files.located import explained
from saltus.scene_files.maker import Maker, tree_with
from saltus.scene_files.run import Run, Sweep, run_of, sweep_of
from saltus.scene_files.scene_checks import require_compiles, require_swept, require_updates
from saltus.scene_files.scene_run import span_of, with_atol
from saltus.scene_files.scene_sweep import recorded_paths, system_swept, values_swept
from saltus.scene_files.source import Source, error_of
from saltus.scene_files.systems import parameters_of, system_of_table
from saltus.scene_files.values import entry_named
from saltus.scene_files.writing import text_of
from saltus.scene_files.wrong import Path as Keys
from saltus.scene_files.wrong import Wrong, placed
from saltus.scenes import OF_SCENE
from saltus.simulation import SimulatorOptions, simulate
from saltus.system import System

__all__ = ["FileScene"]


class FileScene:
    """A scene that was read from a file, or from text. Made by `saltus.load_scene`.

    Examples
    --------
    >>> from saltus.scene_files import loads
    >>> scene = loads('''
    ... version = 1
    ... parameters = { k = 2.0 }
    ... states = { x = { start = 1.0, rate = "-k * x" } }
    ... outputs = { x = "x" }
    ... run = { until = 3.0 }
    ... ''')
    >>> scene.parameters, scene.t_span
    ({'k': 2.0}, (0.0, 3.0))
    >>> scene.simulate(rtol=1e-9).status
    'reached_end'
    >>> scene.sweep({"k": [1.0, 2.0]}, as_dict=True)["status"].tolist()
    ['reached_end', 'reached_end']
    >>> scene.maker()(k=5.0).create_context().parameters
    {'k': 5.0}
    >>> import pathlib, tempfile
    >>> file = pathlib.Path(tempfile.mkdtemp(), "decay.json")
    >>> scene.save(file)
    >>> saltus.load_scene(file).parameters
    {'k': 2.0}
    """

    name: str
    """`name` of the file, or the name of the file itself"""
    title: str
    parameters: dict[str, Any]
    """the values of the parameters of the scene"""
    system: System
    context: _core.Context
    """the values at the begin of the span"""
    t_span: tuple[float, float] | None
    """[s] begin and end; None for a file without an end"""
    options: SimulatorOptions
    """the options of a run, with the signals to record"""
    tree: dict[str, Any]
    """the tables of the file, those of included files in place of their names"""
    swept: Sweep
    """the `values` of the table `sweep`, by name, and whether they are `paired`"""

    if not TYPE_CHECKING:  # a type checker knows the names that are there

        def __getattr__(self, name: str) -> Any:
            return missing(self, name, OF_SCENE)

    def __init__(
        self, tree: dict[str, Any], sources: Mapping[Keys, Source], name: str, given: dict[str, Any]
    ):
        self._sources = sources
        self.tree = tree_with(tree, given)
        self.name = tree.get("name", name)
        self.title = tree.get("title", "")
        try:
            self._make()
        except Wrong as wrong:
            raise error_of(wrong, sources) from None

    def _make(self) -> None:
        self.parameters = parameters_of((), self.tree, {})
        self.system = system_of_table(self.tree, self.name, self.parameters)
        run: Run = run_of(self.tree.get("run", {}), self.system, self.parameters)
        self.swept = Sweep({}, False)
        if "sweep" in self.tree:
            self.swept = sweep_of(self.tree["sweep"], self.parameters)
        self.options = run.options
        self.t_span = None if run.until is None else (run.begin, run.until)
        if not self.system.input_names:  # a scene with inputs is a part of another scene
            require_compiles(self)
        with placed(("run", "begin")):
            self.context = self.system.create_context(run.begin)
        require_swept(self)
        require_updates(self.system, run.begin)

    def with_parameters(self, **values: Any) -> FileScene:
        """The scene with other values of its parameters; the file is not read again.

        Raises
        ------
        ModelError
            If a name is unknown, or the file does not allow a value.

        Examples
        --------
        >>> from saltus.scene_files import loads
        >>> scene = loads('version = 1\\nparameters = {k = 2.0}\\nstates = { x = { rate = "k" } }')
        >>> scene.with_parameters(k=5.0).parameters
        {'k': 5.0}
        """
        return FileScene(self.tree, self._sources, self.name, values)

    def simulate(self, time_span: tuple[float, float] | None = None, **options: Any) -> Results:
        """Runs the scene.

        Parameters
        ----------
        time_span
            [s] Begin and end of the run; by default those of the file.
        options
            Options by name, such as `rtol=1e-9`; they replace those of the file. If neither says
            `atol`, it is rtol/100.

        Raises
        ------
        ModelError, SimulationError
            As from `saltus.simulate`; ModelError also if the file gives no end of the run.
        """
        options = with_atol(self, options)
        try:
            span = span_of(self) if time_span is None else time_span
            return simulate(self.system, self.context, span, self.options, **options)
        except SimulationError as error:
            error.args = (self.explained(str(error)), *error.args[1:])
            raise

    def explained(self, message: str) -> str:
        """The message of a run of this scene that failed, with the place in the file of the
        expression at fault.

        Examples
        --------
        >>> from saltus.scene_files import loads
        >>> scene = loads("version = 1\\nstates = { x = { start = -1.0, rate = 'sqrt(x)' } }")
        >>> scene.explained("the derivative of state x[0] of block 'scene' jumps")
        "the derivative of state 'x' of block 'scene' jumps (<text>:2:40: states.x.rate)"
        """
        return explained(message, self.system, self.tree, self._sources)

    @property
    def writes_atol(self) -> bool:
        """Whether the file says `atol`. Otherwise it is rtol/100, also of another rtol."""
        return "atol" in self.tree.get("run", {})

    def sweep(self, values: Any = None, **how: Any) -> Any:
        """Runs the scene for each point of a grid, as `saltus.sweep` does.

        Parameters
        ----------
        values
            As for `saltus.sweep`; by default those of the table `sweep`. A name is a parameter of
            the scene, whose system is then made again for each run, or a value of a block, such as
            "plant.g" or "ball.x[0]".
        how
            Further arguments of `saltus.sweep`.

        Raises
        ------
        ModelError
            As from `saltus.sweep`; also if there are no values, or no end of the run.
        """
        values, how = values_swept(self, values, how)
        system = system_swept(self, values, how)
        options = replace(self.options, recorded_signals=None)
        how = {"recorded_signals": recorded_paths(self)} | with_atol(self, how)
        return sweep(system, values, span_of(self), options=options, **how)

    def following(self, own: frozenset[str]) -> FollowedColumns | None:
        """Gives the values of a context that follow from these parameters of the scene; None if the
        parameters reach more than that: the structure of the system, or the settings of the run.

        Examples
        --------
        >>> from saltus.scene_files import loads
        >>> scene = loads('''
        ... version = 1
        ... parameters = { k = 2.0, T = 1.0 }
        ... states = { x = { start = "k / 4", rate = "-k * x" } }
        ... updates = { tick = { period = "T", set = { x = 1.0 } } }
        ... ''')
        >>> scene.following(frozenset(["k"])).row({"k": 8.0})
        {'k': array(8.), 'x[0]': array(2.)}
        >>> scene.following(frozenset(["T"])) is None
        True
        """
        try:
            values = followed(self.tree, self.system, own)
        except Structural:
            return None
        if names_in(self.tree.get("run", {})) & values.moved:
            return None
        return FollowedColumns(self.tree, values, own)

    def entry_named(self, name: str) -> str:
        """The name in a context of a parameter or of a state of a block.

        Raises
        ------
        ModelError
            If a new value would reach the equations of the block and not its start or its period.

        Examples
        --------
        >>> from saltus.scene_files import loads
        >>> counter = loads("version = 1\\ndiscrete = { n = 0, m = 1 }")
        >>> counter.entry_named("m")
        'z[1]'
        """
        return name if name in self.parameters else entry_named(self.system, self.tree, name)

    def maker(self) -> Maker:
        """A function that makes the system anew with other parameters; it can be pickled."""
        return Maker(self.tree, self.name)

    def save(self, path: str | Path) -> None:
        """Writes the scene, as TOML or JSON by the end of the name, in one file.

        Raises
        ------
        ModelError
            If the name has another end.
        """
        path = Path(path)
        kind = path.suffix.lower().removeprefix(".")
        path.write_text(text_of(self.tree, kind), encoding="utf-8")

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, FileScene):
            return NotImplemented
        return (self.name, self.tree) == (other.name, other.tree)

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[Any, ...]:
        return FileScene, (self.tree, dict(self._sources), self.name, {})

    def __repr__(self) -> str:
        title = f": {self.title}" if self.title else ""
        span = "" if self.t_span is None else f"; t = {self.t_span[0]:g} to {self.t_span[1]:g} s"
        return f"<FileScene '{self.name}'{title}{span}>"
