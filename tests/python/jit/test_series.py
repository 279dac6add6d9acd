"""Steps of `taylor` as machine code: the run is the same, to the last bit."""

import itertools

import numpy as np
import pytest
import saltus

pytest.importorskip("llvmlite")


def kepler(t, x):
    w = -1.0 / (x[0] ** 2 + x[1] ** 2) ** 1.5
    return np.array([x[2], x[3], w * x[0], w * x[1]])


def functions(t, x):
    return np.array([
        np.sin(x[1]) * np.exp(-x[0] ** 2) + np.arctan2(x[0], 2.0 + x[1]),
        -np.tanh(x[0]) + 0.1 * np.log(2.0 + np.cos(t)) + np.hypot(x[0], 1.0) ** 0.3,
    ])  # fmt: skip


def bodies(t, x):
    """Seven bodies in a plane: long enough for four expressions at once, and for shared code."""
    place = [x[2 * i : 2 * i + 2] for i in range(7)]
    pull = [np.zeros(2) for _ in range(7)]
    for i, j in itertools.combinations(range(7), 2):
        apart = place[j] - place[i]
        r2 = apart[0] ** 2 + apart[1] ** 2
        w = 1.0 / (r2 * np.sqrt(r2))
        pull[i] = pull[i] + (j + 1) * w * apart
        pull[j] = pull[j] - (i + 1) * w * apart
    return np.concatenate([x[14:], *pull])


PLEIADES = [
    3.0, 3.0, 3.0, -3.0, -1.0, 2.0, -3.0, 0.0, 2.0, 0.0, -2.0, -4.0, 2.0, 4.0,
    0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.25, 0.0, 1.0, 1.75, 0.0, -1.5, 0.0,
]  # fmt: skip
SCENES = {
    "kepler": (kepler, [0.4, 0.0, 0.0, 2.0], 10.0, lambda x: x[0] * x[2] + x[1] * x[3]),
    "functions": (functions, [0.3, 0.2], 5.0, lambda x: x[0] - np.sin(x[1])),
    "bodies": (bodies, PLEIADES, 0.5, lambda x: x[0] - 2.9),
}


class Flight(saltus.LeafSystem):
    def __init__(self, name):
        super().__init__(name="flight")
        ode, start, self.end, guard = SCENES[name]
        self.declare_continuous_state(start, ode=lambda t, s: ode(t, s.continuous_state))
        self.declare_zero_crossing(lambda t, s: guard(s.continuous_state), name="monitor")


def run(flight, **options):
    simulator = saltus.Simulator(flight, ode_solver_method="taylor", **options)
    simulator.initialize(flight.create_context())
    simulator.advance_to(flight.end)
    return simulator


def facts(simulator):
    results = simulator.results
    times = [event.time for event in results.events]
    return results.context.continuous_state.tobytes(), times, results.statistics.steps


def series_line(simulator):
    return [line for line in simulator.describe().splitlines() if line.startswith("Taylor")]


@pytest.mark.parametrize("rtol", [1e-3, 1e-8, 1e-13])
@pytest.mark.parametrize("name", SCENES)
def test_always_and_never_are_the_same_run(name, rtol):
    always = run(Flight(name), machine_code="always", rtol=rtol, atol=rtol)
    never = run(Flight(name), machine_code="never", rtol=rtol, atol=rtol)
    assert facts(always) == facts(never)
    assert len(never.results.events) > 0
    order = {1e-3: 5, 1e-8: 11, 1e-13: 16}[rtol]  # 1 - ln(rtol) / 2, rounded up
    assert series_line(always) == [f"Taylor series: of order {order}, run as machine code"]
    assert series_line(never) == [f"Taylor series: of order {order}, interpreted"]


def test_a_step_becomes_machine_code_when_enough_was_interpreted():
    flight = Flight("kepler")
    simulator = run(flight, rtol=1e-8, atol=1e-8)
    assert series_line(simulator) == ["Taylor series: of order 11, interpreted"]
    for _ in range(4000):  # of 15 us each; a tenth of them is enough
        simulator.initialize(flight.create_context())
        simulator.advance_to(flight.end)
    assert series_line(simulator) == ["Taylor series: of order 11, run as machine code"]


def test_another_method_has_no_series():
    flight = Flight("kepler")
    simulator = saltus.Simulator(flight, ode_solver_method="dop853", machine_code="always")
    simulator.initialize(flight.create_context())
    assert series_line(simulator) == []
