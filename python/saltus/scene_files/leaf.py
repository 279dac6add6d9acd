"""A leaf system of the table of a scene: every expression becomes a callback that is traced."""

from __future__ import annotations

import ast
import math
from typing import Any

from saltus.leaf_system import LeafSystem
from saltus.scene_files.expression import Expression, template
from saltus.scene_files.functions import list_of, number_of
from saltus.scene_files.leaf_scope import WEIGHT, LeafScope
from saltus.scene_files.moving import ALWAYS, NEVER, Doubt, Motions
from saltus.scene_files.names import (
    chosen,
    require_part_name,
    require_texts,
    truth_at,
    whole_at,
)
from saltus.scene_files.vocabulary import ON_ZENO
from saltus.scene_files.wrong import Path, Wrong, placed, require_keys, table_at

__all__ = ["LEAF_KEYS", "SceneLeaf", "leaf_of"]

LEAF_KEYS = (
    "states", "discrete", "modes", "mode", "inputs", "variables", "outputs", "guards", "edges",
    "updates", "event_inputs",
)  # fmt: skip
GUARD_KEYS = (
    "guard", "direction", "from", "to", "set", "terminal", "max_count", "zeno_tolerance",
    "at_start", "on_zeno", "delay", "priority", "persistent", "initial_value",
    "use_values_from_trigger_time",
)  # fmt: skip
TABLES = tuple(key for key in LEAF_KEYS if key not in ("modes", "mode", "inputs"))
QUEUE_TRUTHS = ("persistent", "initial_value", "use_values_from_trigger_time")
UPDATE_KEYS = ("period", "offset", "at", "end", "count", "set")
DIRECTIONS = (
    "crosses_zero", "both", "positive_then_non_positive", "falling", "negative_then_non_negative",
    "rising", "edge_detection", "none",
)  # fmt: skip

AT_START = ("auto", "ignore", "fire", "error")

OTHER = ("x", "z", "mode")
"""names that mean something else in a context"""


class SceneLeaf(LeafSystem):
    """A block whose equations are in a scene file."""

    shown: tuple[str, ...] = ()
    """the outputs that the file names, which are recorded by default"""
    motions: Motions
    """what moves each output between events"""
    doubts: tuple[Doubt, ...] = ()
    """the equalities in its guards that depend on what its inputs are"""
    structural: dict[str, str]
    """the parameters in its equations that are in numbers of the block too, and where"""
    path: Path
    """the keys of its table"""
    fixed: frozenset[str]
    """the parameters in numbers of the block that are no starts of states, as a period"""
    read: frozenset[str]
    """the parameters in its equations"""
    expressions: list[tuple[Path, Any, Expression]]
    """the expressions of its equations, with their keys and texts"""
    state_names: list[str]
    """the names of the continuous states in a context; none if they are `x[0]`, ... there"""
    starts: list[tuple[Path, Any]]
    """the starts of the continuous states: keys and texts"""
    held_starts: list[tuple[Path, Any]]
    """the starts of the discrete states: keys and texts"""
    states: tuple[str, ...]
    """the names of the continuous states"""
    held: dict[str, int]
    """the discrete states, by name, and their positions"""
    held_outputs: tuple[str, ...] = ()
    """the outputs that show a discrete state or the mode, and that the file does not name"""
    last: list[tuple[Path, float]]
    """[s] the last time of each of its updates that ends, and the key that says it"""


def leaf_of(path: Path, table: dict[str, Any], name: str, parameters: dict[str, Any]) -> SceneLeaf:
    """The system of a table. Wrong for a mistake in it."""
    for key in TABLES:
        table_at((*path, key), table.get(key, {}), "{ name = ... }")
    scope = LeafScope(parameters=parameters)
    scope.add_table(path, table)
    maker = _Maker(path, table, name, scope)
    maker.declare()
    return maker.leaf


class _Maker:
    def __init__(self, path: Path, table: dict[str, Any], name: str, scope: LeafScope):
        self.path, self.table, self.scope = path, table, scope
        self.leaf = SceneLeaf(name=name)
        self.leaf.path = path
        self.leaf.shown = tuple(table.get("outputs", {}))
        self.motions = {name: ALWAYS for name in scope.states if name in scope.motions}
        self.leaf.motions = self.motions
        self.leaf.held = {name: i for i, name in enumerate(scope.discrete)}
        self.leaf.last, self.leaf.states = [], tuple(scope.states)
        self.structural: dict[str, str] = {}
        self.started: dict[str, str] = {}

    def declare(self) -> None:
        for name, size in self.scope.inputs.items():
            with placed((*self.path, "inputs")):
                self.leaf.declare_input_port(name, shape=() if size is None else size)
        self.states()
        self.modes()
        for what, declare in (
            ("outputs", self.output),
            ("guards", self.guard),
            ("edges", self.edge),
            ("updates", self.update),
            ("event_inputs", self.event_input),
        ):
            for name, value in self.table.get(what, {}).items():
                path = (*self.path, what, name)
                require_part_name(path, name, what[:-1].replace("_", " "))
                with placed(path):
                    declare(path, name, value)
        self.held_outputs()
        for name, value in self.scope.parameters.items():
            if name in self.scope.read:
                with placed((*self.path, "parameters", name)):
                    self.leaf.declare_dynamic_parameter(name, value)
        read = self.scope.read
        keys = self.started | self.structural
        self.leaf.structural = {name: key for name, key in keys.items() if name in read}
        self.leaf.fixed, self.leaf.read = frozenset(self.structural), frozenset(read)
        self.leaf.expressions = self.scope.made

    def states(self) -> None:
        starts: list[tuple[Path, Any]] = []
        rates, units = [], []
        for name, value in self.table.get("states", {}).items():
            path = (*self.path, "states", name)
            value = table_at(path, value, "{ start = 1.0, rate = '-k * x' }")
            require_keys(path, value, ("start", "rate", "unit", "description"))
            require_texts(path, value)
            starts.append(((*path, "start"), value.get("start", 0.0)))
            units.append(value.get("unit", ""))
            rates.append(self.scope.expression((*path, "rate"), value.get("rate", 0.0)))
        self.leaf.starts, self.leaf.state_names = starts, []
        if starts:
            inputs = self.scope.inputs_of(rates)
            ode = self.scope.function(list_of(rates), inputs, rates)
            self.leaf.state_names = self.state_names()
            numbers = [self.start(*each) for each in starts]
            with placed((*self.path, "states")):
                self.leaf.declare_continuous_state(
                    numbers, ode=ode, requires_inputs=inputs, names=self.leaf.state_names,
                    units=units if any(units) else (),
                )  # fmt: skip
        path = (*self.path, "discrete")
        held = [((*path, name), value) for name, value in self.table.get("discrete", {}).items()]
        self.leaf.held_starts = held
        if held:
            values = [self.start(*each) for each in held]
            with placed((*self.path, "discrete")):
                self.leaf.declare_discrete_state(values)

    def state_names(self) -> list[str]:
        """The names of the states, which are outputs and values of a context; none if a state
        cannot have its name there, or if the file has another output with the name of a state.
        """
        outputs = self.table.get("outputs", {})
        names = list(self.table["states"])
        free = all(name not in OTHER and outputs.get(name, name) == name for name in names)
        return names if free else []

    def modes(self) -> None:
        if "mode" not in self.table and not self.scope.modes:
            return
        path = (*self.path, "mode")
        if not self.scope.modes:
            raise Wrong(path, "expected a list of 'modes' beside the mode at the start")
        start = self.mode(path, self.table.get("mode", self.scope.modes[0]))
        self.leaf.declare_default_mode(start, names=self.scope.modes)

    def mode(self, path: Path, value: Any) -> int:
        return self.scope.modes.index(chosen(path, value, self.scope.modes, "mode"))

    def start(self, path: Path, value: Any) -> float:
        return number_of(path, value, self.scope.parameters, self.started)

    def number(self, path: Path, value: Any) -> float:
        return number_of(path, value, self.scope.parameters, self.structural)

    def output(self, path: Path, name: str, value: Any) -> None:
        if name in self.leaf.output_names:
            return  # a state that shows itself
        many = isinstance(value, list)
        texts = [((*path, i), text) for i, text in enumerate(value)] if many else [(path, value)]
        parts = [self.scope.expression(place, text) for place, text in texts]
        inputs = self.scope.inputs_of(parts)
        moved = [self.scope.motion_of(part) for part in parts]
        self.motions[name] = frozenset.intersection(*moved) if moved else NEVER
        self.leaf.declare_output_port(
            self.scope.function(list_of(parts) if many else parts[0].tree, inputs, parts),
            name=name,
            requires_inputs=inputs,
            shape=len(parts) if many else (),
            boolean=not many and parts[0].boolean,
            reads=self.scope.rates_of(parts),
        )

    def held_outputs(self) -> None:
        """The outputs that show a discrete state, the mode, and whether it is that of a name, for
        whoever records them. An output of the file with such a name stays what it is.
        """
        shown = set(self.leaf.output_names)
        held = [(name, name, "discrete_state", False) for name in self.scope.discrete]
        held += [(name, f"mode == {name}", "mode", True) for name in self.scope.modes]
        for name, text, read, truth in held:
            if name not in shown:
                made = self.scope.expression((*self.path, name), text)
                self.leaf.declare_output_port(
                    self.scope.function(made.tree, (), [made]),
                    name=name,
                    requires_inputs=(),
                    shape=(),
                    boolean=truth,
                    reads=[read],
                )
        if self.scope.modes and "mode" not in shown:
            self.leaf.declare_mode_output("mode")
        self.leaf.held_outputs = tuple(n for n in self.leaf.output_names if n not in shown)

    def guard(self, path: Path, name: str, value: Any) -> None:
        value = table_at(path, value, "{ guard = 'y', direction = 'falling' }")
        require_keys(path, value, GUARD_KEYS, ("guard",))
        waits = value.get("at_start", "auto") in ("auto", "ignore")
        waits = waits and value.get("initial_value") is not False  # else it fires at the start
        guard, doubts = self.scope.guard((*path, "guard"), value["guard"], waits)
        self.leaf.doubts += tuple(doubts)
        effect, read = self.effect(path, value)
        queue = {
            key: self.scope.expression((*path, key), value[key])
            for key in ("delay", "priority")
            if key in value
        }
        inputs = self.scope.inputs_of([guard, *read, *queue.values()])
        direction = value.get("direction", "crosses_zero")
        self.leaf.declare_zero_crossing(
            self.scope.function(guard.tree, inputs, [guard]),
            None if effect is None else self.scope.function(effect, inputs, read),
            name=name,
            direction=chosen((*path, "direction"), direction, DIRECTIONS, "direction"),
            requires_inputs=inputs,
            **{
                key: self.queued((*path, key), value[key], each, inputs)
                for key, each in queue.items()
            },
            **self.guard_options(path, value),
        )

    def queued(self, path: Path, value: Any, made: Expression, inputs: list[int]) -> Any:
        """A delay or a priority: a number, or a function."""
        if isinstance(value, str):
            return self.scope.function(made.tree, inputs, [made])
        return self.number(path, value)

    def guard_options(self, path: Path, value: dict[str, Any]) -> dict[str, Any]:
        """The options of a zero crossing, as its declaration calls them."""
        if "to" in value and "mode" in value.get("set", {}):
            raise Wrong((*path, "to"), "the mode is set already; keep one of 'to' and 'set.mode'")
        names = ("terminal", "max_count", "at_start", "on_zeno", *QUEUE_TRUTHS)
        options: dict[str, Any] = {name: value[name] for name in names if name in value}
        for name in ("terminal", *QUEUE_TRUTHS):
            truth_at((*path, name), value.get(name, True))
        if "max_count" in value:
            whole_at((*path, "max_count"), value["max_count"])
        if "at_start" in value:
            chosen((*path, "at_start"), value["at_start"], AT_START, "choice")
        if "on_zeno" in value:
            chosen((*path, "on_zeno"), value["on_zeno"], [*ON_ZENO, *self.scope.modes], "choice")
        if options.get("on_zeno") in self.scope.modes:
            options["on_zeno"] = self.mode((*path, "on_zeno"), options["on_zeno"])
        if "zeno_tolerance" in value:
            at = (*path, "zeno_tolerance")
            options["zeno_tolerance"] = self.number(at, value["zeno_tolerance"])
        for key, option in (("from", "start_mode"), ("to", "end_mode")):
            if key in value:
                options[option] = self.mode((*path, key), value[key])
        return options

    def edge(self, path: Path, name: str, value: Any) -> None:
        value = table_at(path, value, "{ input = 'trigger', set = { x = 0 } }")
        require_keys(path, value, ("input", "edge", "set"), ("input", "set"))
        effect, read = self.effect(path, value)
        inputs = self.scope.inputs_of(read)
        names = list(self.scope.inputs)
        self.leaf.declare_edge_reset(
            self.scope.function(effect, inputs, read),
            input=names.index(chosen((*path, "input"), value["input"], names, "input")),
            edge=value.get("edge", "rising"),
            name=name,
            requires_inputs=inputs,
        )

    def event_input(self, path: Path, name: str, value: Any) -> None:
        value = table_at(path, value, "{ set = { v = 'v + weight' } }")
        require_keys(path, value, ("set", "size"), ("set",))
        size = whole_at((*path, "size"), value.get("size", 1))
        with self.scope.with_delivery(path, "size" in value):
            effect, read = self.effect(path, value)
        inputs = self.scope.inputs_of(read)
        self.leaf.declare_event_input(
            self.scope.function(effect, inputs, read, (WEIGHT,)),
            name=name,
            size=size,
            requires_inputs=inputs,
        )

    def update(self, path: Path, name: str, value: Any) -> None:
        value = table_at(path, value, "{ period = 0.1, set = { k = 'k + 1' } }")
        require_keys(path, value, UPDATE_KEYS, ("set",))
        if not {"period", "offset", "at"} & value.keys():
            raise Wrong(path, "expected times: a 'period', an 'offset', or times 'at', in seconds")
        effect, read = self.effect(path, value)
        callback = self.scope.function(effect, range(len(self.scope.inputs)), read)
        count = value.get("count")
        if count is not None:
            whole_at((*path, "count"), count)
        times = {
            key: self.number((*path, key), value[key])
            for key in ("period", "offset", "end")
            if key in value
        }
        if (
            times.keys() <= {"period", "offset"}
            and "period" in times
            and len(value) == len(times) + 1
        ):
            self.leaf.declare_periodic_update(callback, name=name, **times)
            return
        at = self.times((*path, "at"), value["at"]) if "at" in value else None
        if at is not None or "end" in times:
            key = "at" if at is not None else "end"
            last = min(max(at or [math.inf]), times.get("end", math.inf))
            self.leaf.last.append(((*path, key), last))
        self.leaf.declare_time_event(callback, times=at, count=count, name=name, **times)

    def times(self, path: Path, value: Any) -> list[float]:
        """One time, or a list of times."""
        if not isinstance(value, list):
            return [self.number(path, value)]
        if not value:
            raise Wrong(path, "expected times [s] such as [1.0, 2.5], found an empty list")
        return [self.number((*path, i), time) for i, time in enumerate(value)]

    def effect(self, path: Path, value: dict[str, Any]) -> tuple[ast.expr | None, list[Expression]]:
        """The state after an event, and its expressions. All of them read the state before the
        event.
        """
        path = (*path, "set")
        if "set" not in value:
            return None, []
        assigned = table_at(path, value["set"], "{ v = '-e * v' }")
        names = [*self.scope.states, *self.scope.discrete, *(["mode"] if self.scope.modes else [])]
        if not assigned:
            raise Wrong(path, "expected a state and its new value, such as { v = '-e * v' }")
        for name in assigned:
            chosen((*path, name), name, names, "state")
        made = {
            name: self.scope.expression((*path, name), text)
            for name, text in assigned.items()
            if name != "mode"
        }
        after: ast.expr = template("state")
        for states, method in (
            (self.scope.states, "continuous"),
            (self.scope.discrete, "discrete"),
        ):
            if any(name in made for name in states):
                after = _with(after, f"with_{method}_state", self.all_of(states, made))
        if "mode" in assigned:
            mode = self.mode((*path, "mode"), assigned["mode"])
            after = _with(after, "with_mode", ast.Constant(mode))
        return after, list(made.values())

    def all_of(self, states: list[str], made: dict[str, Expression]) -> ast.expr:
        words = self.scope.words
        return ast.List(
            [made[n].tree if n in made else template(words[n].code) for n in states], ast.Load()
        )


def _with(state: ast.expr, method: str, value: ast.expr) -> ast.expr:
    return ast.Call(ast.Attribute(state, method, ast.Load()), [value], [])
