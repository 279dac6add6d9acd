"""Outputs with a period: y[k] = f(t, x, z, m, u) at t = offset + k period, held to the next tick."""

import numpy as np
import pytest

import saltus
from saltus.library import Gain, Integrator, RateTransition

METHODS = ["dopri5", "dop853", "taylor", "radau", "bdf", "adams", "auto"]


class Controller(saltus.LeafSystem):
    """u = -2 y - z, z[k+1] = z[k] + y[k] / 10, with the period 1/10; also u as it is at each time."""

    def __init__(self, sampled=True, called=False):
        super().__init__(name="controller")
        self.called = called
        self.declare_discrete_state([0.5])
        self.declare_default_mode(3)
        self.declare_dynamic_parameter("gain", 2.0)
        self.declare_input_port("y")
        ticks = {"period": 0.1, "offset": 0.05} if sampled else {}
        self.declare_output_port(self.command, name="u", **ticks)
        self.declare_periodic_update(self.integrate, period=0.1)

    def command(self, time, state, y, *, gain):
        if self.called:
            str(y)  # no trace can follow it
        return -gain * y - state.discrete_state[0]

    def integrate(self, time, state, y, *, gain):
        return state.discrete_state + 0.1 * y


def loop(controller, between=None):
    builder = saltus.DiagramBuilder()
    builder.add(controller)
    plant = builder.add(Integrator(1.0, name="plant"))
    source = controller.output("u")
    if between is not None:
        builder.add(between)
        builder.connect(source, between.input())
        source = between.output()
    builder.connect(source, plant.input())
    builder.connect(plant.output(), controller.input("y"))
    return builder.build(), {"u": source, "y": plant.output()}


def run(diagram, signals, method="dopri5", **options):
    return saltus.simulate(
        diagram, (0.0, 2.0), ode_solver_method=method, recorded_signals=signals, **options
    )


@pytest.mark.parametrize("called", [False, True])
@pytest.mark.parametrize("method", METHODS)
def test_it_is_a_rate_transition_behind_the_output(method, called):
    here = run(*loop(Controller(called=called)), method)
    behind = RateTransition(0.1, offset=0.05, name="behind")
    there = run(*loop(Controller(sampled=False, called=called), behind), method)
    for name in ("u", "y"):
        assert here[name].tolist() == there[name].tolist()
    assert here.time.tolist() == there.time.tolist()
    assert len(set(here["u"])) == 21  # 0 before the first of 20 ticks


def clock(period, offset=0.0, **options):
    block = saltus.LeafSystem()
    block.declare_output_port(lambda t, s: t, name="t", period=period, offset=offset, **options)
    return block


@pytest.mark.parametrize("offset", [0.0, 0.25, 1.0, -0.25])
@pytest.mark.parametrize("period", [0.5, 1 / 3])
def test_the_law(period, offset):
    times = np.linspace(0.0, 3.0, 61) + 1e-3  # off the ticks
    found = saltus.response(clock(period, offset, default_value=-7.0), t=times)
    ticks = np.floor((times - offset) / period) * period + offset
    # A negative offset has ticks before the run, which it does not see.
    expected = np.where((times < offset) | (ticks < 0.0), -7.0, ticks)
    assert np.abs(found - expected).max() <= 8 * np.finfo(float).eps * 3.0


def test_a_row_of_them_adds_no_delay():
    """A tick computes its outputs in the order of the wires."""
    builder = saltus.DiagramBuilder()
    blocks = [clock(0.5)]
    for _ in range(3):
        block = saltus.LeafSystem()
        block.declare_input_port("u")
        block.declare_output_port(lambda t, s, u: u + 1.0, period=0.5)
        blocks.append(block)
    builder.add(*blocks)
    for source, reader in zip(blocks, blocks[1:], strict=False):
        builder.connect(source.output(), reader.input())
    diagram = builder.build()
    found = saltus.simulate(diagram, (0.0, 1.6), recorded_signals={"y": blocks[-1].output()})
    assert sorted(set(found["y"])) == [3.0, 3.5, 4.0, 4.5]


def test_a_state_is_read_before_its_update():
    block = saltus.LeafSystem()
    block.declare_discrete_state([0.0])
    block.declare_output_port(lambda t, s: s.discrete_state[0], period=1.0)
    block.declare_periodic_update(lambda t, s: s.discrete_state + 1.0, period=1.0)
    assert saltus.response(block, t=[0.5, 1.5, 2.5]).tolist() == [0.0, 1.0, 2.0]


def test_a_vector():
    block = saltus.LeafSystem()
    block.declare_output_port(
        lambda t, s: [t, 2.0 * t], period=1.0, offset=0.5, default_value=[8.0, 9.0]
    )
    assert saltus.response(block, t=[0.2, 1.6]).tolist() == [[8.0, 9.0], [1.5, 3.0]]


@pytest.mark.parametrize("cut", [0.3, 0.35, 0.35 + 1e-9, 0.4])
def test_a_run_in_two_pieces(cut):
    """At, before and after a tick: no tick is lost or repeated."""
    diagram, signals = loop(Controller())
    whole = run(diagram, signals)
    first = saltus.simulate(diagram, (0.0, cut), recorded_signals=signals)
    second = saltus.simulate(diagram, first.context, (cut, 2.0), recorded_signals=signals)
    assert (
        second.context.discrete_state[1] == whole.context.discrete_state[1] == 19
    )  # the last tick
    assert abs(second["y"][-1] - whole["y"][-1]) < 1e-6  # rtol; cuts move the steps


def test_the_value_at_a_context():
    controller = Controller()
    diagram, signals = loop(controller)
    results = run(diagram, signals)
    assert controller.output("u").eval(results.context) == results["u"][-1]


def test_the_block_alone_has_plain_names():
    block = Controller()
    block.input("y").fix_value(3.0)
    context = block.create_context().with_parameter("gain", 4.0)
    assert context.parameters["gain"] == 4.0
    assert context.mode == 3 and context.with_mode(5).mode == 5
    assert context[block].discrete_state.tolist() == [0.5]
    results = saltus.simulate(block, context, (0.0, 0.08), recorded_signals=["u"])
    assert results["u"][-1] == -4.0 * 3.0 - (0.5 + 0.3)  # z after the tick at 0


def test_an_event_names_the_output():
    diagram, signals = loop(Controller())
    assert len(run(diagram, signals).events.times("controller.u.tick")) == 20
    assert "u.tick every 0.1 s" in diagram.to_mermaid()


@pytest.mark.parametrize(
    "options, message",
    [
        ({"period": 0.0}, "a period above 0"),
        ({"period": -1.0}, "a period above 0"),
        ({"period": np.nan}, "a period above 0"),
        ({"period": np.inf}, "a period above 0"),
        ({"period": 1.0, "offset": np.inf}, "a finite offset"),
        ({"offset": 1.0}, "an offset without a period; give both"),
        ({"period": 1.0, "default_value": [1.0], "shape": 2}, "default_value"),
        ({"period": "fast"}, "period"),
    ],
)
def test_bad_ticks(options, message):
    block = saltus.LeafSystem(name="block")
    with pytest.raises(saltus.ModelError, match=message):
        block.declare_output_port(lambda t, s: 1.0, name="y", **options)


def test_another_shape_than_declared():
    block = saltus.LeafSystem(name="block")
    block.declare_output_port(lambda t, s: [1.0, 2.0], name="y", period=1.0)
    with pytest.raises(saltus.ModelError, match=r"(?s)block.*y.*2"):
        saltus.response(block, t=[0.0, 1.0])


def test_an_algebraic_loop_through_it_is_refused():
    builder = saltus.DiagramBuilder()
    block = saltus.LeafSystem(name="block")
    block.declare_input_port("u")
    block.declare_output_port(lambda t, s, u: u, name="y", period=1.0)
    gain = builder.add(block, Gain(2.0))[1]
    builder.connect(block.output(), gain.input())
    builder.connect(gain.output(), block.input())
    with pytest.raises(saltus.ModelError, match="algebraic loop"):
        builder.build()
