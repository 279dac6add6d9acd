"""`FileScene`: a scene of a file, with its system, its span and its options."""

from __future__ import annotations

import copy
import inspect
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from saltus import _core
from saltus._porting import missing
from saltus._signals import blocks_in
from saltus.ensemble.job import Following
from saltus.ensemble.sweep import sweep
from saltus.ensemble.table import Column, entry, table_of
from saltus.errors import ModelError, SimulationError
from saltus.options import atol_beside
from saltus.results import Results
from saltus.scene_files.followed import Followed, Structural, followed, names_in
from saltus.scene_files.located import explained
from saltus.scene_files.run import Run, Sweep, run_of, sweep_of
from saltus.scene_files.source import Source, error_of
from saltus.scene_files.systems import parameters_of, system_of_table
from saltus.scene_files.values import entry_named
from saltus.scene_files.writing import text_of
from saltus.scene_files.wrong import Path as Keys
from saltus.scene_files.wrong import Wrong, placed
from saltus.scenes import OF_SCENE
from saltus.simulation import Simulator, SimulatorOptions, simulate
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
        self.tree = _tree_with(tree, given)
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
            self._check()
        with placed(("run", "begin")):
            self.context = self.system.create_context(run.begin)
        self._require_swept()
        _require_updates(self.system, run.begin)

    def _require_swept(self) -> None:
        """Wrong for a name of the table `sweep` that the scene does not have."""
        for name in self.swept.values:
            if name not in self.parameters:
                with placed(("sweep", "values", name)):
                    self._require_value(name)

    def _require_value(self, name: str) -> None:
        try:
            _core.find_entry(self.context, self.entry_named(name))
        except ModelError as error:
            if "unknown" not in str(error):
                raise
            names = list(dict.fromkeys([*self.parameters, *_core.entry_names(self.context)]))
            hint = _core.known_names(name, names)
            raise ModelError(f"unknown parameter or state '{name}'{hint}") from None

    def _check(self) -> None:
        """Compiles the system, which finds shapes that do not fit and loops."""
        try:
            Simulator(self.system, self.options)
        except (ModelError, TypeError, ValueError) as error:
            raise Wrong(_named(str(error), self.tree), str(error)) from None

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

    def simulate(self, **options: Any) -> Results:
        """Runs the scene.

        Parameters
        ----------
        options
            Options by name, such as `rtol=1e-9`; they replace those of the file. If neither says
            `atol`, it is rtol/100.

        Raises
        ------
        ModelError, SimulationError
            As from `saltus.simulate`; ModelError also if the file gives no end of the run.
        """
        options = self._with_atol(options)
        try:
            return simulate(self.system, self.context, self._span(), self.options, **options)
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

    def _with_atol(self, options: dict[str, Any]) -> dict[str, Any]:
        rtol = options.get("rtol")
        if "atol" in options or self.writes_atol or not isinstance(rtol, (float, list, tuple)):
            return options
        return options | {"atol": atol_beside(rtol)}

    def _span(self) -> tuple[float, float]:
        if self.t_span is None:
            raise ModelError(
                f"scene '{self.name}' says no end of the run; write until = ... [s] in its table "
                "'run'"
            )
        return self.t_span

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
        if values is None:
            if not self.swept.values:
                raise ModelError(f"scene '{self.name}' says nothing to vary; write a table 'sweep'")
            values, how = self.swept.values, {"paired": self.swept.paired} | how
        values = _renamed(values, self.entry_named)
        system: Any = self.system
        own = self.parameters.keys() & _names(values)
        if how.get("executor") == "processes":  # a function that makes a system can be sent there
            system = self.maker()
        elif own:
            system = self._following(values, frozenset(own), how) or self.maker()
        signals = {name: _path_in(self, name) for name in self.options.recorded_signals or {}}
        options = replace(self.options, recorded_signals=None)
        how = {"recorded_signals": signals} | self._with_atol(how)
        return sweep(system, values, self._span(), options=options, **how)

    def _following(
        self, values: Any, own: frozenset[str], how: Mapping[str, Any]
    ) -> Following | None:
        """The system with the values that follow from parameters of the scene; None if each run
        needs a system of its own, also because the file does not allow one of the values.
        """
        if how.get("store") is not None:  # what a store holds is named by the function
            return None
        try:
            follow = Columns(self.tree, followed(self.tree, self.system, own), own)
            columns = table_of(values, bool(how.get("paired"))).columns
            states = follow(columns).keys() - columns.keys() - self.context.parameters.keys()
        except (Structural, Wrong, ModelError, TypeError, ValueError):
            return None
        given = columns.keys() - own - self.context.parameters.keys()
        if _share(states, given):
            return None  # two names of one state, of which that of the block wins
        return Following(self.system, follow)

    def following(self, own: frozenset[str]) -> Columns | None:
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
        return Columns(self.tree, values, own)

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


class Columns:
    """The values of a context that follow from parameters of a scene, row by row."""

    def __init__(self, tree: dict[str, Any], values: Followed, own: frozenset[str]):
        self.tree, self.own, self.followed = tree, own, values
        self._rows: dict[str, dict[str, np.ndarray]] = {}

    def __call__(self, columns: Mapping[str, Column]) -> dict[str, Column]:
        runs = len(next(iter(columns.values())))
        rows = [self.row({n: entry(columns[n], i) for n in self.own}) for i in range(runs)]
        made = {name: np.array([row[name] for row in rows]) for name in rows[0]}
        return made | {name: c for name, c in columns.items() if name not in self.own}

    def row(self, given: dict[str, Any]) -> dict[str, np.ndarray]:
        """The values for these parameters. ModelError for one that the file does not allow, and
        ValueError for one that is not finite.
        """
        key = repr(given)  # a sweep asks for the columns of a row more than once
        if key not in self._rows:
            try:
                values = parameters_of((), _tree_with(self.tree, given), {})
                found = list(self.followed.entries(values))
            except Wrong as wrong:
                raise ModelError(wrong.message) from None
            made = {name: np.asarray(value, dtype=float) for name, value in found}
            if not all(np.isfinite(value).all() for value in made.values()):
                raise ValueError("a value that is not finite")
            self._rows[key] = made
        return self._rows[key]


@dataclass(frozen=True)
class Maker:
    """Makes the system of a scene with other values of its parameters."""

    tree: dict[str, Any]
    name: str

    @property
    def __signature__(self) -> inspect.Signature:
        kind = inspect.Parameter.KEYWORD_ONLY
        own = self.tree.get("parameters", {})
        return inspect.Signature([inspect.Parameter(n, kind, default=None) for n in own])

    def __call__(self, **values: Any) -> System:
        tree = _tree_with(self.tree, values)
        source = Source("<text>", "", "toml")
        try:
            return system_of_table(tree, self.name, parameters_of((), tree, {}))
        except Wrong as wrong:
            raise error_of(wrong, {(): source}) from None


def _tree_with(tree: dict[str, Any], given: Mapping[str, Any]) -> dict[str, Any]:
    """The tree with other values of parameters. ModelError for unknown ones."""
    if not given:
        return tree
    tree = copy.copy(tree)
    own = dict(tree.get("parameters", {}))
    for name, value in given.items():
        if name not in own:
            known = _core.known_names(name, list(own)) if own else "; the scene has none"
            raise ModelError(f"unknown parameter '{name}' of the scene{known}")
        plain = value.tolist() if hasattr(value, "tolist") else value
        own[name] = {**own[name], "value": plain} if isinstance(own[name], dict) else plain
    tree["parameters"] = own
    return tree


def _share(some: Collection[str], others: Collection[str]) -> bool:
    """Whether there is a block of which both have states."""
    return bool({n.rpartition(".")[0] for n in some} & {n.rpartition(".")[0] for n in others})


def _names(values: Any) -> list[str]:
    """The names of a dict, of a list of dicts, or of a DataFrame."""
    if isinstance(values, (list, tuple)):
        return list(dict.fromkeys(name for row in values for name in row))
    return list(values)


def _renamed(values: Any, rename: Callable[[str], str]) -> Any:
    """Values by the names of a context; also of a DataFrame."""
    if isinstance(values, Mapping):
        return {rename(name): column for name, column in values.items()}
    if isinstance(values, (list, tuple)) and all(isinstance(row, Mapping) for row in values):
        return [{rename(name): value for name, value in row.items()} for row in values]
    if hasattr(values, "rename"):
        return values.rename(columns=rename)
    return values


def _path_in(scene: FileScene, name: str) -> str:
    """The path of a recorded signal, which is valid also in a system that is made anew."""
    record = scene.tree.get("run", {}).get("record")
    return str(record[name]) if isinstance(record, dict) else name


def _require_updates(system: System, begin: float) -> None:
    """Wrong for updates of a block that all come before the run begins."""
    for path, last in getattr(system, "last", ()):
        if last < begin:
            raise Wrong(
                path, f"expected a time from {begin:g} s on, the begin of the run, found {last:g}"
            )
    for block in blocks_in(system):
        _require_updates(block, begin)


def _named(message: str, tree: dict[str, Any]) -> Keys:
    """The path of the block, or of the option, that a message is about."""
    for key, value in tree.get("run", {}).items():
        if f"'{value}'" in message or message.startswith((f"{key}:", f"option {key}:")):
            return ("run", key)
    for name in message.split("'")[1::2]:
        path: Keys = ()
        inside = tree
        for part in name.split("."):
            block = inside.get("blocks", {}).get(part)
            if block is None:
                break
            path = (*path, "blocks", part)
            system = block.get("system")
            inside = tree.get("systems", {}).get(system, {}) if system else {}
            if system:
                return path
        if path:
            return path
    return ("blocks",) if "blocks" in tree else ()
