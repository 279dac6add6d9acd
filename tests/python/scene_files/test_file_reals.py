"""Whatever leaves the real numbers is an error with its column; no traceback, no silent number."""

import warnings

import pytest
import saltus
from saltus.errors import SceneError
from saltus.scene_files import loads

SCENE = """version = 1
[parameters]
k = {k}
zero = 0.0
large = 1e200
points = [0.0, 2.0, 1.0]
{parameters}
[states]
y = {{ start = 1.0, rate = '''{rate}''' }}
[outputs]
o = '''{output}'''
[run]
until = 1.0
"""
# expression, the column of the operation, parts of the message
NO_REAL = [
    ("k ** 0.5", 1, "(-8) ** 0.5 has no value"),
    ("floor(k ** 0.5)", 7, "(-8) ** 0.5"),
    ("abs(k ** 0.5)", 5, "(-8) ** 0.5"),
    ("k ** 0.5 < 1", 1, "(-8) ** 0.5"),
    ("1 + k**0.5 % 2", 5, "(-8) ** 0.5"),
    ("min(k ** 0.5, 1)", 5, "(-8) ** 0.5"),
    ("clip(k ** 0.5, 0, 1)", 6, "(-8) ** 0.5"),
    ("where(k ** 0.5 > 1, 1, 2)", 7, "(-8) ** 0.5"),
    ("log(k)", 1, "log(-8) has no value"),
    ("not log(k)", 5, "log(-8)"),
    ("(log(k) < 1) + 0", 2, "log(-8)"),
    ("sqrt(k) == 1", 1, "sqrt(-8)"),
    ("log(zero)", 1, "log(0) has no value"),
    ("asin(2)", 1, "asin(2) has no value"),
    ("zero ** -1", 1, "0 ** (-1) has no value"),
    ("1 / (1 / zero)", 6, "1 / 0 has no value"),
    ("tanh(1 / zero)", 6, "1 / 0"),
    ("k % zero", 1, "(-8) % 0"),
    ("inf - inf", 1, "inf - inf has no value"),
    ("zero * inf", 1, "0 * inf"),
]
TOO_LARGE = [
    ("large * large", 1, "1e+200 * 1e+200 is beyond 1.8e308"),
    ("large ** 2", 1, "1e+200 ** 2 is beyond"),
    ("tanh(large * large)", 6, "beyond"),
    ("exp(1000)", 1, "exp(1000) is beyond"),
    ("1 / (1 + exp(1000))", 10, "exp(1000) is beyond"),
]
REAL = [
    ("where(k < 0, 0, log(k))", 0.0),
    ("0 if k < 0 else log(k)", 0.0),
    ("k < 0 or log(k) > 1", 1.0),
    ("k > 0 and log(k) > 1", 0.0),
    ("1 / inf", 0.0),
    ("max(2, -inf)", 2.0),
    ("k ** 3", -512.0),
    ("cbrt(k)", -2.0),
    ("exp(-1000)", 0.0),
]


def scene(parameters="", rate="-y", output="y", k=-8.0):
    return SCENE.format(parameters=parameters, rate=rate, output=output, k=k)


@pytest.mark.parametrize(("text", "column", "part"), NO_REAL + TOO_LARGE)
def test_a_number_that_is_not_real(text, column, part):
    with pytest.raises(SceneError) as caught:
        loads(scene(parameters=f"made = '''{text}'''"))
    error = caught.value
    assert (error.line, error.column, error.key) == (7, 10 + column, "parameters.made")
    assert f"column {column}: expected a " in str(error) and part in str(error)


@pytest.mark.parametrize("where", ["rate", "output"])
@pytest.mark.parametrize(("text", "column", "part"), NO_REAL)
def test_an_equation_whose_parameters_have_no_real_value(text, column, part, where):
    with pytest.raises(SceneError) as caught:
        loads(scene(**{where: f"y + ({text})"}))
    error = caught.value
    assert f"column {column + 5}: expected a " in str(error) and part in str(error)
    assert error.key == {"rate": "states.y.rate", "output": "outputs.o"}[where]


@pytest.mark.parametrize("python", ["traced", "called"])
@pytest.mark.parametrize(("text", "expected"), REAL)
def test_only_the_branch_that_is_chosen_is_computed(text, expected, python):
    made = loads(scene(parameters=f"made = '''{text}'''", output=text))
    assert made.parameters["made"] == expected
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert made.simulate(python=python)["o"][0] == expected


@pytest.mark.parametrize("python", ["traced", "called"])
@pytest.mark.parametrize(
    "text",
    ["log(y - 2)", "(y - 2) ** 0.5", "abs((t - 1) ** 0.5)", "floor((k * y) ** 0.5)", "1 / t",
     "min((k + 0 * t) ** 0.5, 1)", "(t - 1) % zero", "large ** (2 + t)", "exp(1000 * y)",
     "t ** -1"],
)  # fmt: skip
def test_a_run_that_leaves_the_reals_is_ended_by_the_engine_without_a_warning(text, python):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(saltus.SimulationError, match=r"t = 0 s: .*'scene.o'.*is not finite"):
            loads(scene(output=text)).simulate(python=python)


def test_a_function_block_of_a_parameter():
    text = (
        "version = 1\n[parameters]\nk = -2.0\n[blocks]\n"
        'a = { block = "SourceBlock", function = "t + log(k)" }'
    )
    with pytest.raises(SceneError, match=r"column 5: expected a real number, but log\(-2\)"):
        loads(text)
