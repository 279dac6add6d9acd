"""Compares two fingerprints: `fingerprint.py BEFORE AFTER`; exit status 1 where they differ."""

from __future__ import annotations

import sys
from collections import Counter

PARTS = ("rows", "events", "statistics", "context", "continuation", "error", "status")
MOST = 40  # lines that are printed

Runs = dict[tuple[str, str], list[str]]


def read(path: str) -> Runs:
    """What each run gave, by scene and method. Runs of one name are numbered."""
    runs: Runs = {}
    times: Counter[tuple[str, str]] = Counter()
    with open(path) as file:
        for line in file:
            scene, method, *found = line.rstrip("\n").split("\t")
            if len(found) != len(PARTS):
                sys.exit(f"{path}: expected {2 + len(PARTS)} columns, found {line!r}")
            times[scene, method] += 1
            number = times[scene, method]
            runs[scene if number == 1 else f"{scene} ({number})", method] = found
    return runs


def difference(before: list[str] | None, after: list[str] | None) -> str:
    """Which parts differ, in words; empty where none does."""
    if before is None or after is None:
        return "is only in the second" if before is None else "is only in the first"
    return ", ".join(
        f"status {old} -> {new}" if part == "status" else part
        for part, old, new in zip(PARTS, before, after, strict=True)
        if old != new
    )


def compare(before: Runs, after: Runs) -> int:
    """How many runs differ; prints each."""
    found = {key: difference(before.get(key), after.get(key)) for key in before | after}
    differing = {key: words for key, words in found.items() if words}
    for (scene, method), words in list(differing.items())[:MOST]:
        print(f"  {scene}, {method}: {words}")
    if len(differing) > MOST:
        print(f"  ... and {len(differing) - MOST} more")
    kinds = Counter(scene.partition("/")[0] for scene, _ in differing)
    by_part = Counter(part for words in differing.values() for part in words.split(", "))
    if differing:
        print("by kind of scene:", ", ".join(f"{kind} {n}" for kind, n in kinds.most_common()))
        print("by part:", ", ".join(f"{part} {n}" for part, n in by_part.most_common()))
    print(f"{len(before)} runs before, {len(after)} after, {len(differing)} differ")
    return len(differing)


if __name__ == "__main__":
    sys.exit(1 if compare(read(sys.argv[1]), read(sys.argv[2])) else 0)
