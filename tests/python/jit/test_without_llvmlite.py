"""Saltus without the extra: a part of the tests in a process where llvmlite cannot be imported."""

import subprocess
import sys
from pathlib import Path

import pytest

TESTS = Path(__file__).parents[1]
HIDDEN = """
import sys
sys.modules["llvmlite"] = None  # an import of it is an ImportError
import pytest
sys.exit(pytest.main(["-q", "-o", "cache_dir=build/pytest_bare", *sys.argv[1:]]))
"""


def python(*arguments):
    return subprocess.run(
        [sys.executable, *arguments],
        capture_output=True,
        text=True,
        timeout=300,
        cwd=TESTS.parents[1],
    )


@pytest.mark.parametrize("part", ["test_solve.py", "test_options.py", "test_exceptions.py"])
def test_a_part_of_the_tests_passes(part):
    done = python("-c", HIDDEN, str(TESTS / part))
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-1000:]


LONG = """
import sys
sys.modules["llvmlite"] = None
import numpy as np, saltus
def orbit(t, x):
    r = np.hypot(x[0], x[1])
    return np.array([x[2], x[3], -x[0] / r**3, -x[1] / r**3])
solution = saltus.solve(orbit, (0.0, 100.0), [1.0, 0.0, 0.0, 1.1], rtol=1e-9)
system = solution.system
simulator = saltus.Simulator(system, rtol=1e-9)
for _ in range(100):  # far beyond the point where compiling would pay
    simulator.initialize(system.create_context())
    simulator.advance_to(2000.0)
print(simulator.describe().splitlines()[-1])
try:
    saltus.Simulator(system, machine_code="always")
except saltus.ModelError as error:
    print(error)
"""


def test_a_long_run_stays_interpreted_and_always_says_what_to_install():
    done = python("-c", LONG)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines() == [
        "tapes: 1, interpreted",
        "option machine_code='always' needs llvmlite, which is not installed: "
        'pip install "saltus[jit]"',
    ]
