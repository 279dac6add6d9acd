"""What does saltus.sweep cost? The runs of bench/sweep.cpp, in turns with its loop in C++.

    python bench/sweep.py build/bench/bin/sweep

Ratios of processor time are of one thread; that of two threads is by the clock, and says something
only while two cores are idle.
"""

import statistics
import subprocess
import sys
import time

import numpy as np
import saltus

ROUNDS = 15
GRID = {"e": 0.5 + 0.4 * np.arange(100) / 99, "x[0]": 5.0 + 10.0 * np.arange(100) / 99}
SPAN = (0.0, 5.0)


def main(program):
    ball = saltus.scene("bouncing-ball").system
    with subprocess.Popen([program, "serve"], stdin=-1, stdout=-1, text=True) as loop:

        def in_cpp():
            loop.stdin.write("\n")
            loop.stdin.flush()
            return tuple(map(float, loop.stdout.readline().split()))

        def by_sweep(workers):
            cpu, clock = time.process_time(), time.perf_counter()
            saltus.sweep(ball, GRID, SPAN, workers=workers)
            return time.process_time() - cpu, time.perf_counter() - clock

        by_sweep(2), in_cpp()
        rounds = [(in_cpp(), by_sweep(1), by_sweep(2)) for _ in range(ROUNDS)]
        loop.stdin.close()
    base = statistics.median(cpp[0] for cpp, *_ in rounds)
    one = statistics.median(one[0] / cpp[0] for cpp, one, _ in rounds)
    two = statistics.median(two[1] / cpp[1] for cpp, _, two in rounds)
    work = statistics.median(two[0] / cpp[0] for cpp, _, two in rounds)
    print(
        f"10000 leaf balls over 5 s: {1e3 * base:.1f} ms in C++ ({1e-4 * 1e6 * base:.2f} us a run)"
    )
    print(f"saltus.sweep, one thread: {one:.3f} of it, at most 1.1: {verdict(one, 1.1)}")
    print(f"saltus.sweep, two threads: {two:.3f} of it, at most 0.55: {verdict(two, 0.55)}")
    print(f"their work together: {work:.3f} of it, whatever else runs here")


def verdict(found, limit):
    return "holds" if found <= limit else "misses"


if __name__ == "__main__":
    main(sys.argv[1])
