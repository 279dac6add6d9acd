"""The name of a mode, or of a state of a machine, is no number: it is compared with the mode."""

import pytest
from saltus.errors import SceneError
from saltus.scene_files import loads

LEAF = """version = 1
modes = ["heating", "cooling"]
[states]
T = {{ start = 15.0, rate = "{rate}" }}
[discrete]
n = 0.0
[run]
until = 2.0
"""
MACHINE = """version = 1
wires = ["clock -> pump.u"]
[blocks]
clock = {{ block = "Clock" }}
[blocks.pump]
block = "StateMachine"
states = ["off", "on"]
inputs = ["u"]
variables = {{ n = 0 }}
entry = {{ on = {{ n = "{action}" }} }}
outputs = {{ flow = "{output}" }}
transitions = [{{ source = "off", target = "on", trigger = "{trigger}" }}]
"""
BARE = [
    "1 if heating else 0",
    "where(heating, 1, 0)",
    "1 if not cooling else 0",
    "cooling",
    "-cooling * T",
    "max(T, cooling)",
    "1 if heating and T < 20 else 0",
    "1 if mode < cooling else 0",
    "1 if cooling == 1 else 0",
    "1 if heating == cooling else 0",
    "1 if mode == cooling < 3 else 0",
    "1 if mode == (heating if T < 1 else cooling) else 0",
    "1 if mode + 0 == cooling else 0",
]


@pytest.mark.parametrize("rate", BARE)
def test_the_name_of_a_mode_is_no_value(rate):
    with pytest.raises(SceneError, match=r"name of a mode.*write mode == (heating|cooling)") as e:
        loads(LEAF.format(rate=rate))
    at = min(rate.index(name) for name in ("heating", "cooling") if name in rate)
    line = LEAF.format(rate=rate).split("\n")[3]
    assert (e.value.line, e.value.key) == (4, "states.T.rate")
    assert e.value.column == line.index(rate) + at + 1


def test_it_is_so_in_each_expression_of_a_leaf():
    text = LEAF.format(rate="0")
    for more in (
        'outputs.y = "heating"',
        'variables.v = "cooling + 1"',
        'guards.g = { guard = "heating" }',
        'guards.g = { guard = "T", set = { T = "cooling" } }',
        'updates.u = { period = 1, set = { n = "heating" } }',
    ):
        with pytest.raises(SceneError, match="name of a mode"):
            loads(text.replace("version = 1", f"version = 1\n{more}"))


@pytest.mark.parametrize(
    ("rate", "end"),
    [
        ("1 if mode == heating else 0", 17.0),
        ("1 if heating == mode else 0", 17.0),
        ("1 if mode != heating else 0", 15.0),
        ("1 if mode == heating != mode else 0", 15.0),
        ("2 if mode == heating and not mode == cooling else 0", 19.0),
    ],
)
def test_a_comparison_with_the_mode_is_the_value(rate, end):
    """T = 15 + rate * 2 s; a constant rate is integrated without an error but rounding."""
    results = loads(LEAF.format(rate=rate)).simulate()
    assert results.context.continuous_state[0] == pytest.approx(end, rel=1e-12)


@pytest.mark.parametrize(
    "wrong",
    [
        {"trigger": "off and u < 1"},
        {"trigger": "not on and u < 1"},
        {"output": "0.2 if on else 0"},
        {"output": "on"},
        {"action": "n + on"},
    ],
)
def test_the_name_of_a_state_of_a_machine_is_no_value(wrong):
    right = {"trigger": "u > 1", "output": "where(state == on, 1, 0)", "action": "n + 1"}
    loads(MACHINE.format(**right))
    with pytest.raises(SceneError, match=r"name of a state.*write state == (on|off)") as e:
        loads(MACHINE.format(**(right | wrong)))
    assert e.value.line is not None and e.value.column is not None
