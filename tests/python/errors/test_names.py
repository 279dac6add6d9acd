"""A name with a dot is refused where names make paths; that of an event may have one."""

import pytest
import saltus
from saltus.library import Constant, Gain


def leaf(name=None, **declared):
    block = saltus.LeafSystem(name=name)
    block.declare_continuous_state([0.0], ode=lambda t, s: [1.0])
    return block


@pytest.mark.parametrize(
    ("make", "what"),
    [
        (lambda: saltus.LeafSystem(name="a.b"), "block 'a.b'"),
        (lambda: Constant(1.0, name="a.b"), "block 'a.b'"),
        (lambda: leaf("b").declare_input_port("u.v"), "block 'b': input 'u.v'"),
        (
            lambda: leaf("b").declare_output_port(lambda t, s: t, "y.z"),
            "block 'b': output 'y.z'",
        ),
        (lambda: leaf("b").declare_continuous_state_output("x.y"), "block 'b': output 'x.y'"),
        (lambda: leaf("b").declare_dynamic_parameter("k.l", 1.0), "block 'b': parameter 'k.l'"),
    ],
)
def test_a_dot_is_refused_where_the_name_is_made(make, what):
    with pytest.raises(saltus.ModelError) as caught:
        make()
    assert str(caught.value) == (
        f"{what}: a dot separates the names of a path; expected a name without one, such as with "
        "'_' in its place"
    )


def test_a_diagram_and_its_ports_have_no_dot_and_the_builder_goes_on():
    builder = saltus.DiagramBuilder()
    gain = builder.add(Gain(2.0, name="gain"))
    with pytest.raises(saltus.ModelError, match=r"input 'u\.v': a dot separates"):
        builder.export_input(gain.input(), "u.v")
    with pytest.raises(saltus.ModelError, match=r"output 'y\.z': a dot separates"):
        builder.export_output(gain.output(), "y.z")
    builder.export_input(gain.input(), "u")
    with pytest.raises(saltus.ModelError, match=r"diagram 'a\.b': a dot separates"):
        builder.build("a.b")
    assert builder.build("ab").input_names == ["u"]


NAMES = ("x=0.5", "a.b", "block.other", "0.5")


@pytest.mark.parametrize("kept", [False, True])
def test_3_an_event_with_dots_in_its_name_is_found_by_it_and_by_its_path(kept, tmp_path):
    """The guard 'other' has the path that is the own name of another guard."""
    block = leaf("block")
    for k, name in enumerate([*NAMES, "other"]):
        block.declare_zero_crossing(
            lambda t, s, level=0.1 * (k + 1): s.continuous_state[0] - level, name=name
        )
    results = saltus.simulate(block, (0, 1))
    if kept:
        results.save(tmp_path / "run.npz")
        results = saltus.load_results(tmp_path / "run.npz")
    times = results.events.times
    for k, name in enumerate(NAMES):
        # x = t: one number is added to another a few times
        assert times(f"block.{name}") == pytest.approx([0.1 * (k + 1)], abs=1e-14)
        if name != "block.other":
            assert times(name) == pytest.approx([0.1 * (k + 1)], abs=1e-14)
    assert times("block.other") == pytest.approx([0.5], abs=1e-14)  # the path goes first
    assert times("other") == pytest.approx([0.5], abs=1e-14)
    assert [(e.block, e.name) for e in results.events] == [("block", n) for n in [*NAMES, "other"]]
    assert results.events[:2].times("a.b") == pytest.approx([0.2], abs=1e-14)
    with pytest.raises(saltus.ModelError, match="no event is called"):
        times("c.d")


def test_3_guards_of_solve_may_have_dots():
    guards = [saltus.Guard(lambda t, x, v=v: x[0] - v, name=f"x={v}") for v in (0.25, 0.5, 0.75)]
    solution = saltus.solve(lambda t, x: [1.0], (0, 1), [0.0], events=guards)
    assert [len(t) for t in solution.t_events] == [1, 1, 1]
    assert [y[0][0] for y in solution.y_events] == pytest.approx([0.25, 0.5, 0.75], abs=1e-14)


@pytest.mark.parametrize("kept", [False, True])
def test_times_of_a_name_are_all_its_firings(kept, tmp_path):
    block = leaf("block")
    block.declare_discrete_state([0.0])
    block.declare_zero_crossing(
        lambda t, s: s.continuous_state[0] % 0.25 - 0.125,
        name="twice",
        direction="rising",
        terminal=True,
        max_count=2,
    )
    block.declare_periodic_update(lambda t, s: s.discrete_state + 1.0, 0.1, name="tick")
    results = saltus.simulate(block, (0, 1))
    if kept:
        results.save(tmp_path / "run.npz")
        results = saltus.load_results(tmp_path / "run.npz")
    assert results.status == "terminal"
    log = results.events
    assert log.times("twice") == pytest.approx([0.125, 0.375], abs=1e-12)
    assert log.times("twice", "zero_crossing").size == log.times("twice", "terminal").size == 1
    assert log.times("tick") == pytest.approx([0.0, 0.1, 0.2, 0.3], abs=1e-15)
    assert log.times("tick", "time").tolist() == log.times("tick").tolist()
    assert log.times().tolist() == sorted([*log.times("twice"), *log.times("tick")])


@pytest.mark.parametrize("name", ["x", "z", "mode"])
def test_a_parameter_called_as_a_state_is_two_things(name):
    block = leaf("b")
    block.declare_discrete_state([0.0])
    block.declare_dynamic_parameter(name, 1.0)
    with pytest.raises(saltus.ModelError, match=f"'{name}' is a parameter of block 'b' and its"):
        saltus.sweep(block, {name: [1.0, 2.0]}, (0, 1), as_dict=True)
    block.create_context().with_parameter(name, 3.0)  # a parameter is meant here, and no state
