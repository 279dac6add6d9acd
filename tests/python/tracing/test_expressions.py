"""Each line of expressions.txt traces, and gives what it gives when it is called."""

from pathlib import Path

import pytest
from tracing_cases import assert_agrees
from world import over_state

EXPRESSIONS = Path(__file__).with_name("expressions.txt").read_text().splitlines()


@pytest.mark.parametrize("expression", EXPRESSIONS)
def test_expression(expression):
    assert_agrees(over_state(expression), ulps=16, mode=1)
