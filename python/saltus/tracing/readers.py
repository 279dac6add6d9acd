"""The traced functions of a system that read what one of its called functions may write."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from saltus.tracing.effects import Change, Changes, Looks, writes_of
from saltus.tracing.known import Known
from saltus.tracing.roots import roots_of
from saltus.tracing.signature import Refused, Traced

__all__ = ["readers_of_writes"]

Place = tuple[int, int]


class _Callback(NamedTuple):
    words: str
    roots: list[Any]
    """the function, and the block that it is a method of"""


def readers_of_writes(
    blocks: Sequence[Mapping[str, Any]],
    outcomes: Mapping[int, Sequence[Traced | Refused | None]],
    others: Iterable[tuple[str, Any]],
    looks: list[Looks] | None = None,
) -> dict[Place, Refused]:
    """The traced functions, by (block, number), that have to be called, and why.

    A trace holds the values that its function read, as constants. They remain right if no callback
    of the run writes them. A traced function writes nothing. The code of a called function and the
    objects that it can reach show what it may write. A function that is called for this reason may
    write too, because other values may lead it elsewhere, so the search is repeated.

    `looks` gets everything at which the search has looked. While these objects and the dependencies
    of `outcomes` remain the same, so does the answer.
    """
    waiting = [_Callback(words, [function]) for words, function in others]
    left: dict[Place, Traced] = {}
    for b, of_block in outcomes.items():
        for i, outcome in enumerate(of_block):
            if isinstance(outcome, Traced):
                left[b, i] = outcome
            elif not isinstance(blocks[b]["functions"][i]["function"], Known):
                waiting.append(_callback(blocks[b], i))
    found: dict[Place, Refused] = {}
    changes = Changes()
    while waiting and left:
        for callback in waiting:
            writes = writes_of(callback.roots)
            changes.add(callback.words, writes)
            if looks is not None:
                looks.append(writes.looks)
        new = dict(_readers(changes, left))
        waiting = [_callback(blocks[b], i) for b, i in new]
        left = {place: traced for place, traced in left.items() if place not in new}
        found |= new
    return found


def _readers(changes: Changes, left: Mapping[Place, Traced]) -> Iterator[tuple[Place, Refused]]:
    for place, traced in left.items():
        change = changes.of(traced.dependencies)
        if change is not None:
            yield place, Refused(_reason(change), traced.dependencies)


def _reason(change: Change) -> str:
    if change.unknown:
        return (
            f"reads {change.words}, and {change.writer} may write anything, as {change.unknown}; "
            "keep the value in the state, or in a parameter"
        )
    return (
        f"reads {change.words}, which {change.writer} may write; "
        "keep it in the discrete state, which a reset or an update writes"
    )


def _callback(block: Mapping[str, Any], i: int) -> _Callback:
    words = f"the {block['functions'][i]['what']} of '{block['path']}'"
    return _Callback(words, roots_of(block, i))
