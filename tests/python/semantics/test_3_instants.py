"""Section 3: what happens in one instant, and in which order."""

import numpy as np
import pytest
import saltus
from blocks import Block, crossing, go, ramp, x
from saltus.library import Comparator, Constant, Gain, Integrator, Pulse, Step, Switch, UnitDelay

METHODS = ["dopri5", "adams", "bdf", "radau", "taylor", "auto"]


def counter(*times, name="counter"):
    def declare(self):
        self.declare_discrete_state([0.0])
        self.declare_discrete_state_output("z")
        for i, time in enumerate(times):
            self.declare_one_shot(lambda t, s: s.discrete_state + 1.0, time, name=f"shot{i}")

    return Block(declare, name)


def test_3_1_events_at_the_start_and_at_the_end_happen():
    results = go(counter(0.0, 0.5, 1.0), 1.0)
    assert [(e.time, e.jump) for e in results.events] == [(0.0, 1), (0.5, 2), (1.0, 3)]
    assert results.outputs["z"][:, 0].tolist() == [0.0, 1.0, 1.0, 2.0, 2.0, 3.0]


def test_3_1_equal_times_are_one_instant():
    builder = saltus.DiagramBuilder()
    builder.add(counter(0.3, name="a"), counter(3 * 0.1, 0.7, name="b"))  # 3 * 0.1 > 0.3
    diagram = builder.build()
    results = saltus.simulate(diagram, diagram.create_context(), (0.0, 1.0))
    assert [e.jump for e in results.events] == [1, 1, 2]


def test_3_3_of_two_updates_of_one_block_at_one_time_the_second_sees_the_first():
    assert go(counter(0.5, 0.5), 1.0).context.discrete_state.tolist() == [2.0]


def test_3_2_within_a_leaf_in_the_order_of_declaration_each_sees_the_one_before():
    def declare(self):
        ramp()(self)
        self.declare_discrete_state([1.0])
        for name, f in (("double", lambda z: 2.0 * z), ("add", lambda z: z + 3.0)):
            self.declare_zero_crossing(
                lambda t, s: x(t, s) - 0.5,
                lambda t, s, f=f: s.with_discrete_state(f(s.discrete_state)),
                name=name,
            )

    results = go(Block(declare), 1.0)
    assert [e.name for e in results.events] == ["double", "add"]
    assert len({e.jump for e in results.events}) == 1
    assert results.context.discrete_state.tolist() == [5.0]


def swap(wired):
    """Two blocks that take over each other's value at 0.5 s."""
    builder = saltus.DiagramBuilder()
    blocks = []
    for name, value in (("a", 1.0), ("b", 2.0)):

        def declare(self, value=value):
            self.declare_input_port("other")
            self.declare_discrete_state([value])
            self.declare_discrete_state_output("z")
            wired(self)

        blocks.append(builder.add(Block(declare, name)))
    builder.connect(blocks[0].output(), blocks[1].input())
    builder.connect(blocks[1].output(), blocks[0].input())
    diagram = builder.build()
    return saltus.simulate(diagram, diagram.create_context(), (0.0, 0.7)).context.discrete_state


def test_3_2_across_leaves_every_reset_map_sees_the_state_before_the_pass():
    def wired(self):
        self.declare_zero_crossing(
            lambda t, s, u: t - 0.5, lambda t, s, u: s.with_discrete_state(u), name="swap"
        )

    assert swap(wired).tolist() == [2.0, 1.0]


def test_3_3_updates_of_one_time_swap_through_each_other():
    assert swap(
        lambda self: self.declare_periodic_update(lambda t, s, u: u, 0.5, 0.5)
    ).tolist() == [
        2.0,
        1.0,
    ]


def ticks(period, offset=0.0):
    def declare(self):
        self.declare_discrete_state([0.0])
        self.declare_periodic_update(lambda t, s: s.discrete_state + 1.0, period, offset)

    return Block(declare)


def test_3_3_a_thousand_periods_are_a_thousand_ticks():
    # at 0, 1/3, ..., 1000/3
    assert go(ticks(1 / 3), 1000 / 3).context.discrete_state.tolist() == [1001.0]


@pytest.mark.parametrize(
    "split", [1 / 3, 0.5, 2 / 3, np.nextafter(1 / 3, 0), np.nextafter(1 / 3, 1)]
)
def test_3_3_a_split_run_neither_repeats_nor_loses_a_tick(split):
    system = ticks(1 / 3)
    simulator = saltus.Simulator(system)
    simulator.initialize(system.create_context())
    simulator.advance_to(split)
    simulator.advance_to(2.0)
    assert simulator.context.discrete_state.tolist() == [7.0]
    first = go(system, split)
    assert go(system, 2.0, split, first.context).context.discrete_state.tolist() == [7.0]


def chain(length, **options):
    """A step into a row of integrators, each reset by the edge that the one before made."""
    builder = saltus.DiagramBuilder()
    one, step = builder.add(Constant(1.0), Step(start_value=0.0, end_value=1.0, step_time=0.5))
    trigger = step.output()
    for i in range(length):
        above = builder.add(Comparator(">", name=f"above{i}"))
        y = builder.add(
            Integrator(-1.0, name=f"y{i}", enable_reset=True, enable_external_reset=True)
        )
        builder.connect(builder.add(Constant(0.0, name=f"zero{i}")).output(), y.input())
        builder.connect(trigger, y.input("reset_trigger"))
        builder.connect(one.output(), y.input("reset_value"))
        builder.connect(y.output(), above.input(0))
        builder.connect(builder.add(Constant(0.0, name=f"level{i}")).output(), above.input(1))
        trigger = above.output()
    diagram = builder.build()
    return saltus.simulate(diagram, diagram.create_context(), (0.0, 1.0), **options)


def test_3_4_what_a_commit_moves_across_zero_fires_in_the_next_pass_of_the_same_time():
    results = chain(4)
    resets = [e for e in results.events if e.name == "reset"]
    assert [e.block for e in resets] == ["y0", "y1", "y2", "y3"]
    assert {e.time for e in resets} == {0.5}
    jumps = [e.jump for e in resets]
    assert jumps == list(range(jumps[0], jumps[0] + 4))
    assert np.all(results.context.continuous_state == 1.0)


def test_3_4_too_many_passes_are_an_error_with_the_chain_of_causes():
    with pytest.raises(saltus.SimulationError, match="max_passes") as caught:
        chain(6, max_passes=3)
    message = str(caught.value)
    assert message.startswith("t = 0.5 s: ")
    assert "y0" in message
    assert caught.value.results.status == "failed"


def test_3_5_a_relation_at_its_own_root_takes_the_side_of_the_crossing():
    """dx/dt = 1 below 0.5, then 3: the switch is read once, at the crossing."""
    builder = saltus.DiagramBuilder()
    fast, slow, level, above, choice, y = builder.add(
        Constant(3.0), Constant(1.0), Constant(0.5), Comparator(">"), Switch(), Integrator(name="x")
    )
    builder.connect(y.output(), above.input(0))
    builder.connect(level.output(), above.input(1))
    builder.connect(fast.output(), choice.input("true_value"))
    builder.connect(above.output(), choice.input("control"))
    builder.connect(slow.output(), choice.input("false_value"))
    builder.connect(choice.output(), y.input())
    diagram = builder.build()
    results = saltus.simulate(diagram, diagram.create_context(), (0.0, 1.0), rtol=1e-9)
    assert results.context.continuous_state == pytest.approx([2.0], abs=1e-9)
    assert len(results.events) == 1


def test_3_6_writing_an_equal_value_is_a_reset_and_reading_is_none():
    written = crossing(
        lambda t, s: x(t, s) - 0.5, lambda t, s: s.with_continuous_state(s.continuous_state)
    )
    read = crossing(lambda t, s: x(t, s) - 0.5, lambda t, s: s)
    assert go(written, 1.0).statistics.restarts - go(read, 1.0).statistics.restarts == 1


def test_3_7_a_leaf_sees_the_guards_of_its_mode_and_enters_the_next():
    def declare(self):
        ramp()(self)
        self.declare_default_mode(0)
        for mode, level in ((0, 0.2), (1, 0.1), (1, 0.6), (2, 0.8)):
            self.declare_zero_crossing(
                lambda t, s, level=level: x(t, s) - level,
                name=f"{mode} at {10 * level:.0f}",
                start_mode=mode,
                end_mode=mode + 1,
            )

    results = go(Block(declare), 1.0)
    # 0.1 is passed before mode 1 is entered: it waits
    assert [e.name for e in results.events] == ["0 at 2", "1 at 6", "2 at 8"]
    assert results.context.mode == 3


def test_3_9_a_terminal_event_applies_its_reset_and_has_the_last_row():
    system = crossing(
        lambda t, s: x(t, s) - 0.5, lambda t, s: s.with_continuous_state([7.0]), terminal=True
    )
    results = go(system, 1.0)
    assert results.status == "terminal"
    assert results.context.time == results.time[-1] == pytest.approx(0.5)
    assert results.outputs["x"][-2:, 0] == pytest.approx([0.5, 7.0])
    assert results.context.continuous_state.tolist() == [7.0]


def test_3_9_max_count_ends_the_run_on_the_nth_time():
    system = crossing(lambda t, s: np.sin(2 * np.pi * t), terminal=True, max_count=3)
    results = go(system, 9.9, begin=0.1, max_minor_step_size=0.1)
    assert results.status == "terminal"
    assert results.context.time == pytest.approx(1.5, abs=1e-9)


def restarts(trigger_reads):
    """Of an integrator beside a pulse that does or does not reach its derivative."""
    builder = saltus.DiagramBuilder()
    pulse, one, y, delay, gain = builder.add(
        Pulse(period=0.5), Constant(1.0), Integrator(name="y"), UnitDelay(0.5), Gain(2.0)
    )
    builder.connect(pulse.output(), delay.input())
    builder.connect(pulse.output(), gain.input())
    builder.connect(pulse.output() if trigger_reads else one.output(), y.input())
    diagram = builder.build()
    results = saltus.simulate(diagram, diagram.create_context(0.1), (0.1, 1.9))
    return results.statistics.restarts


def test_3_10_only_what_the_derivatives_read_restarts_the_solver():
    assert restarts(False) == 0
    assert restarts(True) == 7  # at 0.25, 0.5, ..., 1.75
