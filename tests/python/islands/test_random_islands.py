"""Random diagrams with and without islands: the same events, and each island alone to the bit."""

import numpy as np
import saltus
from hypothesis import given, settings
from hypothesis import strategies as st
from parts import add_ball, add_pair, add_room, add_sampled

END = 2.0


def of(low, high):
    return st.floats(low, high).map(lambda x: round(x, 6))


# A ball comes to rest after (1 + e) / (1 - e) sqrt(2 h / g), which is 2.5 s or more here.
PART = st.one_of(
    st.tuples(st.just(add_ball), of(1.0, 3.0), of(0.7, 0.95)),
    st.tuples(st.just(add_room), of(30.0, 60.0), of(15.0, 20.5)),
    st.tuples(st.just(add_sampled), of(0.05, 0.5), of(0.5, 5.0)),
    st.tuples(st.just(add_pair), of(-1.0, 1.0), of(-1.0, 1.0)),
)


def scene(parts):
    builder = saltus.DiagramBuilder()
    for i, (add, first, second) in parts:
        add(builder, f"part{i}", first, second)
    return builder.build()


def run(parts, islands, method):
    options = {"rtol": 1e-9, "atol": 1e-9, "ode_solver_method": method, "islands": islands}
    return saltus.simulate(scene(parts), (0.0, END), **options)


def by_block(results):
    found = {}
    for e in results.events:
        found.setdefault(e.block, []).append((e.name, e.kind, e.time))
    return found


@settings(max_examples=30, deadline=None)
@given(
    parts=st.lists(PART, min_size=2, max_size=5),
    method=st.sampled_from(["auto", "dopri5", "dop853", "radau", "bdf", "adams"]),
)
def test_random_diagrams(parts, method):
    parts = list(enumerate(parts))
    apart, common = run(parts, True, method), run(parts, False, method)
    assert len(apart.islands) == len(parts)
    for part in parts:
        alone = run([part], False, method)
        name = f"part{part[0]}"
        assert np.array_equal(apart.outputs[name], alone.outputs[name])
        assert np.array_equal(apart.time_of(name), alone.time)
        found = by_block(apart)
        for block, events in by_block(alone).items():
            assert found[block] == events
    times = [e.time for e in apart.events]
    assert times == sorted(times)
    # Each run has an error of at most rtol |x| + atol a step. Where events of others cut its steps,
    # a part has up to 500 of them; |x| <= 60 gives 500 * 6e-8 = 3e-5 in a state. A guard is crossed
    # at a speed of 1 or more: sqrt(2 g h) e^4 of a ball, 9 K/s of a room. An event inherits the
    # errors of those before it, ten at most.
    tolerance = 10 * 3e-5 / 1
    one, other = by_block(apart), by_block(common)
    assert one.keys() == other.keys()
    for block in one:
        near_end = [e for e in one[block] + other[block] if END - e[2] < tolerance]
        if near_end:
            continue
        assert [e[:2] for e in one[block]] == [e[:2] for e in other[block]]
        np.testing.assert_allclose(
            [e[2] for e in one[block]], [e[2] for e in other[block]], rtol=0, atol=tolerance
        )
    np.testing.assert_allclose(
        apart.context.discrete_state, common.context.discrete_state, rtol=0, atol=tolerance
    )
