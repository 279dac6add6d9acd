"""The numbers of passed and failed tests that `./dev test` adds up."""

import subprocess
import sys
from pathlib import Path

import pytest

TOOL = Path(__file__).parents[2] / "tools" / "count.py"
PASSED = "All tests passed (63 assertions in {} test case{})"
FAILED = "test cases:  5 |  3 passed | 2 failed\nassertions: 12 | 10 passed | 2 failed"


def count(tmp_path, *tests):
    file = tmp_path / "tests.xml"
    file.write_text(f"<testsuites><testsuite>{''.join(tests)}</testsuite></testsuites>")
    done = subprocess.run([sys.executable, TOOL, file], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return tuple(int(number) for number in done.stdout.split())


def ctest(status, said):
    failure = "<failure/>" if status == "fail" else ""
    return (
        f'<testcase name="a" status="{status}">{failure}<system-out>{said}</system-out></testcase>'
    )


@pytest.mark.parametrize(
    ("test", "sums"),
    [
        ('<testcase name="a"/>', (1, 0)),
        ('<testcase name="a"><skipped/></testcase>', (0, 0)),
        ('<testcase name="a"><failure/></testcase>', (0, 1)),
        ('<testcase name="a"><error/></testcase>', (0, 1)),
        (ctest("run", PASSED.format(12, "s")), (12, 0)),
        (ctest("run", PASSED.format(1, "")), (1, 0)),
        (ctest("fail", FAILED), (3, 2)),
        (ctest("fail", "test cases: 1 | 1 failed"), (0, 1)),
        (ctest("fail", "a crash says no number"), (0, 1)),
        # It ended badly after its last case, as with a leak.
        (ctest("fail", PASSED.format(12, "s")), (0, 1)),
    ],
)
def test_a_test_is_so_many(tmp_path, test, sums):
    assert count(tmp_path, test) == sums


def test_the_sums_of_a_file(tmp_path):
    tests = [ctest("run", PASSED.format(12, "s")), ctest("fail", FAILED), '<testcase name="a"/>']
    assert count(tmp_path, *tests) == (16, 2)
