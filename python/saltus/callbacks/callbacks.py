"""The Python functions of a system, and the traces of them."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from saltus import _core
from saltus.callbacks.explanation import Explanation, explained
from saltus.callbacks.function import Block, core_trace, outcome_of
from saltus.callbacks.plans import Plans
from saltus.callbacks.search import Found, Others, Place, search

__all__ = ["Callbacks", "Others"]


def _nothing_changes() -> bool:
    """The `Glance` at a system without functions of Python."""
    return False


class Callbacks:
    """The Python functions of a system, their traces, and whether the traces are still right.

    The functions are traced while the first plan of the system is made, because the shapes of all
    inputs are known then. The Python object of the system owns this object. So this object holds no
    block and no function: they would keep each other alive.
    """

    def __init__(self, system: Any):
        self.traces = _core.Traces(system)
        self.version = 0
        self.plans = Plans()
        self.outcomes: dict[int, list[Any]] = {}  # the functions of each block, by its number
        self._runs: dict[int, list[_core.Trace | None]] = {}  # the traces that the engine runs
        self._found = Found()  # what the last search for writers found
        self._siblings: Any = None  # while functions are traced
        self._glance: Callable[[], bool] | None = None  # whether anything may have changed
        self._values: Callable[[], bool] | None = None  # whether a value that was read has changed
        self._traces = self._calls = False  # whether a function is traced, and whether one is not

    def trace_block(self, number: int, block: Block) -> list[_core.Trace]:
        """Trace the functions of a block, which the engine calls for while it makes a plan."""
        functions = block["functions"]
        trace = self._tracer()
        outcomes = [outcome_of(block, function, trace) for function in functions]
        known = number in self.outcomes
        self.outcomes[number] = outcomes
        self._found = Found({}, self._found.sharing)
        self._glance = self._values = None
        if known:
            self._note_ways()
        else:  # one look at each block: a diagram may have ten thousand
            self._add_ways(outcomes)
        self._runs[number] = [
            core_trace(block, f, o) for f, o in zip(functions, outcomes, strict=True)
        ]
        return self._core_traces(number)

    def refresh(self, others: Others = ()) -> int:
        """Trace again the functions that read something that has changed; returns the version.

        `others` are functions that the run calls as well.
        """
        if self._glance is not None and not others and not self._glance():
            return self.version
        self.settle(others)
        changed = self._changed()
        if changed:
            trace = self._tracer()
            blocks: list[Block] = self.traces.blocks()
            for b, i in changed:
                self.outcomes[b][i] = outcome_of(blocks[b], blocks[b]["functions"][i], trace)
            self._note_ways()
            self._run_anew(blocks, changed)
            self.settle(others)
        self._glance = self._new_glance(others)
        return self.version

    def settle(self, others: Others = ()) -> bool:
        """Decide to call the functions that read a value which a called function may write. Returns
        whether the decision changed.

        The writes of a run are known only when all functions are traced or refused.
        """
        self._siblings = self._glance = self._values = None
        before, found = self._found, Found()
        if self._calls or others:
            found = search(self.traces.blocks(), self.outcomes, others, self._traces)
        self._found = found
        changed = found.called.keys() ^ before.called.keys()
        if changed:
            self._run_anew(self.traces.blocks(), changed)
        shared = found.sharing != before.sharing
        if shared:
            self._share({*found.sharing, *before.sharing})
        return shared or bool(changed)

    def _share(self, blocks: Iterable[int]) -> None:
        """Gives the engine the functions of these blocks that share values."""
        for number in blocks:
            self.traces.share(number, *self._found.sharing.get(number, ([], [])))
        self.version += 1

    @property
    def all_traced(self) -> bool:
        """Whether no function is called."""
        return not self._calls

    def written(self) -> str | None:
        """The change of a value that a trace of the last run depends on, in words.

        Traced functions write nothing, so nothing is compared if no function is called.
        """
        if not self._calls or (self._values is not None and not self._values()):
            return None
        traced = [(b, i) for b, i in self._watched() if hasattr(self.outcomes[b][i], "tape")]
        changes = (self.outcomes[b][i].dependencies.changed() for b, i in traced)
        return next((change for change in changes if change is not None), None)

    def _note_ways(self) -> None:
        """Whether some function is traced, and whether some was refused or is compiled."""
        self._traces = self._calls = False
        for of_block in self.outcomes.values():
            self._add_ways(of_block)

    def _add_ways(self, outcomes: list[Any]) -> None:
        traced = {hasattr(outcome, "tape") for outcome in outcomes}
        self._traces, self._calls = self._traces or True in traced, self._calls or False in traced

    def _new_glance(self, others: Others) -> Callable[[], bool] | None:
        """None if a search for writers is needed before every run."""
        if not self.outcomes:
            return _nothing_changes
        compiled = any(o is None for of_block in self.outcomes.values() for o in of_block)
        searched = self._calls and bool(self._traces or self._found.sharing)
        if others or (searched and compiled):
            return None
        from saltus import tracing

        outcomes = (o for of_block in self.outcomes.values() for o in of_block if o is not None)
        values = tracing.Glance(outcome.dependencies for outcome in outcomes).changed
        looks = self._found.looks
        self._values = values
        if not looks:
            return values
        return lambda: values() or any(each.changed() for each in looks)

    def _watched(self) -> list[Place]:
        """The functions whose outcome remains right while the values that they read do not
        change.
        """
        return [
            (b, i)
            for b, outcomes in self.outcomes.items()
            for i, outcome in enumerate(outcomes)
            if outcome is not None and (b, i) not in self._found.called
        ]

    def _changed(self) -> list[Place]:
        return [(b, i) for b, i in self._watched() if self.outcomes[b][i].dependencies.changed()]

    def _run_anew(self, blocks: list[Block], places: Iterable[Place]) -> None:
        """Gives the engine other traces of some functions."""
        for b, i in places:
            function = blocks[b]["functions"][i]
            self._runs[b][i] = core_trace(blocks[b], function, self._outcome(b, i))
        for b in {b for b, _ in places}:
            self.traces.set(b, self._core_traces(b))
        self.version += 1

    def _outcome(self, b: int, i: int) -> Any:
        """How a function runs: by its own outcome, or as a call although it could be traced."""
        return self._found.called.get((b, i), self.outcomes[b][i])

    def explain(self, note: str = "") -> Explanation:
        """How each callback runs."""
        callbacks = [
            explained(block, function, self._outcome(number, i))
            for number, block in enumerate(self.traces.blocks())
            for i, function in enumerate(block["functions"])
        ]
        if not callbacks:
            note = note or "no callback is a Python function: all of it runs compiled"
        return Explanation(callbacks, note)

    def _tracer(self) -> Callable[[Any], Any]:
        """Traces a function. Functions of one code are traced once, until `settle`."""
        from saltus import tracing  # imported only when there is something to trace

        self._siblings = self._siblings or tracing.Siblings()
        trace: Callable[[Any], Any] = self._siblings.trace
        return trace

    def _core_traces(self, number: int) -> list[_core.Trace]:
        return [trace for trace in self._runs[number] if trace is not None]
