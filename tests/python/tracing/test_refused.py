"""What is wrong, what has no symbolic form, and what is too large."""

import math

import numpy as np
import pytest
from saltus.tracing import Signature, trace
from tracing_cases import reason


def no_return(time, state):
    state.continuous_state  # noqa: B018


def text(time, state):
    return "up"


def wrong_number(time, state):
    return [time]


def ragged(time, state):
    return np.array([state.continuous_state, 1.0])


def fails(time, state):
    raise ValueError("too cold")


def misspelt(time, state):
    return state.continous_state


def test_what_is_wrong_when_called_too():
    assert "returns None" in reason(no_return)
    assert "is a `return` missing?" in reason(no_return)
    assert "expected numbers, found str" in reason(text)
    assert reason(wrong_number, result_size=2) == "returns 1 numbers, expected 2"
    assert "inhomogeneous shape" in reason(ragged)
    assert "raised ValueError: too cold at test_refused.py:" in reason(fails)
    assert "no attribute 'continous_state'" in reason(misspelt)
    assert "returns 1 numbers" in reason(lambda t, s: 3.0, kind="reset")
    both = {"kind": "reset", "discrete_shape": (1,)}
    assert "returns no state" in reason(lambda t, s: [1.0, 2.0], **both)
    wrong = "continuous state: expected 2 numbers, found 3"
    assert wrong in reason(lambda t, s: s.with_continuous_state([1, 2, 3]), kind="reset")
    assert "sets the mode to a real number" in reason(lambda t, s: s.with_mode(t), kind="reset")


NO_FORM = {
    "np.fft.fft(x)": "uses np.fft.fft, which cannot be traced",
    "np.argmax(x)": "calls np.argmax, which has no symbolic form",
    "np.median(x)": "calls np.median, which has no symbolic form",
    "np.sort(x)": "calls np.sort, which has no symbolic form",
    "np.unique(x)": "calls np.unique, which has no symbolic form",
    "np.gamma(x)": "has no attribute 'gamma'",
    "math.gamma(x[0])": "calls math.gamma, which has no symbolic form",
    "math.factorial(int(x[0]))": "calls math.factorial, which has no symbolic form",
    "np.linalg.eigvals(np.outer(x, x))": "calls np.eigvals, which has no symbolic form",
    "[1.0, 2.0][int(x[0])]": "uses a value as an index or a count",
    "MATRIX[int(x[0]), 0]": "uses a value as an index or a count",
    "x[x > 0]": "uses values as indices",
    "list(range(int(x[0])))": "uses a value as an index or a count",
    "{0: 1.0}[mode]": "looks up a value, in a dictionary or a set",
    "x[0] + 1j": "unsupported operand",
    "np.array([1j]) * x": "expected numbers, found complex",
    "x.astype(complex)": "computes with complex128",
    "x.astype(np.float32)": "computes with float32",
    "round(x[0], 2)": "rounds to decimal places",
    "(mode & 1) * x": "computes bitwise (and) with integers or reals",
    "np.tanh(x > 0)": "computes tanh of truths, for which numpy takes small numbers",
    "min(x[0] > 0, x[1])": "takes the min of truths and numbers",
    "np.where(x > 0)": "calls np.where with a condition alone",
    "np.add(x, 1, where=x > 0)": "calls np.add with where",
    "type(x[0])(3)": "asks for the type of a value",
    "'%d' % x[0]": "turns a value into a fixed integer",
}


@pytest.mark.parametrize("expression", NO_FORM)
def test_no_symbolic_form(expression):
    source = (
        "def f(time, state):\n"
        "    x, mode = state.continuous_state, state.mode\n"
        f"    return {expression}\n"
    )
    exec(source, {"np": np, "math": math, "MATRIX": np.eye(2)}, made := {})
    assert NO_FORM[expression] in reason(made["f"])


def test_too_large():
    def grows(time, state):
        total = time
        while True:
            total = total * time + 1.0
        return total

    assert "has more than 100000 operations" in reason(grows)


def test_too_large_to_watch():
    table = np.zeros(100_000)
    assert "more than 10000 entries are not watched" in reason(lambda t, s: table[3] * t)


def test_nowhere_defined():
    assert reason(lambda t, s: math.sqrt(-1.0 - t * t)) == (
        "could be compared at 0 of 12 points only, as the function raises or is not finite at the "
        "others; start the block where it is defined"
    )


def test_the_check_finds_what_the_tracer_does_not_know():
    def function(time, state):
        return time + getattr(state.continuous_state[0], "nbytes", 0)  # a symbol has none

    assert reason(function) == (
        "the check failed: at t = 0, x = [0.7, -0.4] entry 0 of the result is 8.0 called and 0.0 "
        "traced"
    )


def test_keyboard_interrupts_pass():
    def function(time, state):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        trace(Signature(function=function))
