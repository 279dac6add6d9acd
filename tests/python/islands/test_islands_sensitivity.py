"""Derivatives of a run by islands: each island has those of its part alone."""

import numpy as np
import pytest
import saltus
from saltus.library import Constant

G, E = 9.81, 0.8
METHODS = ["dopri5", "dop853", "radau", "bdf", "adams", "auto"]


class Ball(saltus.LeafSystem):
    """y'' = -g, and y' := -e y' at the floor; without a hold, so that a run may end anywhere."""

    def __init__(self, name, height=1.0, pulled=False):
        super().__init__(name=name)
        self.declare_continuous_state([height, 0.0], names=["y", "v"], ode=self.ode)
        self.declare_dynamic_parameter("e", E)
        if pulled:
            self.declare_input_port("g")
        self.declare_zero_crossing(
            guard=lambda t, s, *u, e: s.continuous_state[0],
            reset_map=self.bounce,
            direction="falling",
            name="bounce",
        )

    def ode(self, t, s, g=G, *, e):
        return [s.continuous_state[1], -g]

    def bounce(self, t, s, *u, e):
        return s.with_continuous_state([0.0, -e * s.continuous_state[1]])


def balls(**heights):
    builder = saltus.DiagramBuilder()
    for name, height in heights.items():
        builder.export_output(builder.add(Ball(name, height)).output("y"), name)
    return builder.build()


def run(system, names, until=1.0, islands=True, **options):
    return saltus.simulate(system, (0.0, until), islands=islands, sensitivity=names, **options)


@pytest.mark.parametrize("method", METHODS)
def test_each_island_has_the_derivatives_of_its_part_alone(method):
    heights = {"one": 1.0, "two": 2.0, "three": 1.5}
    names = ["two.e", "one.y", "two.x", "one.e"]
    columns = {"one": [1, 4], "two": [0, 2, 3], "three": []}
    results = run(balls(**heights), names, ode_solver_method=method)
    found = results.sensitivities
    assert list(found.parameters) == ["two.e", "one.y", "two.x[0]", "two.x[1]", "one.e"]
    for first, (name, height) in zip((0, 2, 4), heights.items(), strict=True):
        own = [n for n in names if n.startswith(name)]
        expected = np.zeros((len(results.time_of(name)), 5))
        final = np.zeros((2, 5))
        if own:
            alone = run(balls(**{name: height}), own, ode_solver_method=method)
            expected[:, columns[name]] = alone.sensitivities[name]
            final[:, columns[name]] = alone.sensitivities.continuous_state
            times = results.events.dt_dp(f"{name}.bounce")
            assert np.array_equal(
                times[:, columns[name]], alone.events.dt_dp(f"{name}.bounce"), equal_nan=True
            )
            assert np.count_nonzero(np.delete(times, columns[name], axis=1)) == 0
        assert np.array_equal(found[name], expected)
        assert np.array_equal(found.continuous_state[first : first + 2], final)


def test_balls_that_land_together_have_derivatives():
    """In closed form y(t) = v t' - g t'^2 / 2 with v = e g T, t' = t - T and g T^2 = 2 h: so
    dy/dh = (e g - v / T) t' / (g T) - (v - g t') / (g T), and dy/de = g T t'.
    """
    system, names = balls(one=1.0, two=1.0), ["one.y", "two.y", "one.e"]
    fall = np.sqrt(2.0 / G)
    rise = 0.8 - fall
    by_height = E * rise / fall - (E * G * fall - G * rise) / (G * fall)
    by_e = G * fall * rise
    expected = np.array([[by_height, 0.0, by_e], [0.0, by_height, 0.0]])
    apart = run(system, names, 0.8)
    assert not apart.sensitivities.gaps
    found = apart.sensitivities.continuous_state[[0, 2]]
    # Parabolas: a method makes no error but that of the event time, some roundings of 1 s, which the
    # flow, up to 10 m/s, and its derivatives multiply.
    assert np.abs(found - expected).max() < 1e-12
    assert apart.events.dt_dp("one.bounce")[0] == pytest.approx([1 / (G * fall), 0.0, 0.0])
    # With one common step the two events are a tie, of which the order would change.
    assert run(system, names, 0.8, islands=False).sensitivities.gaps


def test_a_gap_is_that_of_its_own_island():
    """At v = 0 the guard of the second block only grazes zero."""
    builder = saltus.DiagramBuilder()
    builder.export_output(builder.add(Ball("one", 1.0)).output("y"), "one")
    graze = saltus.LeafSystem(name="graze")
    graze.declare_continuous_state([0.0], ode=lambda t, s, *, k: [k], names=["p"])
    graze.declare_dynamic_parameter("k", 1.0)
    graze.declare_zero_crossing(
        lambda t, s, *, k: (s.continuous_state[0] - 0.25) ** 3,
        lambda t, s, *, k: [0.0],
        direction="rising",
        name="cubic",
    )
    builder.add(graze)
    results = run(builder.build(), ["one.e", "graze.k"], 0.8)
    assert {gap.parameter for gap in results.sensitivities.gaps} == {"graze.k"}
    final = results.sensitivities.continuous_state
    assert np.isfinite(final[:2]).all() and np.isnan(final[2, 1])
    assert final[2, 0] == 0.0


def test_a_source_that_islands_copy_is_one_parameter():
    builder = saltus.DiagramBuilder()
    pull = builder.add(Constant(G, name="pull"))
    for name, height in (("one", 1.0), ("two", 3.0)):
        ball = builder.add(Ball(name, height, pulled=True))
        builder.connect(pull.output(), ball.input("g"))
        builder.export_output(ball.output("y"), name)
    system = builder.build()
    apart = run(system, ["pull.value"], 0.7)
    assert len(apart.islands) == 2
    common = run(system, ["pull.value"], 0.7, islands=False)
    final = apart.sensitivities.continuous_state
    assert np.count_nonzero(final) == 4
    assert np.abs(final - common.sensitivities.continuous_state).max() < 1e-12  # parabolas


@pytest.mark.parametrize("cut", [0.3, 0.5])
def test_pieces_and_a_table(cut):
    system, names = balls(one=1.0, two=2.0), ["one.e", "two.y"]
    times = np.linspace(0.0, 1.0, 11)
    options = {"save_at": times, "event_rows": False, "save_steps": False}
    whole = run(system, names, **options)
    assert whole.sensitivities["one"].shape == (len(whole.time), 2)
    simulator = saltus.Simulator(system, islands=True, sensitivity=names, **options)
    simulator.initialize(system.create_context())
    for end in (cut, 1.0):
        simulator.advance_to(end)
    pieces = simulator.results
    for name in ("one", "two"):
        # A cut ends a step, which changes nothing but roundings of a parabola.
        assert pieces.sensitivities[name] == pytest.approx(whole.sensitivities[name], abs=1e-12)
    assert pieces.sensitivities.continuous_state == pytest.approx(
        whole.sensitivities.continuous_state, abs=1e-12
    )


def test_a_gap_of_an_earlier_piece_stays():
    system = balls(one=0.0, two=2.0)  # the first begins at zero, where its guard has one side
    simulator = saltus.Simulator(system, islands=True, sensitivity=["one.y", "two.y"])
    simulator.initialize(system.create_context())
    gaps = []
    for end in (0.1, 0.2):
        simulator.advance_to(end)
        gaps.append([(gap.time, gap.parameter) for gap in simulator.results.sensitivities.gaps])
    assert gaps[0] == gaps[1] == [(0.0, "one.y")]


def test_more_states_than_one_island_may_have():
    count = 150  # with one common step 200 states are the most
    system = balls(**{f"ball{i}": 1.0 + 0.01 * i for i in range(count)})
    results = run(system, ["ball7.y", "ball149.e"], 0.8, recorded_signals={})
    final = results.sensitivities.continuous_state
    assert np.nonzero(final.any(axis=1))[0].tolist() == [14, 15, 298, 299]


def test_a_hold_of_one_island():
    """The predicted Zeno time T (1 + e) / (1 - e) of a ball, by its height; the other has none."""
    system = balls(one=1.0, two=50.0)
    results = run(system, ["one.y", "two.y"], 5.0)
    assert len(results.events.times("one.bounce", kind="zeno_enter")) == 1
    enters = results.events.dt_dp("one.bounce", kind="zeno_enter")
    fall = np.sqrt(2.0 / G)
    # Parabolas make no error, and the rest of the geometric series is summed: each of some 60
    # bounces adds roundings.
    assert enters[0] == pytest.approx([(1 + E) / (1 - E) / (G * fall), 0.0], rel=1e-11)


@pytest.mark.parametrize(
    "name, message", [("one.f", "one.f"), ("e", "one.e"), ("one.mode", "mode")]
)
def test_names_are_refused_as_without_islands(name, message):
    system = balls(one=1.0, two=2.0)
    texts = set()
    for islands in (False, True):
        with pytest.raises(saltus.ModelError, match=message) as error:
            run(system, [name], islands=islands)
        texts.add(str(error.value))
    assert len(texts) == 1
