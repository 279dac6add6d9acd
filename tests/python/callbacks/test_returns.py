"""What callbacks return: a state, or the numbers of the one state they can mean; another number of
them is refused by the name of the callback. Traced or called, it is the same.
"""

import numpy as np
import pytest
import saltus

WAYS = ("traced", "called")


def block(x=None, z=None, mode=None, name="block"):
    leaf = saltus.LeafSystem(name=name)
    if x is not None:
        leaf.declare_continuous_state(default_value=x, ode=lambda t, s: 0.0 * s.continuous_state)
    if z is not None:
        leaf.declare_discrete_state(default_value=z)
    if mode is not None:
        leaf.declare_default_mode(mode)
    return leaf


def run(leaf, python, end=1.0):
    return saltus.simulate(leaf, (0, end), python=python)


FORMS = {
    "list": lambda s, values: list(values),
    "tuple": lambda s, values: tuple(values),
    "array": lambda s, values: np.array(values),
}


@pytest.mark.parametrize("python", WAYS)
@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("effect", ["crossing", "update", "shot"])
@pytest.mark.parametrize("kind", ["x", "z", "both"])
def test_numbers_alone_are_the_state_they_can_mean(kind, effect, form, python):
    """Of a block with both, an update writes the discrete state, and a reset map has to say it."""
    values = [3.0, 4.0]
    leaf = block([0.0, 0.0] if kind != "z" else None, [0.0, 0.0] if kind != "x" else None, name="b")
    change = lambda t, s: FORMS[form](s, values)  # noqa: E731
    if effect == "crossing":
        leaf.declare_zero_crossing(lambda t, s: t - 0.5, change, name="go")
    elif effect == "update":
        leaf.declare_periodic_update(change, 0.5, 0.5, name="go")
    else:
        leaf.declare_one_shot(change, 0.5, name="go")
    if kind == "both" and effect == "crossing":
        with pytest.raises(saltus.ModelError, match="a continuous and a discrete state; say which"):
            run(leaf, python)
        return
    end = run(leaf, python).context
    written, kept = end.continuous_state, end.discrete_state
    if kind != "x":
        written, kept = kept, written
    assert written.tolist() == values
    assert not kept.any()


def declare_update(leaf, change):
    leaf.declare_periodic_update(change, 0.25, 0.25, name="go")


def declare_shot(leaf, change):
    leaf.declare_one_shot(change, 0.25, name="go")


def declare_reset(leaf, change):
    leaf.declare_zero_crossing(lambda t, s: t - 0.25, change, name="go")


WRITERS = {
    "periodic update 'go'": declare_update,
    "one-shot update 'go'": declare_shot,
    "reset map of 'go'": declare_reset,
}


@pytest.mark.parametrize("python", WAYS)
@pytest.mark.parametrize("what", WRITERS)
@pytest.mark.parametrize("size", [1, 2])
@pytest.mark.parametrize("state", ["x", "z"])
@pytest.mark.parametrize("found", [0, 1, 2, 3])
def test_another_number_of_them_is_refused_by_name(found, state, size, what, python):
    if found == size:
        return
    leaf = block(**{state: [0.0] * size})
    WRITERS[what](leaf, lambda t, s: [1.0, 2.0, 3.0][:found])
    kind = "continuous" if state == "x" else "discrete"
    with pytest.raises(saltus.ModelError) as caught:
        run(leaf, python)
    assert str(caught.value) == (
        f"block 'block': {what} returned {found} numbers, expected {size} for the {kind} state"
    )


@pytest.mark.parametrize("python", WAYS)
@pytest.mark.parametrize("what", WRITERS)
def test_a_state_of_another_length_is_refused(what, python):
    leaf = block(x=[0.0, 0.0])
    WRITERS[what](leaf, lambda t, s: s.with_continuous_state([1.0, 2.0, 3.0]))
    with pytest.raises(
        saltus.ModelError, match="expected 2 numbers, found 3; set all of it at once"
    ):
        run(leaf, python)


def with_ode(f):
    leaf = saltus.LeafSystem(name="block")
    leaf.declare_continuous_state([1.0, 2.0], ode=f)
    return leaf


def with_guard(f):
    leaf = block(x=[1.0, 2.0])
    leaf.declare_zero_crossing(f, name="go")
    return leaf


def with_jacobian(f):
    leaf = saltus.LeafSystem(name="block")
    leaf.declare_continuous_state([1.0, 2.0], ode=lambda t, s: -s.continuous_state, jacobian=f)
    return leaf


READERS = {
    "ode": (with_ode, 2),
    "guard of 'go'": (with_guard, 1),
    "jacobian": (with_jacobian, 4),
}


@pytest.mark.parametrize("python", WAYS)
@pytest.mark.parametrize("what", READERS)
@pytest.mark.parametrize("found", [0, 1, 2, 3, 5])
def test_a_function_that_is_read_too(found, what, python):
    make, size = READERS[what]
    if found == size:
        return
    leaf = make(lambda t, s: [0.5] * found)
    with pytest.raises(saltus.ModelError) as caught:
        saltus.simulate(leaf, (0, 1), python=python, ode_solver_method="bdf")
    assert f"block 'block': {what} returned {found} numbers, expected {size}" in str(caught.value)


@pytest.mark.parametrize("python", WAYS)
@pytest.mark.parametrize("what", WRITERS)
def test_none_is_a_missing_return(what, python):
    leaf = block(x=[0.0])
    WRITERS[what](leaf, lambda t, s: None)
    with pytest.raises(saltus.ModelError, match=f"{what} returned None, expected a state"):
        run(leaf, python)


def add_in_place(s):
    s.continuous_state[0] += 1.0


def assign_entry(s):
    s.continuous_state[0] = 1.0


def assign_slice(s):
    s.continuous_state[:] = 0.0


def add_whole(s):
    x = s.continuous_state
    x += 1.0


def into_out(s):
    np.add(s.continuous_state, 1.0, out=s.continuous_state)


def sort(s):
    s.continuous_state.sort()


IN_PLACE = [add_in_place, assign_entry, assign_slice, add_whole, into_out, sort]


def writing(write, what):
    def f(t, s):
        write(s)
        return s if what in WRITERS else 0.0 * s.continuous_state

    if what in WRITERS:
        leaf = block(x=[1.0, 2.0])
        WRITERS[what](leaf, f)
        return leaf
    return with_ode(f)


@pytest.mark.parametrize("python", WAYS)
@pytest.mark.parametrize("what", ["ode", *WRITERS])
@pytest.mark.parametrize("write", IN_PLACE)
def test_a_write_to_the_state_in_place_says_what_to_do(write, what, python):
    with pytest.raises(saltus.ModelError) as caught:
        run(writing(write, what), python)
    message = str(caught.value)
    assert message.startswith(f"block 'block': {what} wrote to an array that may only be read at ")
    assert "test_returns.py:" in message
    assert "state.continuous_state.copy()" in message
    assert isinstance(caught.value.__cause__, ValueError)  # that of NumPy, with its place


@pytest.mark.parametrize("python", WAYS)
@pytest.mark.parametrize("name", ["continuous_state", "discrete_state", "mode"])
def test_an_assignment_to_the_state_says_what_to_do(name, python):
    leaf = block(x=[1.0], z=[1.0], mode=1)
    WRITERS["reset map of 'go'"](leaf, lambda t, s: setattr(s, name, 0))
    remedy = rf"a state cannot be changed; return state\.with_{name}\(\.\.\.\)"
    with pytest.raises(saltus.ModelError, match=remedy):
        run(leaf, python)


def test_a_value_error_of_the_function_itself_comes_out_as_it_was():
    class Mine(ValueError):
        pass

    def f(t, s):
        raise Mine("read")

    with pytest.raises(Mine) as caught:
        run(with_ode(f), "called")
    assert caught.value.args == ("read",)
