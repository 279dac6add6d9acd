"""Derivatives through event wires and queued zero crossings, against differences of tight runs."""

import numpy as np
import pytest
import saltus
from cells import TAU, Cell, period, wired

TIGHT = {"rtol": 1e-12, "atol": 1e-14}


def currents(diagram, values):
    names = [f"cell {k}.current" for k in range(len(values))]
    return diagram.create_context().with_parameters(dict(zip(names, values, strict=True)))


def network(delay):
    """Eight cells; each firing reaches three others, with weights of either sign."""
    random = np.random.default_rng(7)
    cells = [Cell(f"cell {k}", 60.0, v=0.1 * k) for k in range(8)]
    wires = [
        (f"cell {k}.fire", f"cell {j}.synapse", float(weight), delay)
        for k in range(8)
        for j, weight in zip(
            random.choice(8, 3, replace=False), random.uniform(-0.05, 0.08, 3), strict=True
        )
    ]
    return wired(*cells, wires=wires), random.uniform(55.0, 100.0, 8)


@pytest.mark.parametrize("delay", [0.0, 0.0013, 0.03])
@pytest.mark.parametrize("method", ["dopri5", "dop853"])
def test_a_network_of_cells(delay, method):
    diagram, values = network(delay)
    span, h = (0.0, 0.1), 1e-5
    options = TIGHT | {"ode_solver_method": method}
    names = ["cell 0.current", "cell 3.current"]
    run = saltus.simulate(diagram, currents(diagram, values), span, sensitivity=names, **options)
    plain = saltus.simulate(diagram, currents(diagram, values), span, **options)
    assert plain.context == run.context and np.array_equal(plain.events.times(), run.events.times())
    assert len(run.events) > 30 and not run.sensitivity_gaps
    for column, k in enumerate((0, 3)):
        ends, times = [], []
        for sign in (1, -1):
            moved = values.copy()
            moved[k] += sign * h
            beside = saltus.simulate(diagram, currents(diagram, moved), span, **options)
            ends.append(beside.context.continuous_state)
            times.append(np.array(beside.events.times()))
            assert [e.block for e in beside.events] == [e.block for e in run.events]
        # central differences: h^2 times third derivatives of order 1e-3 to 1, and 1e-12 / h
        found = run.sensitivities.continuous_state[:, column]
        np.testing.assert_allclose(found, (ends[0] - ends[1]) / (2 * h), rtol=1e-5, atol=1e-6)
        by = run.events.dt_dp()[:, column]
        np.testing.assert_allclose(by, (times[0] - times[1]) / (2 * h), rtol=1e-5, atol=1e-7)


def test_with_derivatives_a_wire_with_a_delay_joins_its_cells():
    """The derivative of a delivery is known in the run in which its event fires."""
    diagram, values = network(0.0013)
    begin, span = currents(diagram, values), (0.0, 0.1)
    options = {"sensitivity": ["cell 0.current"]}
    apart = saltus.simulate(diagram, begin, span, islands=True, **options)
    together = saltus.simulate(diagram, begin, span, **options)
    np.testing.assert_array_equal(apart.events.dt_dp(), together.events.dt_dp())
    assert np.any(apart.events.dt_dp() != 0.0)
    whole = saltus.simulate(diagram, begin, span, islands=True)
    assert len(whole.islands) == 8 and len(whole.events) == len(together.events)


def test_a_spike_by_the_weight_through_a_parameter_of_the_diagram():
    current = saltus.Parameter("current", 80.0)
    builder = saltus.DiagramBuilder()
    builder.add(Cell("a", current), Cell("b", 0.6 * current))
    builder.connect_event("a.fire", "b.synapse", weight=0.1, delay=0.002)
    diagram = builder.build(parameters={"current": current})
    run = saltus.simulate(diagram, time_span=(0.0, 0.03), sensitivity=["current"], **TIGHT)
    (by_a,) = run.events.dt_dp("a.fire")
    # T = tau ln(I tau / (I tau - 1))
    expected = TAU * (1 / 80.0 - TAU / (80.0 * TAU - 1))
    np.testing.assert_allclose(by_a, [expected], rtol=1e-8)
    # v = 0.6 I tau (1 - e^-t/tau) + w e^(s - t)/tau from the kick at s = T + d on
    level, kick = 0.6 * 80.0 * TAU, 0.1 * np.exp((period(80.0) + 0.002) / TAU)
    end = np.exp(-0.03 / TAU)
    by_end = 0.6 * TAU * (1 - end) + kick * end / TAU * expected
    assert level < 1 and len(run.events) == 1  # b never fires
    np.testing.assert_allclose(run.sensitivities.continuous_state[1, 0], by_end, rtol=1e-7)


@pytest.mark.parametrize("islands", [False, True])
def test_islands_and_pieces(islands):
    pairs = [(Cell(f"a{k}", 70.0 + k), Cell(f"b{k}", 60.0)) for k in range(2)]
    wires = [(f"a{k}.fire", f"b{k}.synapse", 0.2, 0.004) for k in range(2)]
    diagram = wired(*pairs[0], *pairs[1], wires=wires)
    names = ["a0.current", "b1.current", "a1.current"]
    options = {"sensitivity": names, "islands": islands, **TIGHT}
    whole = saltus.simulate(diagram, time_span=(0.0, 0.1), **options)
    simulator = saltus.Simulator(diagram, **options)
    simulator.initialize(diagram.create_context())
    for t in (0.024, 0.026, 0.07, 0.1):
        simulator.advance_to(t)
    expected = np.array(whole.sensitivities.continuous_state)
    assert np.isfinite(expected).all()
    # a block does not move the other pair, up to the errors of differences
    np.testing.assert_allclose(expected[0:2, 1:], 0.0, atol=1e-10)
    found = np.array(simulator.results.sensitivities.continuous_state)
    np.testing.assert_allclose(found, expected, rtol=1e-6, atol=1e-9)


class Queue(saltus.LeafSystem):
    """x' = r from 0. Each crossing of 1 is executed `delay` later, and takes x to x - 1."""

    def __init__(self, frozen):
        super().__init__(name="queue")
        self.declare_dynamic_parameter("r", 2.0)
        self.declare_dynamic_parameter("delay", 0.2)
        self.declare_continuous_state([0.0], ode=lambda t, s, r, delay: [r])
        self.declare_zero_crossing(
            lambda t, s, r, delay: s.continuous_state[0] - 1.0,
            lambda t, s, r, delay: [s.continuous_state[0] - 1.0],
            name="cross",
            direction="rising",
            delay=lambda t, s, r, delay: delay,
            use_values_from_trigger_time=frozen,
        )


@pytest.mark.parametrize("python", ["called", "traced"])
@pytest.mark.parametrize("frozen", [False, True])
def test_a_queued_zero_crossing(frozen, python):
    """Frozen values set x to 0 at 1 / r + delay; others to r delay there."""
    run = saltus.simulate(
        Queue(frozen), time_span=(0.0, 0.9), sensitivity=["r", "delay"], python=python, **TIGHT
    )
    assert not run.sensitivity_gaps
    np.testing.assert_allclose(run.events.dt_dp("cross", kind="scheduled"), [[-0.25, 0.0]])
    executed = run.events.dt_dp("cross", kind="executed")
    np.testing.assert_allclose(executed, [[-0.25, 1.0]], rtol=1e-9)
    # x = r (t - 1 / r) without the kept part of the delay, or r (t - 1 / r - delay) with it
    expected = [[0.9 - 0.2, -2.0]] if frozen else [[0.9, 0.0]]
    np.testing.assert_allclose(run.sensitivities.continuous_state, expected, atol=1e-9)
