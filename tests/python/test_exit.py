"""A program ends with exit code 0 while threads of it still run."""

import os
import subprocess
import sys

import pytest

PROGRAM = """
import math, threading, time
import saltus

def circle(t, x):
    return [x[1], -x[0]]

def called(t, x):
    return [x[1], -math.sin(float(x[0]))]

def run(method, f, python):
    saltus.solve(f, (0, 1e9), [1.0, 0.0], method=method, python=python, {options})

threads = [threading.Thread(target={target}, args={arguments}, daemon=True) for _ in range(3)]
for thread in threads:
    thread.start()
time.sleep(0.5)
"""


def ends(target, arguments=(), options=""):
    program = PROGRAM.format(target=target, arguments=f"({', '.join(arguments)})", options=options)
    done = subprocess.run(
        [sys.executable, "-c", program],
        capture_output=True,
        text=True,
        timeout=60,
        env=os.environ,
    )
    return done.returncode, done.stderr


@pytest.mark.parametrize("method", ["auto", "dopri5", "dop853", "adams", "bdf", "radau"])
def test_daemon_threads_whose_callbacks_are_called(method):
    assert ends("run", (f"'{method}'", "called", "'called'")) == (0, "")


def test_daemon_threads_whose_callbacks_are_traced():
    assert ends("run", ("'auto'", "circle", "'traced'")) == (0, "")


def test_daemon_threads_that_report_their_progress():
    arguments = ("'auto'", "called", "'called'")
    assert ends("run", arguments, "progress=lambda progress: None") == (0, "")


WAITING = """
import threading, time
import saltus
from saltus.library import Integrator

entered = threading.Event()

def wait(*arguments, **more):
    entered.set()
    while True:  # each turn waits for the lock of the interpreter
        time.sleep(1e-4)

def long(time, x):  # to trace it takes seconds
    total = x.continuous_state[0] if hasattr(x, "continuous_state") else x[0]
    for i in range(100_000):
        total = 0.5 * total + 1.0
    return [total]

class Leaf(saltus.LeafSystem):
    def __init__(self, **given):
        super().__init__(name="leaf")
        calls = {{"ode": lambda t, s: [1.0], "guard": lambda t, s: s.continuous_state[0] - 0.5,
                 "reset": lambda t, s: [0.0], "out": lambda t, s: 1.0}} | given
        self.declare_continuous_state([0.0], ode=calls["ode"])
        self.declare_output_port(calls["out"], name="out")
        self.declare_zero_crossing(calls["guard"], calls["reset"], name="event")

def run(python="called", **given):
    saltus.simulate(Leaf(**given), (0.0, 1.0), python=python, progress=given.get("progress"))

for _ in range(3):
    threading.Thread(target={target}, daemon=True).start()
entered.wait()
time.sleep(0.2)
"""

WAITS = {
    "an ode": "lambda: run(ode=wait)",
    "a guard": "lambda: run(guard=wait)",
    "a reset map": "lambda: run(reset=wait)",
    "an output, for its shape": "lambda: Leaf(out=wait).create_context()",
    "an ode that is traced": "lambda: entered.set() or run('traced', ode=long)",
    "a guard that is traced": "lambda: entered.set() or run('traced', guard=long)",
    "a function of solve that is traced": "lambda: entered.set() or saltus.solve(long, (0, 1), [0.0])",
    "a function of solve": "lambda: saltus.solve(wait, (0.0, 1.0), [0.0])",
    "a run of a sweep": "lambda: saltus.sweep(lambda k: Leaf(ode=wait), dict(k=[1.0, 2.0]), (0.0, 1.0))",
}


@pytest.mark.parametrize("what", WAITS)
def test_daemon_threads_inside_of_a_callback(what):
    """The interpreter ends such a thread where it waits for the lock, below functions in C++."""
    done = subprocess.run(
        [sys.executable, "-c", WAITING.format(target=WAITS[what])],
        capture_output=True,
        text=True,
        timeout=60,
        env=os.environ,
    )
    assert (done.returncode, done.stderr) == (0, "")
