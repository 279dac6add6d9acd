"""numpy's functions, one by one, compared with what they give when they are called."""

import pytest
from tracing_cases import assert_agrees
from world import over_state

UNARY = """
    sin cos tan arctan sinh cosh tanh arcsinh exp exp2 expm1 cbrt abs absolute fabs floor ceil trunc
    rint sign negative square reciprocal positive deg2rad rad2deg degrees radians sinc isnan isinf
    isfinite signbit logical_not fix round nan_to_num
""".split()
BINARY = """
    add subtract multiply divide true_divide arctan2 hypot maximum minimum fmax fmin copysign mod
    remainder fmod floor_divide less less_equal greater greater_equal equal not_equal logical_and
    logical_or logical_xor logaddexp heaviside
""".split()


@pytest.mark.parametrize("name", UNARY)
def test_function_of_one(name):
    assert_agrees(over_state(f"np.{name}(x)"))
    assert_agrees(over_state(f"np.{name}(x[0])"))


@pytest.mark.parametrize("name", ["sqrt", "log", "log2", "log10", "log1p", "arccosh"])
def test_function_of_a_positive_number(name):
    assert_agrees(over_state(f"np.{name}(np.abs(x) + 1.0)"))


@pytest.mark.parametrize("name", ["arcsin", "arccos", "arctanh"])
def test_function_of_a_number_below_one(name):
    assert_agrees(over_state(f"np.{name}(0.5 * np.tanh(x))"))


@pytest.mark.parametrize("name", BINARY)
def test_function_of_two(name):
    assert_agrees(over_state(f"np.{name}(x, x[::-1])"))
    assert_agrees(over_state(f"np.{name}(x[0], 0.25)"))
    assert_agrees(over_state(f"np.{name}(0.25, x)"))
