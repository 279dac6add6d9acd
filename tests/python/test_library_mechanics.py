"""Backlash and friction: their modes with every method, and tables of two inputs."""

import numpy as np
import pytest
import saltus
from saltus.library import *

response = saltus.response
METHODS = ["dopri5", "dop853", "taylor", "radau", "bdf", "adams", "auto"]


@pytest.mark.parametrize("method", METHODS)
def test_a_backlash_against_its_closed_form(method):
    """u = 2 sin t drives y up from 1/2, down from 1 at 5 pi / 6, and up from -1 at 11 pi / 6."""
    t = np.array([0.1, 1.0, np.pi / 2, 2.5, 4.0, 5.5, 7.5])
    u, rate = Sine(2.0), Sine(2.0, phase=np.pi / 2)
    y, moves = response(Backlash(1.0), u, rate, t=t, ode_solver_method=method)
    s = 2 * np.sin(t)
    exact = [0, s[1] - 0.5, 1.5, 1.5, s[4] + 0.5, -1.5, s[6] - 0.5]
    np.testing.assert_allclose(y, exact, rtol=0, atol=1e-9)
    assert moves[3] == moves[5] == 0.0


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("rate", [Constant(0.0), Constant(2.0), Sine(2.0)])
def test_a_rate_that_does_not_show_the_turn_ends_the_run(method, rate):
    """u = 2 sin t drives y from u = 1/2 on, and is back there at pi - asin(1/4)."""
    with pytest.raises(saltus.SimulationError, match="in_rate is the rate of in") as caught:
        response(Backlash(1.0), Sine(2.0), rate, t=[8.0], ode_solver_method=method)
    assert caught.value.time == pytest.approx(np.pi - np.arcsin(0.25), abs=1e-3)


def play(u, width, y):
    """The play operator: y[k] = min(max(y[k-1], u[k] - width / 2), u[k] + width / 2)."""
    out = []
    for each in u:
        y = min(max(y, each - width / 2), each + width / 2)
        out.append(y)
    return np.array(out)


@pytest.mark.parametrize("step", [np.inf, 0.05])
def test_a_backlash_that_follows_time_alone(step):
    """At a turn the contact is at its zero, and the time moves it off by less than a rounding."""
    numbers = np.random.default_rng(1)
    t = np.linspace(0.0, 10.0, 20_001)
    for _ in range(30):
        a, b = numbers.uniform(0.5, 2.0), numbers.uniform(0.1, 0.8)
        w, phase, width = numbers.uniform(0.5, 3.0), numbers.uniform(0.0, 6.0), b
        u = Sine(a, w, phase), Sine(b, 2.3 * w, 0.4)
        rate = Sine(a * w, w, phase + np.pi / 2), Sine(b * 2.3 * w, 2.3 * w, 0.4 + np.pi / 2)
        builder = saltus.DiagramBuilder()
        total, speed = builder.add(Adder(2, name="total"), Adder(2, name="speed"))
        for i in range(2):
            builder.connect(builder.add(u[i]).output(), total.input(i))
            builder.connect(builder.add(rate[i]).output(), speed.input(i))
        lash = builder.add(Backlash(width))
        builder.connect(total.output(), lash.input(0))
        builder.connect(speed.output(), lash.input(1))
        diagram = builder.build()
        results = saltus.simulate(
            diagram,
            (0.0, 10.0),
            recorded_signals={"y": lash.output(0)},
            save_at=t[::100],
            event_rows=False,
            max_minor_step_size=step,
        )
        exact = play(a * np.sin(w * t + phase) + b * np.sin(2.3 * w * t + 0.4), width, 0.0)[::100]
        # The play operator looks every 0.5 ms, and misses up to u'' h^2 / 8 at a turn.
        bound = (a * w**2 + b * (2.3 * w) ** 2) * (t[1] - t[0]) ** 2 / 8 + 1e-9
        np.testing.assert_allclose(results["y"], exact, rtol=0, atol=bound)


def drive(method):
    """A motor shaft of the acceleration cos t behind a play of 0.5, and its load's position."""
    builder = saltus.DiagramBuilder()
    push, speed = builder.add(Sine(phase=np.pi / 2), Integrator(name="speed"))
    angle, play, load = builder.add(Integrator(-1.0), Backlash(0.5), Integrator(name="load"))
    builder.connect(push.output(), speed.input())
    builder.connect(speed.output(), angle.input())
    builder.connect(angle.output(), play.input(0))
    builder.connect(speed.output(), play.input(1))
    builder.connect(play.output(1), load.input())
    diagram = builder.build()
    results = saltus.simulate(diagram, (0.0, 20.0), rtol=1e-9, atol=1e-11, ode_solver_method=method)
    return results.context[load].continuous_state[0], results.context[play].discrete_state


@pytest.mark.parametrize("method", METHODS)
def test_a_drive_with_play(method):
    """The angle is -cos t. y starts at 0 in a play that reaches to -1: the run starts in contact,
    y = -0.75, and swings between -0.75 and 0.75, so its rate has the integral of y."""
    load, z = drive(method)
    # At 20 s, after the turn at 6 pi with y = -0.75, the angle has risen from -1 to -cos 20, which
    # is above -0.5, where it began to drive y: y = -cos 20 - 0.25.
    assert load == pytest.approx(
        -np.cos(20.0) - 0.25 + 0.75, abs=1e-5
    )  # a thousand tolerances of 1e-9 over 20 s
    assert z[1] == 1.0


@pytest.mark.parametrize("method", METHODS)
def test_a_body_stops_and_does_not_creep(method):
    block = MassWithFriction(2.0, coulomb=1.0, viscous=0.5, initial_velocity=3.0)
    x, v = response(block, 0.0, t=[1.0, 20.0, 1000.0], rtol=1e-9, ode_solver_method=method)
    # 2 v' = -1 - v / 2: v = 5 exp(-t / 4) - 2, zero at 4 ln 2.5; x = 20 (1 - exp(-t / 4)) - 2 t
    stop = 4 * np.log(2.5)
    assert v[0] == pytest.approx(5 * np.exp(-0.25) - 2, abs=1e-6)
    assert x[1] == pytest.approx(20 * 0.6 - 2 * stop, abs=1e-6)
    assert x[2] == x[1] and v[1] == v[2] == 0.0


@pytest.mark.parametrize("method", METHODS)
def test_stick_and_slip_on_a_belt(method):
    """A spring, k = 1, is pulled with 0.1 m/s: the body slips each time its force reaches 2 N,
    moves as a half swing around the force 1 N, and stops where the force is about 0."""
    builder = saltus.DiagramBuilder()
    clock, pull, force = builder.add(Clock(), Gain(0.1), Adder("+-"))
    body = builder.add(MassWithFriction(1.0, coulomb=1.0, static=2.0, name="body"))
    builder.connect(clock.output(), pull.input())
    builder.connect(pull.output(), force.input(0))
    builder.connect(body.output(0), force.input(1))
    builder.connect(force.output(), body.input())
    results = saltus.simulate(builder.build(), (0.0, 60.0), rtol=1e-9, ode_solver_method=method)
    slips = results.events.times("body.slip_up")
    assert slips[0] == pytest.approx(20.0, abs=1e-6)
    # Against the belt: w = force - 1 N starts at 1 with w' = 0.1, and the body stops where v = 0.1
    # - w' is 0 again: after 2 pi - 2 atan(0.1 / 1) ... of the swing w = cos s + 0.1 sin s.
    swing = 2 * np.pi - 2 * np.arctan2(1.0, 0.1)
    stick = results.events.times("body.stick")
    assert stick[0] - slips[0] == pytest.approx(swing, abs=1e-6)
    low = 1 + np.cos(swing) + 0.1 * np.sin(swing)  # the force where it sticks
    assert slips[1] - stick[0] == pytest.approx((2.0 - low) / 0.1, abs=1e-5)


@pytest.mark.parametrize("force", [1.0, -1.0, 0.3])
def test_a_force_up_to_the_friction_moves_nothing(force):
    x, v = response(MassWithFriction(), Step(0.0, force), t=[0.5, 2.0, 99.0])
    assert not np.any(x) and not np.any(v)


def test_a_table_of_two_inputs():
    table = LookupTable2d([0, 1, 3], [0, 2], [[0, 2], [10, 14], [20, 24]])
    assert response(table, [0.5, 0.5, 2.0, 9.0], [1.0, 1.0, 1.0, -9.0]).tolist() == [
        6.5,
        6.5,
        17.0,
        20.0,
    ]


@pytest.mark.parametrize("method", [each for each in METHODS if each != "taylor"])
def test_the_kinks_of_a_table_are_located(method):
    """A sum of two zigzags along the diagonal; each has the mean 1/2 over 3 s. Each of the 15
    pieces adds an error of some tolerances."""
    x, y = np.linspace(0, 3, 7), np.linspace(0, 3, 11)
    values = (np.arange(7) % 2)[:, None] + (np.arange(11) % 2)[None, :]
    builder = saltus.DiagramBuilder()
    clock, table, area = builder.add(Clock(), LookupTable2d(x, y, values), Integrator())
    builder.connect(clock.output(), table.input(0))
    builder.connect(clock.output(), table.input(1))
    builder.connect(table.output(), area.input())
    options = {"ode_solver_method": method, "rtol": 1e-9, "atol": 1e-11}
    end = saltus.simulate(builder.build(), (0.0, 3.0), **options).context[area]
    assert end.continuous_state[0] == pytest.approx(3.0, abs=15 * 3e-8)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Backlash(0.0), "width = 0; expected a finite number > 0"),
        (lambda: MassWithFriction(0.0), "mass = 0 kg"),
        (lambda: MassWithFriction(coulomb=2.0, static=1.0), "static friction 1 N is below"),
        (lambda: LookupTable2d([0, 1], [0, 1], [[1, 2]]), "output_table is 1 x 2; expected 2 x 2"),
        (lambda: LookupTable2d([0, 1], [1, 1], [[1, 2], [3, 4]]), "points that increase"),
    ],
)
def test_refusals(make, message):
    with pytest.raises(saltus.ModelError, match=message):
        make()


@pytest.mark.parametrize("method", METHODS)
def test_a_rigid_body_is_a_symmetric_top(method):
    """J = diag(1, 1, 2), w_3 = 2: w_1 + i w_2 turns at 2 rad/s. The angular momentum stays, in the
    axes of the world, and so does the norm of the quaternion."""
    body = RigidBody(2.0, np.diag([1.0, 1.0, 2.0]), initial_rates=[0.3, 0.0, 2.0])
    t = [1.0, 5.0]
    options = {"rtol": 1e-9, "atol": 1e-11, "ode_solver_method": method}
    p, _, q, w = response(body, [2.0, 0, 0], [0, 0, 0], t=t, **options)
    # a thousand tolerances over 5 s
    np.testing.assert_allclose(w[:, 0], 0.3 * np.cos(2 * np.array(t)), atol=1e-6)
    np.testing.assert_allclose(w[:, 1], 0.3 * np.sin(2 * np.array(t)), atol=1e-6)
    np.testing.assert_allclose(p[:, 0], 0.5 * np.square(t), atol=1e-6)
    for (a, *axis), rate in zip(q, w, strict=True):
        momentum = np.array([1.0, 1.0, 2.0]) * rate
        turned = momentum + 2 * np.cross(axis, np.cross(axis, momentum) + a * momentum)
        np.testing.assert_allclose(turned, [0.3, 0.0, 4.0], atol=1e-5)
        assert np.hypot(a, np.linalg.norm(axis)) == pytest.approx(1.0, abs=1e-6)


def test_a_rigid_body_refuses_impossible_bodies():
    with pytest.raises(saltus.ModelError, match="symmetric, positive definite"):
        RigidBody(1.0, np.diag([1.0, 1.0, 0.0]))
    with pytest.raises(saltus.ModelError, match="inertia is 2 x 2; expected 3 x 3"):
        RigidBody(1.0, np.eye(2))
    with pytest.raises(saltus.ModelError, match="initial_rates has 2"):
        RigidBody(initial_rates=[1.0, 2.0])
    with pytest.raises(saltus.ModelError, match="mass = -1 kg"):
        RigidBody(-1.0)
