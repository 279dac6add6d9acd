"""The slowest tests of some JUnit files: seconds, name, and the file that has it.

python tools/slowest.py [--count N] FILE...
"""

import argparse
import xml.etree.ElementTree as tree
from collections.abc import Iterable, Iterator
from pathlib import Path


def durations(file: Path) -> Iterator[tuple[float, str]]:
    """Seconds and name of each test in a file; none if it cannot be read."""
    try:
        cases = tree.parse(file).iter("testcase")
    except (OSError, tree.ParseError):
        return
    for case in cases:
        folder, name = case.get("classname", ""), case.get("name", "")
        # CTest repeats the name as the class; pytest has the module there.
        yield float(case.get("time") or 0.0), name if folder in ("", name) else f"{folder}.{name}"


def slowest(files: Iterable[Path], count: int) -> list[str]:
    """A line for each of the slowest tests, the slowest first."""
    found = [(seconds, name, file.stem) for file in files for seconds, name in durations(file)]
    found.sort(key=lambda test: -test[0])
    return [f"{seconds:8.1f} s  {part}: {name}" for seconds, name, part in found[:count]]


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("files", type=Path, nargs="+")
    parser.add_argument("--count", type=int, default=10)
    given = parser.parse_args()
    print(*slowest(given.files, given.count), sep="\n")
