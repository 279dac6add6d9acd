"""Whatever the damage, a loader answers with a ModelError or with something sound."""

from damage import KINDS, try_loaders


def test_damaged_files_and_contexts_are_refused_or_sound():
    refused = try_loaders(1400)
    assert set(refused) == set(KINDS)  # some of each kind
    assert sum(refused.values()) > 700
