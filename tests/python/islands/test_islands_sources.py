"""Sources that only the time moves join nothing: each island has a copy, with its time events."""

import numpy as np
import pytest
import saltus
from saltus.library import Clock, DataSource, Gain, Integrator, Pulse, RandomNumber, Step

METHODS = ["dopri5", "dop853", "radau", "bdf", "adams", "auto"]


class Count(saltus.LeafSystem):
    """A discrete state that counts its own ticks."""

    def __init__(self, name):
        super().__init__(name=name)
        self.declare_discrete_state([0.0])
        self.declare_discrete_state_output("count")
        self.declare_periodic_update(lambda t, s: s.discrete_state + 1.0, period=0.3)


SOURCES = {
    "step": lambda: Step(step_time=0.4, name="source"),
    "pulse": lambda: Pulse(period=0.5, pulse_width=0.3, name="source"),
    "random": lambda: RandomNumber(dt=0.25, seed=3, name="source"),
    "table": lambda: DataSource([0.0, 0.3, 0.9], [1.0, -1.0, 2.0], name="source"),
    "count": lambda: Count("source"),
}


def scene(kind, *names):
    """Integrators of multiples of one source; the source is recorded too."""
    builder = saltus.DiagramBuilder()
    source = builder.add(SOURCES[kind]())
    builder.export_output(source.output(), "source")
    for name in names:
        gain = builder.add(Gain({"one": 1.0, "two": -2.0}[name], name=f"{name}_gain"))
        start = [0.0] if kind == "count" else 0.0
        x = builder.add(Integrator(start, name=name))
        builder.connect(source.output(), gain.input())
        builder.connect(gain.output(), x.input())
        builder.export_output(x.output(), name)
    return builder.build()


def run(system, span=(0.0, 2.0), context=None, **options):
    return saltus.simulate(system, context or system.create_context(), span, **options)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("kind", SOURCES)
def test_each_island_has_the_bits_of_its_part_alone(kind, method):
    system = scene(kind, "one", "two")
    results = run(system, islands=True, ode_solver_method=method)
    assert [island.name for island in results.islands] == ["one", "two"]
    for name in ("one", "two"):
        alone = run(scene(kind, name), ode_solver_method=method)
        assert np.array_equal(results[name], alone[name])
        assert np.array_equal(results.time_of(name), alone.time)
    common = run(system, ode_solver_method=method)
    assert np.array_equal(results.context.discrete_state, common.context.discrete_state)
    logged = [(e.time, e.block, e.name) for e in results.events]
    assert logged == [(e.time, e.block, e.name) for e in common.events]
    assert results.statistics.events_by_name == common.statistics.events_by_name


@pytest.mark.parametrize("kind", SOURCES)
@pytest.mark.parametrize("cut", [0.5, 0.9, 1.1])
def test_a_run_goes_on(kind, cut):
    system = scene(kind, "one", "two")
    whole = run(system, islands=True)
    first = run(system, (0.0, cut), islands=True)
    second = run(system, (cut, 2.0), first.context, islands=True)
    assert np.array_equal(second.context.discrete_state, whole.context.discrete_state)
    # The input is constant in pieces, or a line: a step makes roundings only.
    assert np.abs(second.context.continuous_state - whole.context.continuous_state).max() < 1e-13
    assert len(first.events) + len(second.events) == len(whole.events)


def test_a_source_that_nobody_reads_has_its_events():
    builder = saltus.DiagramBuilder()
    builder.add(Pulse(period=0.5, name="unread"))
    for name in ("one", "two"):
        clock = builder.add(Clock(name=f"{name}_clock"))
        builder.connect(clock.output(), builder.add(Integrator(0.0, name=name)).input())
    system = builder.build()
    apart, common = run(system, islands=True), run(system)
    assert len(apart.islands) == 3
    assert np.array_equal(apart.events.times("unread.rise"), common.events.times("unread.rise"))


def test_the_derivative_by_the_time_of_a_step():
    """x(2) = 2 - T and -2 (2 - T), where T is the time of the step."""
    system = scene("step", "one", "two")
    names = ["source.start_value", "source.end_value"]
    for islands in (False, True):
        found = run(system, islands=islands, sensitivity=names).sensitivities
        expected = [[0.4, 1.6], [-0.8, -3.2]]
        assert found.continuous_state == pytest.approx(np.array(expected), rel=1e-13)
