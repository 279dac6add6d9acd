"""Some random chains of blocks, each with the events that dense sampling says."""

import pytest

from chains import wrong


@pytest.mark.parametrize("first", range(0, 60, 10))
def test_a_chain_has_the_events_of_dense_sampling(first):
    assert [text for seed in range(first, first + 10) if (text := wrong(seed))] == []
