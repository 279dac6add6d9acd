"""Units are documentation: they change no number, and one warning tells where they do not fit."""

import warnings

import pytest

pytest.importorskip("libsbml", reason="python-libsbml reads the models")

from saltus.sbml import load, time_course

MODEL = """<sbml xmlns="http://www.sbml.org/sbml/level3/version2/core" level="3" version="2">
<model id="m" timeUnits="second">{definitions}<listOfParameters>
<parameter id="length" value="2" {length} constant="true"/>
<parameter id="x" value="1" {x} constant="false"/>
<parameter id="y" value="1" {x} constant="false"/></listOfParameters>
<listOfRules>{rules}</listOfRules></model></sbml>"""
RULE = """<assignmentRule variable="{name}"><math xmlns="http://www.w3.org/1998/Math/MathML">
<ci>length</ci></math></assignmentRule>"""
METRE, SECOND = 'units="metre"', 'units="second"'
FOOT = """<listOfUnitDefinitions><unitDefinition id="foot"><listOfUnits>
<unit kind="metre" exponent="1" scale="0" multiplier="0.3048"/></listOfUnits></unitDefinition>
</listOfUnitDefinitions>"""


def model(length, x, rules=("x",), definitions=""):
    text = "".join(RULE.format(name=name) for name in rules)
    return MODEL.format(length=length, x=x, rules=text, definitions=definitions)


@pytest.mark.parametrize(
    "text",
    [
        model(METRE, METRE),
        model(METRE, ""),
        model("", SECOND),
        model("", ""),
        model('units="foot"', 'units="foot"', definitions=FOOT),
    ],
)
def test_units_that_fit_or_are_not_declared_give_no_warning(text):
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always")
        load(text)
    assert not found


@pytest.mark.parametrize(
    "text", [model(METRE, SECOND), model('units="foot"', SECOND, definitions=FOOT)]
)
def test_units_that_do_not_fit_are_one_warning_and_change_no_number(text):
    with pytest.warns(UserWarning, match=r"SBML: units do not fit, line \d+: ") as found:
        rows = time_course(text, start=0, duration=1, steps=1, variables=["x"])
    assert len(found) == 1 and found[0].filename == __file__
    assert rows[:, 1].tolist() == [2.0, 2.0]


def test_the_warning_counts_the_other_places():
    with pytest.warns(UserWarning, match=r"And 1 more\.") as found:
        load(model(METRE, SECOND, rules=("x", "y")))
    assert len(found) == 1
