"""A function of `solve` that returns no numbers is named, with what it returned, in each form."""

import numpy as np
import pytest
import saltus
from saltus.errors import ModelError

FORMS = {
    "plain": ((0, 1), [1.0, 2.0]),
    "one": ((0, 1), [1.0]),
    "backward": ((1, 0), [1.0, 2.0]),
    "complex": ((0, 1), [1.0 + 1j, 2.0]),
    "both": ((1, 0), [1.0 + 1j]),
}
WRONG = [(None, "None", True), ("hello", "'hello'", False), ({1: 2}, "{1: 2}", False)]


def decay(t, x):
    return -x


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("vectorized", [False, True])
@pytest.mark.parametrize(("returned", "shown", "forgotten"), WRONG)
def test_a_right_hand_side(form, vectorized, returned, shown, forgotten):
    span, x0 = FORMS[form]
    with pytest.raises(ModelError) as caught:
        saltus.solve(lambda t, x: returned, span, x0, vectorized=vectorized)
    said = str(caught.value)
    assert f"returned {shown}, expected " in said
    assert ("is a `return` missing?" in said) is forgotten


def test_the_number_of_numbers():
    def forgotten(t, x):
        x + 1

    with pytest.raises(
        ModelError, match=r"forgotten\(t, x\) returned None, expected 2 numbers; is"
    ):
        saltus.solve(forgotten, (0, 1), [1.0, 2.0])


@pytest.mark.parametrize("form", FORMS)
def test_a_later_call(form):
    span, x0 = FORMS[form]
    with pytest.raises(ModelError, match=r"returned None, expected .*is a `return` missing"):
        saltus.solve(lambda t, x: -x if t in (0, 1) else None, span, x0)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(("returned", "shown", "forgotten"), WRONG)
def test_a_jacobian(form, returned, shown, forgotten):
    span, x0 = FORMS[form]
    with pytest.raises(ModelError) as caught:
        saltus.solve(decay, span, x0, method="bdf", jacobian=lambda t, x: returned)
    said = str(caught.value)
    assert "jacobian returned " + shown in said
    assert ("is a `return` missing?" in said) is forgotten


def test_a_complex_jacobian_of_a_wrong_shape():
    with pytest.raises(ModelError, match=r"jacobian returned shape \(2,\), expected \(2, 2\)"):
        saltus.solve(decay, *FORMS["complex"], method="bdf", jacobian=lambda t, x: [1.0, 2.0])


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(("returned", "shown", "forgotten"), WRONG)
def test_guards_and_resets(form, returned, shown, forgotten):
    span, x0 = FORMS[form]
    with pytest.raises(ModelError) as caught:
        saltus.solve(decay, span, x0, events=lambda t, x: returned)
    assert f"guard of 'event_0' returned {shown}" in str(caught.value)
    guard = saltus.Guard(lambda t, x: t - 0.5, reset=lambda t, x: returned)
    with pytest.raises(ModelError) as caught:
        saltus.solve(decay, span, x0, events=guard)
    assert "reset" in str(caught.value) and f"returned {shown}" in str(caught.value)


def test_an_entry_that_is_none_is_no_nan():
    for form in ("backward", "complex"):
        span, x0 = FORMS[form]
        with pytest.raises(ModelError, match=r"returned \[None, 1.0\], expected"):
            saltus.solve(lambda t, x: [None, 1.0], span, np.array(x0))
