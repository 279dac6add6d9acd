"""The periodic updates and one-shots of a Python block."""

import pytest
import saltus
from declared import Block
from saltus.library import Integrator
from systems import run


@pytest.mark.parametrize("whole_state", [True, False])
def test_periodic_update(whole_state):
    """It may give a state, or the discrete state alone."""

    def count(t, s):
        return (
            s.with_discrete_state(s.discrete_state + 1.0) if whole_state else s.discrete_state + 1.0
        )

    def declare(self):
        self.declare_discrete_state(default_value=[0.0])
        self.declare_discrete_state_output("count")
        self.declare_periodic_update(count, period=1 / 3, offset=0.5)

    results = run(Block(declare), (0.0, 0.5 + 99 / 3))
    assert results.context.discrete_state == [
        100.0
    ]  # 100 ticks of 1/3 s, the first at 0.5 s, the last at the end
    assert results.events[0].time == 0.5


def test_one_shot():
    def declare(self):
        self.declare_continuous_state(1, ode=lambda t, s: [1.0])
        self.declare_one_shot(lambda t, s: s.with_continuous_state([0.0]), 0.75, name="back")

    system = Block(declare)
    results = saltus.simulate(system, system.create_context(), (0.0, 1.0))
    assert results.events.times("back", kind="time").tolist() == [0.75]
    assert results.context.continuous_state[0] == pytest.approx(0.25, abs=1e-15)


def test_a_discrete_controller_restarts_what_it_drives():
    """The output reads everything, so nothing but the update says that it jumped."""

    def declare(self):
        self.declare_discrete_state(default_value=[1.0])
        self.declare_output_port(lambda t, s: s.discrete_state[0], name="u")
        self.declare_periodic_update(lambda t, s: -s.discrete_state, period=1.0, offset=1.0)

    builder = saltus.DiagramBuilder()
    controller, plant = builder.add(Block(declare), Integrator(name="plant"))
    builder.connect(controller.output(), plant.input())
    diagram = builder.build()
    results = saltus.simulate(diagram, diagram.create_context(), (0.0, 3.5))
    assert results.statistics.restarts == 3
    assert results.context.continuous_state[0] == pytest.approx(
        0.5, abs=1e-14
    )  # straight lines are exact
