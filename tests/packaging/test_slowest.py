"""The list of slow tests at the end of `./dev test`."""

import subprocess
import sys
from pathlib import Path

TOOL = Path(__file__).parents[2] / "tools" / "slowest.py"
CTEST = '<testsuite><testcase name="{}" classname="{}" time="{}"/></testsuite>'
CASE = '<testcase name="t[1]" classname="a.b" time="7.5"/>'
PYTEST = f"<testsuites><testsuite>{CASE}</testsuite></testsuites>"


def lines(*arguments):
    done = subprocess.run([sys.executable, TOOL, *arguments], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


def test_the_slowest_tests_of_all_files_come_first(tmp_path):
    for part, seconds in [("dev", 3.25), ("asan", 12)]:
        (tmp_path / f"{part}.xml").write_text(CTEST.format("a ball", "a ball", seconds))
    (tmp_path / "python.xml").write_text(PYTEST)
    (tmp_path / "broken.xml").write_text("<testsuite")
    files = [*sorted(tmp_path.glob("*.xml")), tmp_path / "none.xml"]
    assert [line.split() for line in lines(*files)] == [
        ["12.0", "s", "asan:", "a", "ball"],
        ["7.5", "s", "python:", "a.b.t[1]"],
        ["3.2", "s", "dev:", "a", "ball"],
    ]
    assert len(lines("--count", "2", *files)) == 2
