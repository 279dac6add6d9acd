"""Callbacks that read and write outside the state: traced or called, a run has one answer."""

from draw_effects import stories
from hypothesis import given
from side_effects import check_one_answer
from test_fuzz import several


@several
@given(stories())
def test_a_run_has_one_answer_traced_and_called(story):
    check_one_answer(story)
