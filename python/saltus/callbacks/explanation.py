"""How callbacks run, and why, as a user reads it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

from saltus.callbacks.function import Block

__all__ = ["ExplainedCallback", "Explanation", "explained"]


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
    machine_code: bool = False
    """whether the tape of a traced function has become machine code, see the option
    `machine_code`
    """

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
            f"{name:{width}}  {_how(c)}" + (f": {c.reason}" if c.reason else "")
            for name, c in zip(names, self, strict=True)
        ]
        return "\n".join([*lines, *([self.note] if self.note else [])])

    __repr__ = __str__


def _how(callback: ExplainedCallback) -> str:
    return callback.runs + (", machine code" if callback.machine_code else "")


def explained(block: Block, function: Block, outcome: Any) -> ExplainedCallback:
    """The explanation of one function, by the outcome of its tracing."""
    if function["role"] == "derivatives":
        reason = "declared derivatives, asked for by `sensitivity` and `linearize` alone"
        return ExplainedCallback(block["path"], function["what"], "called", reason)
    if outcome is None:
        return ExplainedCallback(block["path"], function["what"], "compiled", "")
    if hasattr(outcome, "tape"):
        compiled = outcome.tape.is_machine_code
        return ExplainedCallback(block["path"], function["what"], "traced", "", compiled)
    return ExplainedCallback(block["path"], function["what"], "called", outcome.reason)
