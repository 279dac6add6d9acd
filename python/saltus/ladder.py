"""The ladder of speed: how each Python callback of a system runs, and why."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

from saltus import _core
from saltus.errors import ModelError

__all__ = ["Explanation", "Rung"]

Block = dict[str, Any]  # what a survey says of a block, or of a function of it

KINDS = {"jacobian": "matrix", "reset_map": "reset", "edge_reset": "reset", "update": "update"}
"""role of a function -> what the tracer calls it; the others return a vector"""


class Rung(NamedTuple):
    """Where one callback stands on the ladder.

    Examples
    --------
    >>> block = saltus.library.FunctionBlock(lambda u: 2.0 * u, name="twice")
    >>> rung = block.explain()[0]
    >>> rung.block, rung.callback, rung.rung
    ('twice', "output 'out'", 'traced')
    """

    block: str
    """path of the block"""
    callback: str
    """such as "ode" or "guard of 'bounce'\""""
    rung: str
    """'called', 'traced' or 'compiled'"""
    reason: str
    """why it stands no higher; empty for a traced or compiled one"""


class Explanation(tuple[Rung, ...]):
    """The rungs of all Python callbacks of a system; its text has one line for each.

    Examples
    --------
    >>> block = saltus.library.FunctionBlock(lambda u: 2.0 * u, name="twice")
    >>> len(block.explain())
    1
    """

    def __new__(cls, rungs: Iterable[Rung], note: str = "") -> Explanation:
        self = super().__new__(cls, rungs)
        self.note = note
        return self

    note: str
    """what else there is to say of the system"""

    def __str__(self) -> str:
        names = [f"{r.block}: {r.callback}" for r in self]
        width = max(map(len, names), default=0)
        lines = [
            f"{name:{width}}  {r.rung}" + (f": {r.reason}" if r.reason else "")
            for name, r in zip(names, self, strict=True)
        ]
        return "\n".join([*lines, *([self.note] if self.note else [])])

    __repr__ = __str__


class Ladder:
    """What tracing made of the functions of a system, and whether it is still so.

    Nothing is traced before it is made, which is when a plan is: the shapes of inputs are known
    then. The Python object of the system owns it, so it holds no block and no function: they would
    hold each other.
    """

    def __init__(self, system: Any, *, incomplete: bool = False):
        self.survey = _core.Survey(system, incomplete)
        self.version = 0
        blocks: list[Block] = self.survey.blocks()
        self.outcomes = [[_trace(block, f) for f in block["functions"]] for block in blocks]
        self.traces = [
            [_core_trace(block, f, o) for f, o in zip(block["functions"], outcomes, strict=True)]
            for block, outcomes in zip(blocks, self.outcomes, strict=True)
        ]

    def refresh(self) -> int:
        """Trace again what was made from something that has changed; returns the version."""
        changed = [
            (b, i)
            for b, outcomes in enumerate(self.outcomes)
            for i, outcome in enumerate(outcomes)
            if outcome is not None and outcome.watch.changed() is not None
        ]
        blocks: list[Block] = self.survey.blocks() if changed else []
        for b, i in changed:
            function = blocks[b]["functions"][i]
            self.outcomes[b][i] = _trace(blocks[b], function)
            self.traces[b][i] = _core_trace(blocks[b], function, self.outcomes[b][i])
        self.version += bool(changed)
        return self.version

    def core_traces(self) -> list[list[_core.Trace]]:
        """Those there are, block by block."""
        return [[trace for trace in traces if trace is not None] for traces in self.traces]

    def explain(self) -> Explanation:
        """Where each callback stands."""
        rungs = [
            _rung(block, function, outcome)
            for block, outcomes in zip(self.survey.blocks(), self.outcomes, strict=True)
            for function, outcome in zip(block["functions"], outcomes, strict=True)
        ]
        note = "" if rungs else "no callback is a Python function: all of it runs compiled"
        if not self.survey.complete:
            note = "the system has open inputs; each is taken for a single number here"
        return Explanation(rungs, note)


def ladder_of(system: Any) -> Ladder:
    """The ladder of a system, made at first use and again if blocks have declared more since."""
    ladder: Ladder | None = getattr(system, "_ladder", None)
    if ladder is None or ladder.survey.stale:
        ladder = system._ladder = Ladder(system)
    else:
        ladder.refresh()
    return ladder


def climbed(system: Any) -> tuple[Any, Ladder | None]:
    """The system as it runs, with its ladder, or the system itself if it has no Python blocks.

    The engine refers to both and to what was given; keep all three as long as a run.
    """
    try:
        ladder = ladder_of(system)
    except ModelError:  # it cannot run; whoever makes a plan of it says why
        return system, None
    if not ladder.outcomes:
        return system, None
    return _core.LadderSystem(ladder.survey, ladder.core_traces()), ladder


def explain(system: Any) -> Explanation:
    """Where each callback of a system stands, for one that cannot run yet, too."""
    try:
        return ladder_of(system).explain()
    except ModelError:
        return Ladder(system, incomplete=True).explain()


def _trace(block: Block, function: Block) -> Any:
    """Traced or Refused; None for a compiled function."""
    from saltus import tracing  # not before there is something to trace

    if function["compiled"]:
        return None
    return tracing.trace(
        tracing.Signature(
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
    if outcome is None or not hasattr(outcome, "tape"):
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


def _rung(block: Block, function: Block, outcome: Any) -> Rung:
    if outcome is None:
        return Rung(block["path"], function["what"], "compiled", "")
    traced = hasattr(outcome, "tape")
    return Rung(
        block["path"],
        function["what"],
        "traced" if traced else "called",
        "" if traced else outcome.reason,
    )
