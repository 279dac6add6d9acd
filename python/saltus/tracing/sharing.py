"""The called functions of a system that share values outside of it: some write them, others read
them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from saltus.tracing.effects import Looks, reads_of, writes_of
from saltus.tracing.known import Known
from saltus.tracing.roots import roots_of
from saltus.tracing.signature import Refused, Traced

__all__ = ["Place", "Sharing", "sharing_of"]

Place = tuple[int, int]  # the numbers of a block and of a function of it
Sharing = dict[int, tuple[list[int], list[int]]]
"""number of a block -> the numbers of its readers and of its writers"""

WRITERS = {"reset_map", "edge_reset", "event_input", "update"}
"""functions that run at instants alone"""
READERS = {"ode", "output", "guard", "relation"}
"""functions whose values the engine keeps between two instants, or follows"""


def sharing_of(
    blocks: Sequence[Mapping[str, Any]],
    outcomes: Mapping[int, Sequence[Traced | Refused | None]],
    called: Mapping[Place, Refused],
    looks: list[Looks] | None = None,
) -> Sharing:
    """The writers that some reader may see, and these readers.

    `called` are the traced functions that are called all the same. A function that neither was
    traced nor is known may read or write what its code and the objects that it can reach show.
    `looks` gets everything at which the search has looked.
    """
    looks = [] if looks is None else looks
    found = {
        place: writes_of(roots_of(blocks[place[0]], place[1]))
        for place in _called(blocks, outcomes, called, WRITERS)
    }
    looks.extend(writes.looks for writes in found.values())
    writers = {place: writes for place, writes in found.items() if writes.any}
    if not writers:
        return {}
    readers = {
        place: reads_of(roots_of(blocks[place[0]], place[1]))
        for place in _called(blocks, outcomes, called, READERS)
    }
    looks.extend(reads.looks for reads in readers.values())
    pairs = [(r, w) for r in readers for w in writers if readers[r].may_see(writers[w])]
    shared: Sharing = {}
    for reader, writer in pairs:
        for (block, function), kind in ((reader, 0), (writer, 1)):
            functions = shared.setdefault(block, ([], []))[kind]
            if function not in functions:
                functions.append(function)
    return shared


def _called(
    blocks: Sequence[Mapping[str, Any]],
    outcomes: Mapping[int, Sequence[Traced | Refused | None]],
    called: Mapping[Place, Refused],
    roles: set[str],
) -> Iterator[Place]:
    for b, of_block in outcomes.items():
        for i, outcome in enumerate(of_block):
            function = blocks[b]["functions"][i]
            if function["role"] not in roles or isinstance(function["function"], Known):
                continue
            if not isinstance(outcome, Traced) or (b, i) in called:
                yield b, i
