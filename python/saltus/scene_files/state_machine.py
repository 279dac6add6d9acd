"""A state machine of the table of a scene: its conditions, actions and outputs are expressions."""

from __future__ import annotations

import ast
import dataclasses
from collections.abc import Callable
from typing import Any

from saltus.library import StateMachine, Transition
from saltus.library.by_name import FIRST
from saltus.scene_files.evaluation import evaluated
from saltus.scene_files.expression import expression
from saltus.scene_files.functions import function_of, number_of
from saltus.scene_files.moving import (
    ALWAYS,
    NEVER,
    Doubt,
    Motions,
    doubts_of,
    motion_of,
    require_a_change,
)
from saltus.scene_files.names import chosen, require_part_name, require_word, text_at
from saltus.scene_files.words import Word
from saltus.scene_files.wrong import Path, Wrong, found, placed, require_keys, table_at
from saltus.system import System

__all__ = ["SceneMachine", "state_machine"]

TRANSITION_KEYS = tuple(each.name for each in dataclasses.fields(Transition))
ACTION = "{ visits = 'visits + 1' }"
OWN = {"since": "time since the active state was entered", "np": "word of expressions"}
"""names that the block itself gives a meaning to"""


class SceneMachine(StateMachine):
    """A state machine whose expressions are in a scene file."""

    motions: Motions
    """what moves each output between events"""
    doubts: tuple[Doubt, ...] = ()
    """the equalities in its conditions that depend on what its inputs are"""
    structural: dict[str, str]
    """the parameters in its expressions that are in numbers of the block too, and where"""
    fixed: frozenset[str]
    """the parameters of the system in numbers of the block, as the time of a transition"""
    read: frozenset[str]
    """the parameters of the system in its expressions"""
    held: dict[str, int]
    """the variables, by name, and their positions in the discrete state"""


def state_machine(path: Path, table: dict[str, Any], name: str, values: dict[str, Any]) -> System:
    """The block of a table. Wrong for a mistake in it."""
    return _Reader(path, table, values).machine(name)


class _Reader:
    def __init__(self, path: Path, table: dict[str, Any], values: dict[str, Any]):
        self.path, self.table = path, table
        self.structural: dict[str, str] = {}
        self.taken = dict(OWN)
        self.words = {"t": Word("time"), "since": Word("since"), "state": Word("state")}
        self.arguments = {"t": "time", "since": "since", "state": "state"}
        self.read: set[str] = set()
        self.parameters = self.numbers("parameters", values)
        self.add_parameters(values | self.parameters)
        self.states = self.names("states")
        for position, state in enumerate(self.states):
            self.add(("states", position), state, "state", Word(str(position), choice_of="state"))
        self.inputs = self.names("inputs")
        for position, each in enumerate(self.inputs):
            self.add_value(("inputs", position), each, "input")
        self.variables = self.numbers("variables", values | self.parameters)
        for each in self.variables:
            self.add_value(("variables", each), each, "variable")

        self.motions = {"t": ALWAYS, "since": ALWAYS} | {u: frozenset({u}) for u in self.inputs}
        self.doubts: list[Doubt] = []
        self.outputs: dict[str, frozenset[str]] = {}

    def machine(self, name: str) -> SceneMachine:
        transitions = [self.transition(*each) for each in self.entries("transitions")]
        actions = {what: self.actions(what) for what in ("entry", "exit")}
        outputs = {
            output: self.output((*self.path, "outputs", output), output, value)
            for output, value in self.tables("outputs", "{ open = 'state == open' }").items()
        }
        initial = self.table.get("initial")
        if initial is not None:
            chosen((*self.path, "initial"), initial, self.states, "state")
        numbers = self.parameters | {each: self.values[each] for each in self.read}
        with placed(self.path):
            made = SceneMachine(
                self.states,
                transitions,
                inputs=self.inputs,
                variables=self.variables,
                outputs=outputs,
                parameters=numbers,
                initial=initial,
                name=name,
                **actions,
            )
        made.motions, made.doubts = self.outputs, tuple(self.doubts)
        made.structural = {name: key for name, key in self.structural.items() if name in numbers}
        lists = {name for name, value in self.values.items() if isinstance(value, list)}
        made.fixed, made.read = (
            frozenset({*self.structural, *lists, *self.parameters}),
            frozenset(self.read),
        )
        made.held = {name: i for i, name in enumerate(self.variables, FIRST)}
        return made

    def names(self, key: str) -> list[str]:
        path, given = (*self.path, key), self.table.get(key, [])
        if not isinstance(given, list):
            raise Wrong(path, f"expected a list such as ['open', 'closed'], found {found(given)}")
        return [text_at((*path, i), each, "open") for i, each in enumerate(given)]

    def numbers(self, key: str, values: dict[str, Any]) -> dict[str, float]:
        path = (*self.path, key)
        return {
            name: number_of((*path, name), value, values, self.structural)
            for name, value in self.tables(key, "{ visits = 0 }").items()
        }

    def tables(self, key: str, example: str) -> dict[str, Any]:
        return table_at((*self.path, key), self.table.get(key, {}), example)

    def entries(self, key: str) -> list[tuple[Path, dict[str, Any]]]:
        path, given = (*self.path, key), self.table[key]
        if not isinstance(given, list):
            raise Wrong(path, f"expected a list of tables, found {found(given)}")
        example = "{ source = 'closed', target = 'open', trigger = 'call > 0.5' }"
        return [((*path, i), table_at((*path, i), each, example)) for i, each in enumerate(given)]

    def add_parameters(self, values: dict[str, Any]) -> None:
        """A number is a parameter of the block if an expression reads it; a list is a constant."""
        self.values = values
        for name, value in values.items():
            self.taken[name] = "parameter"
            if isinstance(value, list):
                self.words[name] = Word(f"{value!r}".replace("inf", "np.inf"), len(value))
            else:
                self.words[name], self.arguments[name] = Word(name), name

    def add(self, at: Path, name: str, what: str, word: Word) -> None:
        require_word((*self.path, *at), name, self.taken, what)
        self.taken[name], self.words[name] = what, word

    def add_value(self, at: Path, name: str, what: str) -> None:
        self.add(at, name, what, Word(name))
        self.arguments[name] = name

    def function(self, texts: dict[Path, Any], body: Callable[..., ast.expr]) -> Any:
        """A function with the names that some expressions read; it returns `body(*trees)`."""
        made = [expression(path, text, self.words) for path, text in texts.items()]
        for (path, text), each in zip(texts.items(), made, strict=True):
            evaluated(path, text, each.tree, {}, whole=False)
        names = set().union(*(each.names for each in made))
        self.read |= names & self.values.keys() & self.arguments.keys()
        arguments = sorted(self.arguments[name] for name in names & self.arguments.keys())
        return function_of(arguments, body(*(each.tree for each in made)))

    def value(self, path: Path, text: Any) -> Any:
        return self.function({path: text}, lambda tree: tree)

    def truth(self, path: Path, text: Any) -> Any:
        made = expression(path, text, self.words)
        if not made.boolean:
            raise Wrong(path, f"expected a truth such as 'call > 0.5', found {found(text)}")
        self.doubts += doubts_of(path, made, self.motions, {})
        return self.value(path, text)

    def trigger(self, path: Path, text: Any) -> Any:
        """A truth that fires where it becomes true."""
        value = self.truth(path, text)
        changing = frozenset({"t", "since", "state", *self.inputs, *self.variables})
        require_a_change(path, expression(path, text, self.words), changing)
        return value

    def action(self, path: Path, changes: Any) -> Any:
        """The new values of variables, by their names; all of them read those before the action."""
        changes = table_at(path, changes, ACTION)
        for name in changes:
            chosen((*path, name), name, self.variables, "variable")
        keys: list[ast.expr | None] = [ast.Constant(name) for name in changes]
        texts = {(*path, name): text for name, text in changes.items()}
        return self.function(texts, lambda *trees: ast.Dict(keys, list(trees)))

    def actions(self, what: str) -> dict[str, Any]:
        path = (*self.path, what)
        given = self.tables(what, f"{{ open = {ACTION} }}")
        return {
            chosen((*path, state), state, self.states, "state"): self.action((*path, state), each)
            for state, each in given.items()
        }

    def output(self, path: Path, name: str, value: Any) -> Any:
        require_part_name(path, name, "output")
        if not isinstance(value, dict):
            node = expression(path, value, self.words).node
            self.outputs[name] = NEVER if node is None else motion_of(node, self.motions)
            return self.value(path, value)
        return {
            chosen((*path, state), state, self.states, "state"): number_of(
                (*path, state), each, self.values, self.structural
            )
            for state, each in value.items()
        }

    def transition(self, path: Path, table: dict[str, Any]) -> Transition:
        require_keys(path, table, TRANSITION_KEYS, ("source", "target"))
        readers: dict[str, Callable[[Path, Any], Any]] = {
            "source": self.state,
            "target": self.state,
            "guard": self.truth,
            "trigger": self.trigger,
            "after": self.number,
            "action": self.action,
            "priority": self.number,
            "name": lambda at, value: text_at(at, value, "opens"),
        }
        return Transition(**{key: readers[key]((*path, key), table[key]) for key in table})

    def state(self, path: Path, value: Any) -> str:
        return chosen(path, value, self.states, "state")

    def number(self, path: Path, value: Any) -> float:
        return number_of(path, value, self.values, self.structural)
