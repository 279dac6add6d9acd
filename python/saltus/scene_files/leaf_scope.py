"""The meanings of the names in the expressions of a leaf."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from typing import Any

from saltus.scene_files.evaluation import evaluated
from saltus.scene_files.expression import Expression, expression
from saltus.scene_files.functions import function_of
from saltus.scene_files.moving import (
    ALWAYS,
    NEVER,
    Doubt,
    doubts_of,
    motion_of,
    require_a_change,
)
from saltus.scene_files.names import named_vector, require_word
from saltus.scene_files.vocabulary import ON_ZENO
from saltus.scene_files.words import Word
from saltus.scene_files.wrong import Path, Wrong, found

__all__ = ["WEIGHT", "LeafScope"]

WEIGHT = "weight"
"""the word for the weight of an event wire"""
ENTRY = "entry"
"""the word for the entry of an event input to which a wire leads"""


@dataclass
class LeafScope:
    """The names of a leaf: its states, modes, inputs and parameters, and the time."""

    states: list[str] = field(default_factory=list)
    discrete: list[str] = field(default_factory=list)
    modes: list[str] = field(default_factory=list)
    inputs: dict[str, int | None] = field(default_factory=dict)
    """the width of each name; None for a number"""
    parameters: dict[str, Any] = field(default_factory=dict)
    taken: dict[str, str] = field(default_factory=dict)
    words: dict[str, Word] = field(default_factory=dict)
    variables: dict[str, Expression] = field(default_factory=dict)
    read: set[str] = field(default_factory=set)
    """the parameters that some expression reads"""
    motions: dict[str, frozenset[str]] = field(default_factory=dict)
    """what moves each name between events"""
    made: list[tuple[Path, Any, Expression]] = field(default_factory=list)
    """the expressions whose parts of parameters alone were computed, with their keys and texts"""

    def add(self, path: Path, name: str, what: str, word: Word) -> None:
        require_word(path, name, self.taken, what)
        self.taken[name] = what
        self.words[name] = word

    def add_table(self, path: Path, table: dict[str, Any]) -> None:
        """The names that the table of a leaf declares."""
        self.words["t"], self.motions["t"] = Word("time"), ALWAYS
        for name, value in self.parameters.items():
            nested = isinstance(value, list)
            self.taken[name] = "parameter"
            self.words[name] = Word(f"p['{name}']", len(value) if nested else None)
        for what, names, attribute in (
            ("states", self.states, "continuous_state"),
            ("discrete", self.discrete, "discrete_state"),
        ):
            for i, name in enumerate(table.get(what, {})):
                self.add((*path, what, name), name, "state", Word(f"state.{attribute}[{i}]"))
                names.append(name)
                if what == "states" and _has_rate(table[what][name]):
                    self.motions[name] = ALWAYS
        self._add_modes((*path, "modes"), table.get("modes", []))
        self._add_inputs((*path, "inputs"), table.get("inputs", []))
        for name, text in table.get("variables", {}).items():
            at = (*path, "variables", name)
            made = self.expression(at, text)
            self.add(at, name, "variable", Word(f"v_{name}", truth=made.boolean))
            self.variables[name] = made
            self.motions[name] = self.motion_of(made)

    def _add_modes(self, path: Path, names: Any) -> None:
        if not isinstance(names, list):
            raise Wrong(path, f"expected a list such as ['on', 'off'], found {found(names)}")
        for i, name in enumerate(names):
            if not isinstance(name, str):
                raise Wrong((*path, i), f"expected the name of a mode, found {found(name)}")
            if name in ON_ZENO:
                raise Wrong((*path, i), f"'{name}' is a word of on_zeno; expected another name")
            self.add((*path, i), name, "mode", Word(str(i), choice_of="mode"))
            self.modes.append(name)
        if names:
            self.words["mode"] = Word("state.mode")

    def _add_inputs(self, path: Path, names: Any) -> None:
        if not isinstance(names, list):
            raise Wrong(path, f"expected a list of names such as ['u', 'v'], found {found(names)}")
        for i, text in enumerate(names):
            name, size = named_vector((*path, i), text)
            self.add((*path, i), name, "input", Word(f"u_{name}", size))
            self.inputs[name] = size
            self.motions[name] = frozenset({name})

    def motion_of(self, made: Expression) -> frozenset[str]:
        """What moves the value of an expression between events."""
        return NEVER if made.node is None else motion_of(made.node, self.motions)

    def guard(self, path: Path, text: Any, waits: bool) -> tuple[Expression, list[Doubt]]:
        """The expression of a guard, and what it compares by ==. Wrong if it never fires; one that
        `waits` for no zero may be a constant.
        """
        made = self.expression(path, text)
        if waits:
            parts = {*self.states, *self.discrete, *self.inputs, "t", "mode"}
            require_a_change(path, made, frozenset(parts - set(self.parameters)))
        return made, doubts_of(path, made, self.motions, self.variables)

    def expression(self, path: Path, text: Any) -> Expression:
        made = expression(path, text, self.words)
        if path[-2:-1] != ("variables",):  # a variable may be read in one branch alone
            evaluated(path, text, made.tree, self.parameters, whole=False)
            self.made.append((path, text, made))
        behind = (self.variables[name].names for name in made.names & self.variables.keys())
        made = replace(made, names=made.names.union(*behind))
        self.read |= made.names & self.parameters.keys()
        return made

    def inputs_of(self, expressions: Iterable[Expression]) -> list[int]:
        """The positions of the inputs that some of these expressions read."""
        names = frozenset().union(*(each.names for each in expressions))
        return [i for i, name in enumerate(self.inputs) if name in names]

    @contextmanager
    def with_delivery(self, path: Path, entries: bool) -> Iterator[None]:
        """Inside of it expressions read `weight`, that of the event wire of a delivery, and with
        `entries` also `entry`, the position of the entry to which the wire leads. Wrong if the leaf
        gives such a name another meaning.
        """
        words = {WEIGHT: Word(WEIGHT)} | ({ENTRY: Word("state.entry")} if entries else {})
        for name in words:
            if name in self.taken:
                raise Wrong(
                    path,
                    f"'{name}' is that of the event wire in 'event_inputs'; choose another name "
                    f"for the {self.taken[name]} '{name}'",
                )
        self.words.update(words)
        yield
        for name in words:
            del self.words[name]

    def function(
        self,
        body: Any,
        inputs: Sequence[int],
        read: Iterable[Expression],
        more: Sequence[str] = (),
    ) -> Any:
        """A callback with these inputs, and `more` arguments after them, that returns `body`,
        which is made of expressions.
        """
        names = list(self.inputs)
        needed = frozenset().union(*(each.names for each in read))
        before = [(f"v_{n}", each.tree) for n, each in self.variables.items() if n in needed]
        arguments = ["time", "state", *(f"u_{names[i]}" for i in inputs), *more]
        return function_of(arguments, body, "p", before)

    def rates_of(self, expressions: Iterable[Expression]) -> list[str]:
        """The values that an output of these expressions depends on, in the words of the
        declaration.
        """
        names = frozenset().union(*(each.names for each in expressions))
        parts = {
            "time": {"t"},
            "continuous_state": set(self.states),
            "discrete_state": set(self.discrete),
            "mode": {"mode"},
            "inputs": set(self.inputs),
        }
        return [what for what, of in parts.items() if names & of]


def _has_rate(state: Any) -> bool:
    """Whether a state may change between events; one without a rate is held."""
    rate = state.get("rate", 0.0) if isinstance(state, dict) else 0.0
    if isinstance(rate, str):
        try:
            return float(rate) != 0.0
        except ValueError:
            return True
    return bool(rate)
