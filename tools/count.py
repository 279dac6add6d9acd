"""How many tests of a JUnit file passed and how many failed, as two numbers.

python tools/count.py FILE

A test of CTest is a file of C++ tests. The last lines that Catch2 prints say how many cases it has.
"""

import re
import sys
import xml.etree.ElementTree as tree
from pathlib import Path

ALL = re.compile(r"^All tests passed \(.* in (\d+) test cases?\)", re.MULTILINE)
SOME = re.compile(r"^test cases: *(\d+) \|(?: *(\d+) passed \|)? *(\d+) failed", re.MULTILINE)


def cases(test: tree.Element) -> tuple[int, int]:
    """Passed and failed cases of one test; a test that printed no number of cases is one case."""
    said = test.findtext("system-out") or ""
    if test.find("skipped") is not None:
        return 0, 0
    if test.find("failure") is None and test.find("error") is None:
        every = ALL.search(said)
        return (int(every[1]) if every else 1), 0
    some = SOME.search(said)
    return (int(some[2] or 0), int(some[3])) if some else (0, 1)


def count(file: Path) -> tuple[int, int]:
    """The sums over all tests of a file."""
    sums = [cases(test) for test in tree.parse(file).iter("testcase")]
    return sum(passed for passed, _ in sums), sum(failed for _, failed in sums)


if __name__ == "__main__":
    print(*count(Path(sys.argv[1])))
