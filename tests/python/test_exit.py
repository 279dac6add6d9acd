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
