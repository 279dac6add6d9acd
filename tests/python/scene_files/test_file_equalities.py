"""A guard that is an equality of what moves, or a constant, never fires: it is refused."""

import pytest
from saltus.errors import SceneError
from saltus.scene_files import loads

LEAF = """version = 1
modes = ["up", "down"]
[parameters]
low = 0.5
[states]
x = {{ start = 1.0, rate = "-1" }}
k = {{ start = 0.0 }}
[discrete]
n = 0.0
[variables]
twice = "2 * x"
met = "x == low"
[guards.g]
guard = "{guard}"
{more}
set = {{ n = "n + 1" }}
[updates.tick]
period = 1.0
set = {{ n = "n + 1", k = "k + 1" }}
[run]
until = 3.0
"""
MOVING = {
    "x == 0": "write 'x' with a direction, or 'x <= 0' or 'x >= 0'",
    "x == low": "write 'x - low' with a direction, or 'x <= low'",
    "0.5 == x": "0.5 - x",
    "x - low == 0": "write 'x - low' with a direction",
    "x == low + 1": r"x - \(low \+ 1\)",
    "x != low": "x - low",
    "not x == low": "x - low",
    "t == 1": "t - 1",
    "twice == 1": "twice - 1",
    "abs(x) == 1": r"abs\(x\)",
    "mode == up and x == low": "x - low",
    "x < low or x == 1": "x - 1",
    "1 if x == low else -1": "x - low",
    "where(x == low, 1, -1)": "x - low",
    "met": "x - low",
    "x == n": "x - n",
}
HELD = [
    "mode == down and n == 2",
    "n == 2",
    "k == 2",
    "floor(x) == -1",
    "sign(x) == -1",
    "max(x, 0) == 0",
    "clip(x, 0, 1) == 0",
    "round(2 * x) == 0",
    "(1 if n == 1 else x) - 0.5",
    "x / n if n != 0 else x",
    "1 / x if x != 0 else 1",
    "x <= low or n > 5",
]
CONSTANT = ["1", "0", "1 > 0", "low", "low - 0.5", "low == 0.5", "sin(low)"]


def leaf(guard, more=""):
    return loads(LEAF.format(guard=guard, more=more))


@pytest.mark.parametrize("guard", MOVING)
def test_an_equality_of_what_moves_is_refused(guard):
    with pytest.raises(SceneError, match=MOVING[guard]) as error:
        leaf(guard)
    assert "never fires" in str(error.value) and error.value.key == "guards.g.guard"


@pytest.mark.parametrize("guard", HELD)
def test_an_equality_of_what_is_held_for_a_while_is_a_guard(guard):
    leaf(guard)


def test_such_guards_fire():
    """n counts the seconds, and one more at its guard: 1, 2, 3 = 2 + 1, 4."""
    for guard in ("n == 2", "k == 2", "floor(x) == -1"):
        assert leaf(guard).simulate().statistics.events_by_name["scene.g"] >= 1


@pytest.mark.parametrize("guard", CONSTANT)
def test_a_constant_is_no_guard(guard):
    with pytest.raises(SceneError, match="never fires") as error:
        leaf(guard)
    assert (error.value.line, error.value.key) == (14, "guards.g.guard")


def test_nor_is_a_number():
    for number in ("0", "1.5"):
        text = LEAF.format(guard="", more="").replace('guard = ""', f"guard = {number}")
        with pytest.raises(SceneError, match="it is a constant"):
            loads(text)


def test_a_constant_may_fire_at_the_start():
    for more in ('at_start = "fire"', "delay = 0.5\ninitial_value = false"):
        results = leaf("1", f'direction = "rising"\n{more}').simulate()
        assert results.statistics.events_by_name["scene.g"] == 1


MACHINE = """version = 1
wires = [{wires}]
[parameters]
low = 0.5
[systems.tank]
states = {{ h = {{ start = 1.0, rate = "-0.1" }} }}
discrete = {{ n = 0.0 }}
updates = {{ tick = {{ period = 1.0, set = {{ n = "n + 1" }} }} }}
outputs = {{ level = "2 * h", count = "n", sum = "n + h", part = "floor(h)" }}
[systems.pair]
inputs = {{ u = "twice.in" }}
outputs = {{ y = "twice.out", z = "inner.level" }}
[systems.pair.blocks]
inner = {{ system = "tank" }}
twice = {{ block = "Gain", gain = 2.0 }}
[blocks]
tank = {{ system = "tank" }}
pair = {{ system = "pair" }}
gain = {{ block = "Gain", gain = 2.0 }}
clock = {{ block = "Clock" }}
tick = {{ block = "DiscreteClock", dt = 1.0 }}
step = {{ block = "Step" }}
pulse = {{ block = "Pulse" }}
full = {{ block = "Integrator", upper_limit = 1.0 }}
[blocks.pump]
block = "StateMachine"
states = ["off", "on"]
inputs = ["level"]
variables = {{ starts = 0 }}
transitions = [{{ source = "off", target = "on", {condition} }}]
"""
OTHERS = {"pair.u": "step", "gain.in": "tank.count", "full.in": "step"}


def machine(source, condition, **others):
    wires = {"pump.level": source} | OTHERS | others
    listed = ", ".join(f'"{begin} -> {end}"' for end, begin in wires.items())
    return loads(MACHINE.format(wires=listed, condition=condition))


TRIGGER = 'trigger = "level == low"'


@pytest.mark.parametrize("source", ["tank.level", "tank.sum", "pair.z", "clock"])
@pytest.mark.parametrize("key", ["trigger", "guard"])
def test_an_input_that_moves_is_equal_for_a_moment(source, key):
    with pytest.raises(SceneError, match="write 'level <= low' or 'level >= low'") as error:
        machine(source, f'{key} = "level == low"')
    assert error.value.key == f"blocks.pump.transitions[0].{key}"


def test_along_wires_and_into_diagrams():
    for source in ("tank.level", "clock", "pair.z"):
        with pytest.raises(SceneError, match="never fires"):
            machine("gain", TRIGGER, **{"gain.in": source})
    with pytest.raises(SceneError, match="never fires"):
        machine("pair.y", TRIGGER, **{"pair.u": "clock"})


@pytest.mark.parametrize(
    "source",
    ["tank.count", "tank.part", "gain", "pair.y", "tick", "step", "pulse", "full"],
)
def test_an_input_that_is_held_is_compared(source):
    machine(source, 'trigger = "level == 2"')


def test_conditions_of_a_machine():
    machine("tank.level", 'trigger = "starts == 0 and level > 1"')
    machine("tank.level", 'guard = "low > 0"')
    for wrong in ("since == 1", "t == 1 and state == off", "low > 0", "1 > 0", "level == low"):
        with pytest.raises(SceneError, match="never fires"):
            machine("tank.level", f'trigger = "{wrong}"')


def test_a_guard_inside_of_a_diagram():
    """The input of a leaf that leads out of two diagrams."""
    text = """version = 1
wires = ["{source} -> outer.u"]
[systems.leaf]
inputs = ["u"]
discrete = { n = 0.0 }
guards = { g = { guard = "u == 2", set = { n = "n + 1" } } }
outputs = { n = "n" }
[systems.inner]
blocks = { leaf = { system = "leaf" } }
inputs = { u = "leaf.u" }
[systems.outer]
blocks = { inner = { system = "inner" } }
inputs = { u = "inner.u" }
[blocks]
outer = { system = "outer" }
clock = { block = "Clock" }
tick = { block = "DiscreteClock", dt = 1.0 }
"""
    loads(text.replace("{source}", "tick"))
    with pytest.raises(SceneError, match="'u == 2' changes for a single moment") as error:
        loads(text.replace("{source}", "clock"))
    assert (error.value.line, error.value.key) == (6, "systems.leaf.guards.g.guard")
