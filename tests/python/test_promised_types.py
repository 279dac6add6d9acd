"""A field or property of a result that promises a number has one, no array without dimension."""

import inspect

import numpy as np
import pytest
import saltus

NUMBERS = {"float": float, "int": int, "bool": bool, "str": str}
"""annotations, which are text"""


def oscillator():
    return saltus.system_of(
        lambda t, x, mu: [x[1], mu * (1 - x[0] ** 2) * x[1] - x[0]],
        [2.0, 0.0],
        parameters={"mu": 1.0},
    )


def lag():
    return saltus.system_of(lambda t, x, u: [u - x[0]], [2.0], parameters={"u": 2.0})


def run():
    return saltus.scene("bouncing-ball").simulate(sensitivity=["e"])


def fit():
    pytest.importorskip("scipy")
    times = np.linspace(0.0, 2.0, 9)
    data = {"time": times, "x[0]": 1.0 + np.exp(-times)}
    return saltus.fit(lag(), data, {"u": 2.0})


def trim():
    pytest.importorskip("scipy")
    return saltus.trim(lag(), ["x[0]"])


MADE = {
    "periodic orbit": lambda: saltus.periodic_orbit(oscillator(), wrt=["mu"]),
    "lyapunov": lambda: saltus.lyapunov(lag(), time=20.0),
    "period map": lambda: saltus.period_map(lag(), 0.5),
    "trim": trim,
    "fit": fit,
    "results": run,
    "statistics": lambda: run().statistics,
    "event": lambda: run().events[0],
    "gap": lambda: saltus.results.Gap(1.0, "ball.bounce", "e", "the guard only grazes zero"),
}


def promised(kind):
    """The names of the public fields and properties that are numbers or text, and their types."""
    fields = {}
    for base in kind.__mro__:
        for name, hint in getattr(base, "__annotations__", {}).items():
            fields[name] = getattr(hint, "__forward_arg__", hint)  # as named tuples keep it
    for name, member in inspect.getmembers(kind, lambda member: isinstance(member, property)):
        fields[name] = getattr(member.fget, "__annotations__", {}).get("return")
    return {n: NUMBERS[h] for n, h in fields.items() if h in NUMBERS and not n.startswith("_")}


@pytest.mark.parametrize("what", MADE)
def test_a_promised_number_is_one(what):
    made = MADE[what]()
    names = promised(type(made))
    assert names
    for name, kind in names.items():
        assert isinstance(getattr(made, name), kind), name


def test_the_derivative_of_a_period_by_one_parameter_is_a_number():
    """d period / d mu of Van der Pol's oscillator, and 0 for the given period of a drive."""
    orbit = MADE["periodic orbit"]()
    assert isinstance(orbit.dperiod("mu"), float)
    assert orbit.dperiod("mu") == orbit.dperiod()[0] and orbit.dperiod().shape == (1,)
    assert orbit.dx0("mu").shape == (2,) and orbit.dx0().shape == (2, 1)
    driven = saltus.periodic_orbit(lag(), period=2.0, wrt=["u"])
    assert isinstance(driven.dperiod("u"), float) and driven.dperiod("u") == 0.0
