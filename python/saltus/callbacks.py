"""How each Python callback of a system runs: called, traced or compiled, and why."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any, NamedTuple, TypeVar

from saltus import _core
from saltus.errors import ModelError

__all__ = ["ExplainedCallback", "Explanation"]

Made = TypeVar("Made")
Block = dict[str, Any]  # the facts of a block, or of a function of it
Place = tuple[int, int]  # the numbers of a block and of a function of it
Others = Sequence[tuple[str, Any]]  # functions that are no callbacks of a block, with words

KINDS = {"jacobian": "matrix", "reset_map": "reset", "edge_reset": "reset", "update": "update"}
"""role of a function -> the tracer's word for it; the others return a vector"""

GUARDS = {"guard", "relation"}
"""roles of functions whose sign matters: a comparison gives its smooth difference"""


class ExplainedCallback(NamedTuple):
    """How one callback runs.

    Examples
    --------
    >>> block = saltus.library.FunctionBlock(lambda u: 2.0 * u, name="twice")
    >>> callback = block.explain()[0]
    >>> callback.block, callback.callback, callback.runs
    ('twice', "output 'out'", 'traced')
    """

    block: str
    """path of the block"""
    callback: str
    """such as "ode" or "guard of 'bounce'\""""
    runs: str
    """'called', 'traced' or 'compiled'"""
    reason: str
    """why it is called; empty for a traced or compiled one"""

    @property
    def rung(self) -> str:
        """The former name of `runs`."""
        return self.runs


class Explanation(tuple[ExplainedCallback, ...]):
    """How all Python callbacks of a system run; its text has one line for each.

    Examples
    --------
    >>> block = saltus.library.FunctionBlock(lambda u: 2.0 * u, name="twice")
    >>> len(block.explain())
    1
    """

    def __new__(cls, callbacks: Iterable[ExplainedCallback], note: str = "") -> Explanation:
        self = super().__new__(cls, callbacks)
        self.note = note
        return self

    note: str
    """a remark on the whole system, or nothing"""

    def __str__(self) -> str:
        names = [f"{c.block}: {c.callback}" for c in self]
        width = max(map(len, names), default=0)
        lines = [
            f"{name:{width}}  {c.runs}" + (f": {c.reason}" if c.reason else "")
            for name, c in zip(names, self, strict=True)
        ]
        return "\n".join([*lines, *([self.note] if self.note else [])])

    __repr__ = __str__


class Callbacks:
    """The Python functions of a system, the traces of them, and whether these are still right.

    They are traced while the first plan of the system is made, because the shapes of its inputs are
    known then. The Python object of the system owns this object, so it holds no block and no
    function: they would hold each other.
    """

    def __init__(self, system: Any):
        self.traces = _core.Traces(system)
        self.version = 0
        self.outcomes: dict[int, list[Any]] = {}  # of the functions of each block, by its number
        self._runs: dict[int, list[_core.Trace | None]] = {}  # what the engine runs of them
        self._called: dict[Place, Any] = {}  # those that are called all the same, Refused
        self._siblings: Any = None  # while functions are traced

    def trace_block(self, number: int, block: Block) -> list[_core.Trace]:
        """Trace the functions of a block, which the engine calls for while it makes a plan."""
        functions = block["functions"]
        trace = self._tracer()
        outcomes = [_trace(block, function, trace) for function in functions]
        self.outcomes[number] = outcomes
        self._called = {}
        self._runs[number] = [
            _core_trace(block, f, o) for f, o in zip(functions, outcomes, strict=True)
        ]
        return self._core_traces(number)

    def refresh(self, others: Others = ()) -> int:
        """Trace again the functions that read something that has changed; returns the version.

        `others` are functions that the run calls as well.
        """
        self.settle(others)
        changed = self._changed()
        if changed:
            trace = self._tracer()
            blocks: list[Block] = self.traces.blocks()
            for b, i in changed:
                self.outcomes[b][i] = _trace(blocks[b], blocks[b]["functions"][i], trace)
            self._run_anew(blocks, changed)
            self.settle(others)
        return self.version

    def settle(self, others: Others = ()) -> bool:
        """Have those called that read what a called one may write; whether that is another choice.

        Only when all functions are traced or refused is it known what a run may write.
        """
        self._siblings = None
        found = self._readers_of_writes(others)
        changed = found.keys() ^ self._called.keys()
        self._called = found
        if changed:
            self._run_anew(self.traces.blocks(), changed)
        return bool(changed)

    def written(self) -> str | None:
        """A change of a value that a trace of the last run was made from, in words.

        Traced functions write nothing; without called ones nothing is compared.
        """
        if not self._calls:
            return None
        traced = [(b, i) for b, i in self._watched() if hasattr(self.outcomes[b][i], "tape")]
        changes = (self.outcomes[b][i].watch.changed() for b, i in traced)
        return next((change for change in changes if change is not None), None)

    @property
    def _calls(self) -> bool:
        """Whether some function was refused, or is compiled."""
        return any(not hasattr(o, "tape") for of_block in self.outcomes.values() for o in of_block)

    def _readers_of_writes(self, others: Others) -> dict[Place, Any]:
        if not self.outcomes or not (self._calls or others):
            return {}
        from saltus import tracing

        return tracing.readers_of_writes(self.traces.blocks(), self.outcomes, others)

    def _watched(self) -> list[Place]:
        """The functions whose outcome holds while nothing changes that they read."""
        return [
            (b, i)
            for b, outcomes in self.outcomes.items()
            for i, outcome in enumerate(outcomes)
            if outcome is not None and (b, i) not in self._called
        ]

    def _changed(self) -> list[Place]:
        return [(b, i) for b, i in self._watched() if self.outcomes[b][i].watch.changed()]

    def _run_anew(self, blocks: list[Block], places: Iterable[Place]) -> None:
        """Gives the engine other traces of some functions."""
        for b, i in places:
            function = blocks[b]["functions"][i]
            self._runs[b][i] = _core_trace(blocks[b], function, self._outcome(b, i))
        for b in {b for b, _ in places}:
            self.traces.set(b, self._core_traces(b))
        self.version += 1

    def _outcome(self, b: int, i: int) -> Any:
        """How a function runs: its own outcome, or called all the same."""
        return self._called.get((b, i), self.outcomes[b][i])

    def explain(self, note: str = "") -> Explanation:
        """How each callback runs."""
        callbacks = [
            _explained(block, function, self._outcome(number, i))
            for number, block in enumerate(self.traces.blocks())
            for i, function in enumerate(block["functions"])
        ]
        if not callbacks:
            note = note or "no callback is a Python function: all of it runs compiled"
        return Explanation(callbacks, note)

    def _tracer(self) -> Callable[[Any], Any]:
        """Traces a function; those of one code only once, until `settle`."""
        from saltus import tracing  # not before there is something to trace

        self._siblings = self._siblings or tracing.Siblings()
        trace: Callable[[Any], Any] = self._siblings.trace
        return trace

    def _core_traces(self, number: int) -> list[_core.Trace]:
        return [trace for trace in self._runs[number] if trace is not None]


def callbacks_of(system: Any) -> Callbacks:
    """The callbacks of a system as they are now, for the plan that is made next.

    New ones at first use, and again if blocks have declared more since.
    """
    callbacks: Callbacks | None = getattr(system, "_callbacks", None)
    if callbacks is None or callbacks.traces.stale:
        return Callbacks(system)
    callbacks.refresh()
    return callbacks


def planned(
    system: Any, plan: Callable[[Callbacks], Made], others: Others = ()
) -> tuple[Made, Callbacks]:
    """What `plan` makes for a system with its callbacks, which are traced by then.

    `plan` is called again if a function, traced for the first plan, has to be called.
    """
    callbacks = callbacks_of(system)
    made = plan(callbacks)
    if callbacks.settle(others):
        made = plan(callbacks)
    system._callbacks = callbacks
    return made, callbacks


def traced_callbacks(system: Any) -> Callbacks:
    """The callbacks of a system, traced. ModelError if the system cannot run."""
    return planned(system, lambda callbacks: _made_complete(system, callbacks))[1]


def _made_complete(system: Any, callbacks: Callbacks) -> None:
    if not callbacks.traces.complete:
        _core.trace(system, callbacks)


def explain(system: Any) -> Explanation:
    """How each callback of a system runs, for one that cannot run yet, too."""
    try:
        return traced_callbacks(system).explain()
    except ModelError:
        callbacks = Callbacks(system)
        callbacks.traces.guess_shapes()
        for number, block in enumerate(callbacks.traces.blocks()):
            callbacks.trace_block(number, block)
        callbacks.settle()
        return callbacks.explain(
            "the system has open inputs; each is taken for a single number here"
        )


def _trace(block: Block, function: Block, trace: Callable[[Any], Any]) -> Any:
    """Traced or Refused; None for a compiled function."""
    from saltus import tracing

    if function["compiled"]:
        return None
    outcome = trace(_signature(block, function))
    return tracing.as_guard(outcome) if function["role"] in GUARDS else outcome


def _signature(block: Block, function: Block) -> Any:
    from saltus import tracing

    return tracing.Signature(
        function=function["function"],
        owner=block["leaf"] if function["method"] else None,
        convention=function["convention"].name,
        block=block["path"],
        state_shape=tuple(block["state_shape"]),
        discrete_shape=tuple(block["discrete_shape"]),
        mode=block["mode"],
        x=block["x"],
        z=block["z"],
        parameters=block["parameters"],
        input_shapes=block["input_shapes"],
        inputs=function["inputs"],
        kind=KINDS.get(function["role"], "vector"),
        out=function["out"],
        out_shape=_out_shape(block, function),
        result_size=function["result_size"],
    )


def _out_shape(block: Block, function: Block) -> tuple[int, ...] | None:
    if not function["out"]:
        return None
    if function["role"] == "ode" and block["state_shape"]:
        return tuple(block["state_shape"])
    if function["role"] == "jacobian":
        return (len(block["x"]), len(block["x"]))
    return None


def _core_trace(block: Block, function: Block, outcome: Any) -> _core.Trace | None:
    if not hasattr(outcome, "tape"):
        return None
    given = any(f["role"] in ("jacobian", "sparse_jacobian") for f in block["functions"])
    return _core.Trace(
        function["number"],
        outcome.tape,
        outcome.relations,
        outcome.wrote_x,
        outcome.wrote_z,
        outcome.wrote_mode,
        function["role"] == "ode" and not given,
    )


def _explained(block: Block, function: Block, outcome: Any) -> ExplainedCallback:
    if outcome is None:
        return ExplainedCallback(block["path"], function["what"], "compiled", "")
    if hasattr(outcome, "tape"):
        return ExplainedCallback(block["path"], function["what"], "traced", "")
    return ExplainedCallback(block["path"], function["what"], "called", outcome.reason)
