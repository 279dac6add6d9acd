"""State machines: when transitions are taken, the order of actions, and loops in one instant."""

import numpy as np
import pytest
import saltus
from saltus.library import *

response = saltus.response
METHODS = ["dopri5", "dop853", "taylor", "radau", "bdf", "adams", "auto"]
PYTHON = ["traced", "called"]


def always():
    return np.True_


def run(machine, source, end, **options):
    builder = saltus.DiagramBuilder()
    builder.add(machine, source)
    builder.connect(source.output(), machine.input())
    return saltus.simulate(builder.build(), (0.0, end), **options)


def lift(**options):
    """Floors 0 and 1, and a call that is a sine: a ride of 0.25 s to where it asks, then a door."""
    return StateMachine(
        ["down", "rising", "up", "falling"],
        [
            Transition("down", "rising", guard=lambda u: u > 0.5),
            Transition("rising", "up", after=0.25),
            Transition("up", "falling", guard=lambda u: u < -0.5),
            Transition("falling", "down", after=0.25),
        ],
        inputs=["u"],
        outputs={"motor": {"rising": 1.0, "falling": -1.0}},
        variables={"rides": 0.0},
        exit={"rising": lambda rides: {"rides": rides + 1}},
        **options,
    )


@pytest.mark.parametrize("method", METHODS)
def test_guards_and_times_against_the_closed_form(method):
    """sin t > 1/2 at pi / 6, sin t < -1/2 at 7 pi / 6; the motor runs 1/4 s after each. Its
    integral rises to 1/4 and falls back to 0."""
    builder = saltus.DiagramBuilder()
    machine, source, sum_ = builder.add(lift(), Sine(), Integrator())
    builder.connect(source.output(), machine.input())
    builder.connect(machine.output("motor"), sum_.input())
    diagram = builder.build()
    results = saltus.simulate(diagram, (0.0, 6.0), ode_solver_method=method, rtol=1e-9)
    events = results.events
    for name, time in (("down_to_rising", np.pi / 6), ("up_to_falling", 7 * np.pi / 6)):
        # located on a signal that is computed exactly, within 100 eps (t + h)
        assert events.times(name).tolist() == pytest.approx([time], abs=2e-13)
    assert events.times("rising_to_up") == pytest.approx(np.pi / 6 + 0.25, abs=4e-13)
    context = results.context
    assert context[sum_].continuous_state[0] == pytest.approx(0.0, abs=1e-12)
    assert context[machine].discrete_state[1] == 1.0


@pytest.mark.parametrize("python", PYTHON)
def test_actions_run_in_order(python):
    """The digits of `log` are written by the start, exit, action and entry, in this order."""

    def writes(digit):
        return lambda log: {"log": 10 * log + digit}

    machine = StateMachine(
        ["a", "b"],
        [Transition("a", "b", after=1.0, action=writes(3))],
        variables={"log": 0.0},
        entry={"a": writes(1), "b": writes(4)},
        exit={"a": writes(2), "b": writes(9)},
    )
    results = saltus.simulate(machine, (0.0, 3.0), python=python)
    assert results.context.discrete_state[1] == 1234.0
    assert results.events.times("start").tolist() == [0.0]
    again = saltus.simulate(machine, results.context, (3.0, 4.0), python=python)
    assert len(again.events) == 0  # no second entry where a run goes on
    assert again.context.discrete_state[1] == 1234.0


@pytest.mark.parametrize("source", [Constant(1.0), Step(step_time=1.0), Clock()])
@pytest.mark.parametrize("python", PYTHON)
def test_a_loop_in_one_instant_is_an_error_that_names_the_chain(source, python):
    machine = StateMachine(
        ["a", "b"],
        [
            Transition("a", "b", guard=lambda u: u > 0.5),
            Transition("b", "a", guard=lambda u: u > 0.25),
        ],
        inputs=["u"],
        name="loop",
    )
    with pytest.raises(saltus.SimulationError, match=r"'loop.a_to_b' -> 'loop.b_to_a'"):
        run(machine, source, 2.0, python=python)


def test_a_chain_in_one_instant_comes_to_its_end():
    """Each state is left when it is entered; the variable breaks the loop in its third round."""
    machine = StateMachine(
        ["a", "b"],
        [
            Transition("a", "b", guard=lambda n, u: (n < 3) & (u > 0.5)),
            Transition("b", "a", guard=always, action=lambda n: {"n": n + 1}),
        ],
        inputs=["u"],
        variables={"n": 0.0},
    )
    results = run(machine, Step(step_time=1.0), 2.0)
    assert results.context[machine].discrete_state.tolist() == [1.0, 3.0]
    assert results.events.times("b_to_a").tolist() == [1.0] * 3


@pytest.mark.parametrize("priorities", [(0, 0, "b"), (0, 1, "c"), (2, 1, "b")])
@pytest.mark.parametrize("kind", ["guard", "trigger"])
@pytest.mark.parametrize("source", [Step(step_time=1.0), Clock()])
def test_one_transition_is_taken_by_priority(priorities, kind, source):
    first, second, expected = priorities
    machine = StateMachine(
        ["a", "b", "c"],
        [
            Transition("a", "b", **{kind: lambda u: u > 0.5}, priority=first),
            Transition("a", "c", **{kind: lambda u: u > 0.5}, priority=second),
        ],
        inputs=["u"],
        variables={"taken": 0.0},
        exit={"a": lambda taken: {"taken": taken + 1}},
    )
    results = run(machine, source, 2.0)
    assert machine.states[results.context[machine].mode] == expected
    assert results.context[machine].discrete_state[1] == 1.0
    if kind == "guard":  # the log has the one that was taken
        assert len(results.events) == 2 + isinstance(source, Step)


def digits(transitions):
    """A state "on" with transitions to itself, or to "off" and back; each appends its digit."""
    made = []
    for digit, each in enumerate(transitions, 1):
        action = lambda log, digit=digit: {"log": 10 * log + digit}  # noqa: E731
        made.append(
            Transition("on", each.pop("target", "on"), action=action, name=f"t{digit}", **each)
        )
    return StateMachine(["on", "off"], made, inputs=["u"], variables={"log": 0.0}, name="m")


def rises(u):
    return u > 0.5


TICKS = [
    # transitions from "on", and the log at 2.75 s of a pulse that rises at 1/2, 3/2 and 5/2 s
    ("two triggers", [dict(trigger=rises), dict(trigger=rises)], 111.0),
    ("by priority", [dict(trigger=rises), dict(trigger=rises, priority=1.0)], 222.0),
    ("two times", [dict(after=0.75), dict(after=0.75)], 111.0),
    ("a longer time never comes", [dict(after=0.75), dict(after=1.0)], 111.0),
    (
        "the guard of the first is false",
        [dict(trigger=rises, guard=lambda log: log < 0), dict(trigger=rises)],
        222.0,
    ),
    (
        "away, where the first returns",
        [dict(trigger=rises), dict(trigger=rises, target="off")],
        111.0,
    ),
    (
        "a guard that the first makes true is taken at once",
        [dict(trigger=rises), dict(guard=lambda log: log > 10, target="off")],
        112.0,
    ),
    (
        "a guard that the first makes false is not taken",
        [dict(trigger=rises), dict(guard=lambda log, u: (log < 1) & (u > 0.5), target="off")],
        111.0,
    ),
]


@pytest.mark.parametrize("python", PYTHON)
@pytest.mark.parametrize(("what", "transitions", "log"), TICKS, ids=[each[0] for each in TICKS])
def test_one_of_several_transitions_of_a_state_to_itself_is_taken(what, transitions, log, python):
    machine = digits([dict(each) for each in transitions])
    results = run(machine, Pulse(period=1.0, phase_delay=0.5), 2.75, python=python)
    assert results.context[machine].discrete_state[1] == log


@pytest.mark.parametrize("python", PYTHON)
@pytest.mark.parametrize("target", ["on", "off"])
@pytest.mark.parametrize(("trigger", "time", "log"), [(1.0, 0.0, 1.0), (0.0, 1.0, 2.0)])
@pytest.mark.parametrize("source", [Pulse(period=4.0, phase_delay=1.0), Step(step_time=1.0)])
def test_priorities_decide_between_a_tick_and_a_time(source, trigger, time, log, target, python):
    """Both are due at 1 s: the pulse rises, and the time in the state ends."""
    machine = digits(
        [
            dict(trigger=rises, priority=trigger, target=target),
            dict(after=1.0, priority=time, target=target),
        ]
    )
    results = run(machine, source, 1.5, python=python)
    assert results.context[machine].discrete_state[1] == log


def test_a_trigger_moves_on_by_one_state_each_time():
    """One edge is one transition, though the next state waits for the same trigger; a trigger that
    is true at the start is none."""
    machine = StateMachine(
        ["a", "b", "c"],
        [
            Transition("a", "b", trigger=lambda u: u > 0.5),
            Transition("b", "c", trigger=lambda u: u > 0.5),
        ],
        inputs=["u"],
    )
    pulse = Pulse(period=2.0)  # true at 0 to 1, 2 to 3, 4 to 5
    assert response(machine, pulse, t=[0.5, 2.5, 3.5, 4.5]).tolist() == [0, 1, 1, 2]
    waves = Sine(frequency=np.pi)  # above 1/2 from 1/6, 13/6, ...
    assert response(machine, waves, t=[0.1, 0.2, 2.1, 2.2]).tolist() == [0, 1, 1, 2]


def test_a_guard_beside_a_trigger_decides_at_its_edge():
    machine = StateMachine(
        ["a", "b"],
        [Transition("a", "b", trigger=lambda u: u > 0.5, guard=lambda time: time > 3.0)],
        inputs=["u"],
    )
    assert response(machine, Pulse(period=2.0), t=[2.5, 3.5, 4.5]).tolist() == [0, 0, 1]


def test_a_time_with_a_guard_and_a_state_that_is_entered_anew():
    """The dwell time counts from each entry; without the call the door closes after 1 s."""
    door = StateMachine(
        ["open", "shut"],
        [
            Transition("open", "open", trigger=lambda u: u > 0.5),
            Transition("open", "shut", after=1.0, guard=lambda u: u < 0.5),
        ],
        inputs=["u"],
        outputs={"age": lambda since: since},
    )
    pulse = Pulse(period=10.0, pulse_width=0.2, phase_delay=0.5)  # true from 0.5 to 2.5
    state, age = response(door, pulse, t=[0.4, 1.6, 2.4, 2.6])
    assert state.tolist() == [0, 0, 0, 1]
    assert age == pytest.approx([0.4, 1.1, 1.9, 0.1], abs=1e-12)


def test_parameters_belong_to_the_context():
    machine = StateMachine(
        ["a", "b"],
        [Transition("a", "b", guard=lambda time, level: time > level)],
        parameters={"level": 1.0},
    )
    context = machine.create_context().with_parameter("level", 2.0)
    results = saltus.simulate(machine, context, (0.0, 3.0))
    assert results.events.times("a_to_b") == pytest.approx(2.0, abs=1e-12)


def test_all_of_it_is_traced():
    assert "called" not in str(lift().explain())


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda: StateMachine([], []), "expected one state or more"),
        (lambda: StateMachine(["a", "a"], []), "the state 'a' is there twice"),
        (lambda: StateMachine(["a"], [], inputs=["time"]), "the name 'time' is there twice"),
        (lambda: StateMachine(["open"], [], initial="opem"), "no state 'opem'.*'open'"),
        (lambda: StateMachine(["a"], [], entry={"b": always}), "entry: there is no state 'b'"),
        (lambda: StateMachine(["a"], [Transition("a", "a")]), "expected a guard, a trigger or"),
        (lambda: StateMachine(["a"], [Transition("a", "a", after=0)]), "after = 0 s"),
        (
            lambda: StateMachine(["a"], [Transition("a", "a", guard=lambda call: True)]),
            "guard of transition 'a_to_a': there is no 'call' to read",
        ),
        (
            lambda: StateMachine(["a"], [Transition("a", "a", after=1, trigger=always)]),
            "found both",
        ),
    ],
)
def test_what_is_refused(make, says):
    with pytest.raises(saltus.ModelError, match=says):
        make()


def test_an_action_that_writes_what_is_no_variable():
    machine = StateMachine(["a"], [], variables={"count": 0.0}, entry={"a": lambda: {"cont": 1.0}})
    with pytest.raises(
        saltus.ModelError, match=r"entry of 'a': there is no variable 'cont'.*'count'"
    ):
        saltus.simulate(machine, (0.0, 1.0))


@pytest.mark.parametrize("python", ["traced", "called"])
@pytest.mark.parametrize("more", [{}, {"after": 0.25}, {"trigger": lambda u: u > 0.0}])
@pytest.mark.parametrize("guard", [lambda u: u - 1.0, lambda u: ~bool(u <= 0.5)])
def test_a_guard_that_returns_a_number_is_refused(python, more, guard):
    ways = [Transition("a", "b", guard=guard, **more)]
    machine = StateMachine(["a", "b"], ways, inputs=["u"], name="m")
    with pytest.raises(saltus.Error, match=r"guard of transition 'a_to_b': expected a truth"):
        saltus.response(machine, Sine(), t=[0.5, 1.0, 7.0], python=python)


@pytest.mark.parametrize("python", ["traced", "called"])
def test_truths_of_every_kind_are_guards(python):
    for guard in (
        lambda u: u > 0.5,
        lambda u: np.logical_and(u > 0.5, u < 2.0),
        lambda u: (u > 0.5) & (u < 2.0),
        lambda u: np.logical_not(u <= 0.5),
        lambda u: not u <= 0.5,
        lambda u: bool(u > 0.5),
    ):
        machine = StateMachine(["a", "b"], [Transition("a", "b", guard=guard)], inputs=["u"])
        seen = saltus.response(machine, Sine(), t=[0.4, 0.6], python=python)
        assert seen.tolist() == [0.0, 1.0]
