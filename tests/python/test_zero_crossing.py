"""The options of a zero crossing: what they do, and what is refused."""

import numpy as np
import pytest
import saltus


class Block(saltus.LeafSystem):
    """dx/dt = (1, -1) from (0, 0), and one zero crossing."""

    def __init__(self, guard=None, reset_map=None, **options):
        super().__init__(name="block")
        self.declare_continuous_state(2, ode=lambda t, s: [1.0, -1.0])
        self.declare_discrete_state([0.0])
        self.declare_zero_crossing(
            guard or (lambda t, s: s.continuous_state[0] - 0.5), reset_map, name="cross", **options
        )


def go(block, end=1.0, **options):
    return saltus.simulate(block, block.create_context(), (0.0, end), **options)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (
            {"direction": "upwards"},
            "unknown direction 'upwards'; Known: 'none', 'crosses_zero', "
            "'positive_then_non_positive', 'negative_then_non_negative', 'edge_detection'",
        ),
        (
            {"at_start": "fires"},
            "unknown at_start 'fires'; did you mean 'fire'? "
            "Known: 'auto', 'ignore', 'fire', 'error'",
        ),
        (
            {"on_zeno": "halt"},
            "unknown on_zeno 'halt'; did you mean 'hold'? Known: 'hold', 'stop', 'error'",
        ),
        (
            {"on_zeno": 1.5},
            "on_zeno: expected 'hold', 'stop', 'error' or a mode, an integer, found 1.5",
        ),
        ({"at_start": None}, "at_start: expected a name, found None"),
        ({"size": "two"}, "size: expected a number of guards, 1 or more, found 'two'"),
        ({"max_count": 1.5}, "max_count: expected a count, 1 or more, found 1.5"),
        (
            {"start_mode": "fast"},
            "unknown mode 'fast'; name the modes first: declare_default_mode(0, names=['off', 'on'])",
        ),
        ({"zeno_tolerance": "small"}, "zeno_tolerance: expected a time [s], found 'small'"),
        (
            {"holds": [0, 1], "size": 2},
            "holds: expected a list for each guard, of positions in the continuous state, "
            "found [0, 1]",
        ),
    ],
)
def test_an_option_of_the_wrong_kind_is_refused_with_what_was_expected(options, message):
    with pytest.raises(saltus.ModelError) as caught:
        Block(**options)
    assert str(caught.value) == f"block 'block': zero crossing 'cross': {message}"


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"size": 0}, "has 0 guards; expected 1 or more"),
        ({"max_count": 0}, "has max_count 0; expected 1 or more"),
        ({"max_count": 2}, "has max_count 2 but is not terminal; set terminal too"),
        ({"zeno_tolerance": -1.0}, "has zeno_tolerance -1; expected a time >= 0 s"),
        ({"zeno_tolerance": np.nan}, "has zeno_tolerance nan; expected a time >= 0 s"),
        (
            {"holds": [[0], [1]]},
            "has 1 guards and 2 lists of states to hold; give one list for each guard",
        ),
        (
            {"holds": [[0, 2]]},
            "holds state 2; the block has 2 continuous states, declared before it",
        ),
    ],
)
def test_options_that_make_no_sense_are_refused(options, message):
    with pytest.raises(saltus.ModelError) as caught:
        Block(**options)
    assert str(caught.value) == f"block 'block': zero crossing 'cross' {message}"


def test_an_unknown_option_is_answered_with_the_nearest():
    with pytest.raises(saltus.ModelError, match="unknown option 'max_counts'; did you mean 'max_"):
        Block(max_counts=3)


@pytest.mark.parametrize("on_zeno", ["hold", "stop", "error", 3, np.int64(3)])
@pytest.mark.parametrize("at_start", ["auto", "ignore", "fire", "error"])
def test_options_that_say_nothing_about_a_plain_crossing_change_nothing(at_start, on_zeno):
    block = Block(at_start=at_start, on_zeno=on_zeno, holds=[[0]], direction="crosses_zero")
    assert go(block).events.times("cross") == pytest.approx([0.5], abs=1e-12)


def test_entry_is_zero_where_there_is_one_guard():
    entries = []

    def note(time, state):
        entries.append(state.entry)
        return state.with_discrete_state([1.0])

    go(Block(reset_map=note))
    assert entries == [0]


def test_directions_in_one_word_are_the_long_ones():
    times = {}
    for direction in ("rising", "negative_then_non_negative", "falling", "both", "crosses_zero"):
        swing = saltus.LeafSystem(name="swing")
        swing.declare_continuous_state(
            np.array([1.0, 0.0]), ode=lambda t, s: s.continuous_state[::-1] * np.array([1.0, -1.0])
        )
        swing.declare_zero_crossing(
            lambda t, s: s.continuous_state[0], name="middle", direction=direction
        )
        results = saltus.simulate(swing, swing.create_context(), (0.0, 10.0))
        times[direction] = results.events.times().tolist()
    assert len(times["both"]) == 3  # cos t: down at pi/2, up at 3 pi/2, down at 5 pi/2
    assert times["rising"] == times["negative_then_non_negative"]
    assert times["both"] == times["crosses_zero"] == sorted(times["rising"] + times["falling"])
