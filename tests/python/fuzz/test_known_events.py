"""Guards that jump, states that wrap, indices and directions that toggle."""

from known_events import KINDS, try_scenes


def test_scenes_of_known_events_have_them():
    ran = try_scenes(240)
    assert set(ran) == set(KINDS)  # some of each kind
    assert sum(ran.values()) > 200
