"""`Siblings`: functions of one code in one system, such as a method of many blocks of a class.

A trace depends on the code, on the way a function is called, and on the values that it read. A
function of the same code that reads the same values in the same places has the same trace.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from saltus._wrapped import OWNER
from saltus.tracing.kept import call_of, find, start_of
from saltus.tracing.replay import Replay
from saltus.tracing.signature import Refused, Signature, Traced
from saltus.tracing.tracing import trace

__all__ = ["Siblings"]

MOST = 4  # the number of traces of one code with which a new function is compared


class Siblings:
    """The traces made for one system, by the code of the functions.

    It refers to functions and to their blocks, so it is kept no longer than they are traced.
    """

    def __init__(self) -> None:
        self._made: dict[Any, list[tuple[Signature, Traced | Refused]]] = {}

    def trace(self, signature: Signature) -> Traced | Refused:
        """Answers as `trace` does, but a function like an earlier one gets the same answer.

        If only numbers differ, a refusal is the same, and a tape is made anew but compared with its
        function at fewer points.
        """
        if getattr(signature.function, "__code__", None) is None:
            return trace(signature)
        kept = find(signature) if _is_wrapper(signature) else None
        if kept is not None:
            return kept  # not noted: it may have been made for another wrapper
        made = self._made.setdefault(call_of(signature), [])
        found = self._found(made, signature)
        if found is None:
            found = trace(signature, few=self._is_like_one(made, signature))
            made.append((signature, found))
            del made[:-MOST]
        return found

    @staticmethod
    def _found(
        made: list[tuple[Signature, Traced | Refused]], signature: Signature
    ) -> Traced | Refused | None:
        for other, outcome in reversed(made):
            by_check = isinstance(outcome, Refused) and outcome.by_check
            if by_check and start_of(other) != start_of(signature):
                continue
            exact = isinstance(outcome, Traced) or by_check
            dependencies = Replay(other, signature, exact).dependencies(outcome.dependencies)
            if dependencies is not None:
                return replace(outcome, dependencies=dependencies)
        return None

    @staticmethod
    def _is_like_one(made: list[tuple[Signature, Traced | Refused]], signature: Signature) -> bool:
        return any(
            Replay(other, signature, exact=False).dependencies(outcome.dependencies) is not None
            for other, outcome in made
            if isinstance(outcome, Traced)
        )


def _is_wrapper(signature: Signature) -> bool:
    """Whether the function is made anew for each run, to call one of the user's.

    A kept trace may be that of an earlier wrapper. Its reads are of that one's variables, so they
    cannot be compared with the reads of another wrapper of this run.
    """
    return OWNER in getattr(signature.function, "__dict__", {})
