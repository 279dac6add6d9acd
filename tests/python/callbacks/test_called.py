"""What a called function gets: the same objects again, unless it keeps them."""

import threading

import numpy as np
import pytest
import saltus

from models import end, leaf

CALLED = {"python": "called"}


def test_everything_kept_stays_as_it_was():
    kept = []

    def ode(time, state, *, k):
        x = state.continuous_state
        kept.append((time, state, x, k, time + 0.0, float(x[0])))
        return -x

    end(leaf(ode, k=[1.0, 2.0]), **CALLED)
    assert len(kept) > 10
    for time, state, x, k, same_time, same_x in kept:
        assert time == same_time
        assert x[0] == same_x == state.continuous_state[0]
        assert k.tolist() == [1.0, 2.0]


def test_a_view_of_a_kept_array_stays_as_it_was():
    kept = []

    def ode(time, state):
        part = state.continuous_state[1:]
        kept.append((part, float(part[0])))
        return -state.continuous_state

    end(leaf(ode, [1.0, 2.0]), **CALLED)
    assert all(part[0] == number for part, number in kept)


def test_inputs_kept_stay_as_they_were():
    kept = []

    def output(time, state, u, v):
        kept.append((u, v.copy(), v))
        return u

    block = saltus.LeafSystem(name="block")
    block.declare_input_port(), block.declare_input_port(shape=2)
    block.declare_output_port(output, name="y", shape=())
    builder = saltus.DiagramBuilder()
    clock, sine, ramp = builder.add(saltus.library.Clock(), saltus.library.Sine([1.0, 2.0]), block)
    builder.connect(clock.output(), ramp.input(0))
    builder.connect(sine.output(), ramp.input(1))
    diagram = builder.build()
    results = saltus.simulate(
        diagram,
        diagram.create_context(),
        (0.0, 1.0),
        recorded_signals={"y": block.output()},
        save_at=np.linspace(0.0, 1.0, 11),
        **CALLED,
    )
    assert results.outputs["y"].tolist() == results.time.tolist()
    assert len({u for u, _, _ in kept}) >= 11
    assert all((v == copy).all() for _, copy, v in kept)


def test_every_form_of_numbers_is_read():
    for form in (
        lambda x: -x,
        lambda x: [-x[0], -x[1]],
        lambda x: (-float(x[0]), -x[1]),
        lambda x: np.float32(-1.0) * x,
        lambda x: (-x)[::-1][::-1],
        lambda x: np.asfortranarray(-x.reshape(2, 1)),
        lambda x: [np.array(-x[0]), -x[1]],
    ):
        x = end(leaf(lambda t, s, f=form: f(s.continuous_state), [1.0, 2.0]), **CALLED)
        np.testing.assert_allclose(x, np.exp(-1.0) * np.array([1.0, 2.0]), rtol=1e-4)
    assert end(leaf(lambda t, s: [2, -3], [0.0, 0.0]), **CALLED).tolist() == pytest.approx([2, -3])


def test_a_run_in_a_callback_of_a_run():
    inner = leaf(lambda t, s: -s.continuous_state)

    def ode(time, state):
        return [end(inner, **CALLED)[0]]

    assert end(leaf(ode, [0.0]), **CALLED)[0] == pytest.approx(np.exp(-1.0), rel=1e-4)


def test_a_function_that_calls_itself_by_a_run():
    block = saltus.LeafSystem(name="block")
    depth = []

    def ode(time, state):
        if len(depth) < 2:
            depth.append(time)
            x = end(block, 0.1, **CALLED)
            depth.pop()
            assert 0.0 < x[0] < 1.0
        return -state.continuous_state

    block.declare_continuous_state(default_value=[1.0], ode=ode)
    assert end(block, 0.2, max_major_steps=3, throw=False, **CALLED)[0] < 1.0


def test_threads_take_turns():
    """Each run gives the lock back between its calls."""
    block = leaf(lambda t, s: -s.continuous_state)
    found = []
    threads = [
        threading.Thread(
            target=lambda: found.append(end(block, max_minor_step_size=1e-3, **CALLED)[0])
        )
        for _ in range(4)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(set(found)) == 1
    assert len(found) == 4
