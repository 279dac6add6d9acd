"""Runs SciPy's own tests of `solve_ivp` with `saltus.solve` in its place, and prints the count.

It needs SciPy with its tests, which its wheels have; no line of theirs is in this repository::

    python tests/python/scipy_ivp/run.py
"""

import importlib
import inspect
import json
import re
import sys
import warnings

import pytest
from shim import solve_ivp

MODULE = "scipy.integrate._ivp.tests.test_ivp"
OPTIONS = ("-q", "-c", "/dev/null", "-p", "no:cacheprovider", "--no-header", "--no-summary")


class Counted:
    """A plugin of pytest: keeps the tests that call `solve_ivp`, and notes how each ended."""

    def __init__(self):
        self.outcomes = {}
        self.reasons = {}

    def pytest_collection_modifyitems(self, items):
        items[:] = [item for item in items if _calls_solve_ivp(item.function)]

    def pytest_runtest_logreport(self, report):
        if report.when == "call" or report.failed:
            name = report.nodeid.split("::")[-1]
            self.outcomes[name] = report.outcome
            if report.failed:
                self.reasons[name] = str(report.longrepr.reprcrash.message).split("\n")[0]


def _calls_solve_ivp(function):
    return re.search(r"\bsolve_ivp\(|\bsolve_ivp,", inspect.getsource(function)) is not None


def run():
    """{name of a test: 'passed' or 'failed'}, and {name of a failed test: the first line of why}.

    ImportError where SciPy has no tests.
    """
    module = importlib.import_module(MODULE)
    counted, real = Counted(), module.solve_ivp
    module.solve_ivp = solve_ivp
    try:
        with warnings.catch_warnings():
            pytest.main(
                [*OPTIONS, module.__file__],
                plugins=[counted],
            )
    finally:
        module.solve_ivp = real
    return counted.outcomes, counted.reasons


if __name__ == "__main__":
    outcomes, reasons = run()
    if "--json" in sys.argv:
        print(json.dumps(outcomes))
        sys.exit()
    passed = sum(outcome == "passed" for outcome in outcomes.values())
    for name, reason in sorted(reasons.items()):
        print(f"{name}: {reason}")
    print(f"{passed} of {len(outcomes)} tests that call solve_ivp pass")
    sys.exit(0 if outcomes else 1)
