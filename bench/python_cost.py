"""Measures the cost of Python: the tutorial's scenes traced and called against the same scenes in
C++; one call of a callback; short runs (`short_runs.py`); the first result after `import saltus`.

    python bench/python_cost.py [build/bench/results]

Whole calls of `saltus.simulate`, warm, in one process, taking turns; processor time, medians.
"""

import ctypes
import json
import statistics
import subprocess
import sys
import sysconfig
import tempfile
import time
from pathlib import Path

import numpy as np
import saltus
import short_runs
from saltus.library import Comparator, Constant, Gain, Integrator, ReduceBlock, Step

LEAF = {"rtol": 1e-10, "atol": 1e-12, "max_minor_step_size": 1e-3}
BLOCKS = {
    "rtol": 1e-6,
    "atol": 1e-8,
    "max_major_step_length": 0.1,
    "max_minor_step_size": 1e-3,
}
TARGET = 1.5
CALL_TARGET = 150.0  # [ns]
COLD_TARGET = 0.3  # [s]


class Ball(saltus.LeafSystem):
    """The tutorial's leaf."""

    def __init__(self, e):
        super().__init__(name="ball")
        self.e = e
        self.declare_continuous_state(2, ode=self.ode)
        self.declare_continuous_state_output(name="y")
        self.declare_dynamic_parameter("g", 9.81)
        self.declare_zero_crossing(
            guard=self.height,
            reset_map=self.bounce,
            name="bounce",
            direction="positive_then_non_positive",
        )

    def ode(self, time, state, **parameters):
        _, v = state.continuous_state
        return np.array([v, -parameters["g"]])

    def height(self, time, state, **parameters):
        y, _ = state.continuous_state
        return y

    def bounce(self, time, state, **parameters):
        y, v = state.continuous_state
        return state.with_continuous_state(np.array([np.abs(y), -self.e * v]))


def compiled_ball():
    """The tutorial's leaf with e = 1, of compiled functions."""
    block = saltus.LeafSystem(name="ball")
    block.declare_dynamic_parameter("g", 9.81)
    block.declare_continuous_state(2, ode=C.fall)
    block.declare_continuous_state_output(name="y")
    block.declare_zero_crossing(
        C.height, C.bounce, name="bounce", direction="positive_then_non_positive"
    )
    return block


def blocks(e, floor, below):
    """The tutorial's diagram; `below` compares."""
    builder = saltus.DiagramBuilder()
    v, y = (
        builder.add(
            Integrator(
                enable_reset=True, enable_external_reset=True, name=name, zeno_tolerance=1e-6
            )
        )
        for name in ("v", "y")
    )
    weight, rebound = builder.add(Constant(-9.81, name="weight"), Gain(-e, name="rebound"))
    builder.add(floor, below)
    for source, target in [
        (weight.output(), v.input(0)),
        (v.output(), y.input(0)),
        (y.output(), below.input(0)),
        (floor.output(), below.input(1)),
        (below.output(), v.input(1)),
        (below.output(), y.input(1)),
        (v.output(), rebound.input()),
        (rebound.output(), v.input(2)),
        (floor.output(), y.input(2)),
    ]:
        builder.connect(source, target)
    return builder.build()


def leaf_runner(e, t_end, way):
    """The leaf in Python, or that of the shelf, which has e = 0.9; for another e one in C."""
    if way == "C++" and e == 0.9:
        system = saltus.scene("bouncing-ball").system
    else:
        system = compiled_ball() if way == "C++" else Ball(e)
    context = system.create_context().with_continuous_state([10.0, 0.0])
    return runner(system, context, t_end, LEAF, way)


def block_runner(e, floor, y0, t_end, way):
    """The diagram with a lambda, or with a Comparator."""
    name = "below"
    below = (
        Comparator("<", name=name)
        if way == "C++"
        else ReduceBlock(2, lambda x: x[0] < x[1], name=name)
    )
    system = blocks(e, Step(*floor, name="floor"), below)
    context = system.create_context()
    y = system["y"]
    context = context.with_subcontext(y, context[y].with_continuous_state(y0))
    return runner(system, context, t_end, BLOCKS, way, y.output())


def runner(system, context, t_end, options, way, port=None):
    recorded = {"y": port or system.output()}
    python = "called" if way == "called" else "traced"

    def run():
        return saltus.simulate(
            system, context, (0.0, t_end), recorded_signals=recorded, python=python, **options
        )

    return run


SCENES = {
    "scene 1: leaf, e = 1": lambda way: leaf_runner(1.0, 6 * np.sqrt(20.0 / 9.81), way),
    "scene 2: leaf, e = 0.9": lambda way: leaf_runner(0.9, 12.0, way),
    "scene 3: blocks, e = 0.8": lambda way: block_runner(0.8, (0.0, -1e-3, 1.0), 1e-3, 1.1, way),
    "scene 4: blocks, e = 0.9": lambda way: block_runner(0.9, (5.0, 0.0, 10.0), 10.0, 40.0, way),
}


def taking_turns(runners, least=0.6):
    """The median processor time of each, batch by batch."""
    times = {name: [] for name in runners}
    for run in runners.values():
        run()  # warm: traced, planned once
    begin = time.process_time()
    while time.process_time() - begin < least or len(next(iter(times.values()))) < 7:
        for name, run in runners.items():
            before = time.process_time()
            run()
            times[name].append(time.process_time() - before)
    return {name: statistics.median(values) for name, values in times.items()}


def scene_row(name, make):
    runners = {way: make(way) for way in ("C++", "traced", "called")}
    events = {way: len(run().events) for way, run in runners.items()}
    assert len(set(events.values())) == 1, f"{name}: not the same events: {events}"
    times = taking_turns(runners)
    return {"scene": name, "C++": times["C++"] * 1e6} | {
        way: times[way] / times["C++"] for way in ("traced", "called")
    }


CALLS = """
#include <Python.h>
double calls(PyObject* f, PyObject* t, PyObject* x, PyObject* g, PyObject* names, long n) {
  PyObject* arguments[4] = {NULL, t, x, g};
  for (long i = 0; i < n; ++i) {
    PyGILState_STATE held = PyGILState_Ensure();
    Py_DECREF(PyObject_Vectorcall(f, arguments + 1, 2 | PY_VECTORCALL_ARGUMENTS_OFFSET, names));
    PyGILState_Release(held);
  }
  return 0.0;
}
#define CALLBACK(name) \\
  int name(double t, const double* x, const double* u, const double* p, double* out, void* data)
CALLBACK(nothing) { return out[0] = out[1] = 0.0, 0; }
CALLBACK(fall) { return out[0] = x[1], out[1] = -p[0], 0; }
CALLBACK(height) { return out[0] = x[0], 0; }
CALLBACK(bounce) { return out[0] = x[0] < 0.0 ? -x[0] : x[0], out[1] = -x[1], 0; }
"""


def library(folder):
    """The C loop that is the floor, and callbacks in C."""
    (Path(folder) / "calls.c").write_text(CALLS)
    include = sysconfig.get_paths()["include"]
    command = ["cc", "-O2", "-shared", "-fPIC", f"-I{include}", "-o", "calls.so", "calls.c"]
    subprocess.run(command, cwd=folder, check=True)
    return ctypes.PyDLL(str(Path(folder) / "calls.so"))


def call_cost():
    """Nanoseconds of ours in a call: a run with an empty ode in Python, less the same run with a
    compiled one, less what a C loop needs for the same calls.
    """
    result = np.zeros(2)

    def empty(time, state, *, g):
        return result

    def leaf(ode):
        block = saltus.LeafSystem(name="block")
        block.declare_dynamic_parameter("g", 9.81)
        block.declare_continuous_state(2, ode=ode)
        return block

    options = {"max_minor_step_size": 1e-3, "ode_solver_method": "dopri5", "python": "called"}
    systems = {"empty": leaf(empty), "compiled": leaf(C.nothing)}
    runners = {
        name: lambda s=system: saltus.simulate(s, s.create_context(), (0.0, 10.0), **options)
        for name, system in systems.items()
    }
    count = runners["empty"]().statistics.right_hand_side_calls
    C.calls.argtypes = [ctypes.py_object] * 5 + [ctypes.c_long]
    x = np.zeros(2)
    runners["floor"] = lambda: C.calls(empty, 1.0, x, 9.81, ("g",), count)
    times = {name: t / count * 1e9 for name, t in taking_turns(runners).items()}
    return {"floor": times["floor"], "ours": times["empty"] - times["compiled"] - times["floor"]}


COLD = """
import time
import numpy
numpy_done = time.process_time()
import sys
sys.path.insert(0, {folder!r})
import python_cost
python_cost.leaf_runner(0.9, 12.0, "traced")()
print(time.process_time() - numpy_done)
"""


def cold():
    """[s] of processor time from `import saltus`, numpy's import left out, to the first result; the
    best of five.
    """
    code = COLD.format(folder=str(Path(__file__).parent))
    runs = [
        subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
        for _ in range(5)
    ]
    return min(float(run.stdout) for run in runs)


def main(results=None):
    rows = [scene_row(name, make) for name, make in SCENES.items()]
    print(f"{'whole simulate() calls':28}{'C++ [us]':>10}{'traced':>9}{'called':>9}  times C++")
    for row in rows:
        print("{scene:28}{C++:10.0f}{traced:9.2f}{called:9.2f}".format(**row))
    print(f"target: traced <= {TARGET}")
    call = call_cost()
    print("a call of Python: {floor:.0f} ns the call itself, {ours:.0f} ns ours".format(**call))
    print(f"target: ours <= {CALL_TARGET:.0f} ns")
    short = short_runs.show(Ball)
    first = cold()
    print(f"first result after import: {first:.3f} s; target <= {COLD_TARGET} s")
    if results:
        sheet = {"scenes": rows, "call": call, "short": short, "cold": first}
        (Path(results) / "python_cost.json").write_text(json.dumps(sheet, indent=1))


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as made:
        C = library(made)
        main(*sys.argv[1:])
