"""Parameters and modes by name, for the functions of `solve` that have an argument for them."""

import numpy as np
import pytest
import saltus

METHODS = ["auto", "dopri5", "dop853", "adams", "bdf", "radau", "taylor"]


def decay(t, x, k):
    return [-k * x[0]]


@pytest.mark.parametrize("method", METHODS)
def test_a_parameter_is_the_argument_of_its_name(method):
    found = saltus.solve(decay, (0, 1), [1.0], parameters={"k": 2.0}, method=method)
    args = saltus.solve(decay, (0, 1), [1.0], args=(2.0,), method=method)
    # The engine may order sums of a parameter and of a constant differently: roundings, which the
    # choice of steps does not see.
    np.testing.assert_allclose(found.y[0, -1], args.y[0, -1], rtol=1e-12)


def test_guards_resets_and_jacobians_take_what_they_have_arguments_for():
    floor = saltus.Guard(
        lambda t, x: x[0], reset=lambda t, x, e: [0.0, -e * x[1]], direction="falling", name="floor"
    )
    run = saltus.solve(
        lambda t, x, g: [x[1], -g],
        (0, 2.4),
        [5.0, 0.0],
        parameters={"g": 10.0, "e": 0.5},
        events=floor,
        jacobian=lambda t, x: [[0.0, 1.0], [0.0, 0.0]],
    )
    # Impacts at 1 s and, after a flight of 2 e s, at 2 s.
    np.testing.assert_allclose(run.t_events[0], [1.0, 2.0], atol=1e-9)


@pytest.mark.parametrize("form", ["backward", "complex", "in place", "array"])
def test_every_form_of_a_call_has_parameters(form):
    def in_place(t, x, out, k):
        out[0] = -k * x[0]

    calls = {
        "backward": (decay, (1, 0), [1.0], 2.0, np.exp(2)),
        "complex": (lambda t, x, k: [1j * k * x[0]], (0, 1), [1.0 + 0j], 2.0, np.exp(2j)),
        "in place": (in_place, (0, 1), [1.0], 2.0, np.exp(-2)),
        "array": (lambda t, x, k: [-k[0] * k[1] * x[0]], (0, 1), [1.0], [4.0, 0.5], np.exp(-2)),
    }
    f, span, start, k, expected = calls[form]
    run = saltus.solve(f, span, y0=start, parameters={"k": k}, rtol=1e-9, atol=1e-11)
    # A hundred steps of the tolerance, and e^2 as growth.
    assert abs(run.y[0, -1] - expected) < 1e-6


def test_guards_change_the_mode_that_functions_see():
    run = saltus.solve(
        lambda t, x, mode: [np.where(mode == 1, 1.0, -1.0)],
        (0, 5),
        [1.5],
        events=[
            saltus.Guard(lambda t, x, low: x[0] - low, start_mode=0, end_mode=1, name="on"),
            saltus.Guard(lambda t, x: x[0] - 2.0, start_mode=1, end_mode=0, name="off"),
        ],
        parameters={"low": 1.0},
    )
    assert [event.name for event in run.events] == ["on", "off", "on", "off", "on"]
    np.testing.assert_allclose([event.time for event in run.events], [0.5, 1.5, 2.5, 3.5, 4.5])
    begun = saltus.solve(lambda t, x, mode: [mode * 1.0], (0, 1), [0.0], mode=2)
    np.testing.assert_allclose(begun.y[0, -1], 2.0)


def test_a_sweep_varies_the_parameters_of_system_of():
    system = saltus.system_of(decay, [1.0], parameters={"k": 1.0})
    ends = saltus.sweep(system, {"k": [0.0, 0.5, 2.0]}, (0, 1), as_dict=True, rtol=1e-9)
    np.testing.assert_allclose(ends["continuous_state"][:, 0], np.exp([0, -0.5, -2]), atol=1e-7)


def test_modes_and_parameters_are_not_shared_by_two_calls():
    ends = [
        saltus.solve(decay, (0, 1), [1.0], parameters={"k": k}).y[0, -1] for k in (1.0, 2.0, 1.0)
    ]
    assert ends[0] == ends[2] != ends[1]


def test_a_parameter_may_have_any_name_that_an_argument_may_have():
    for f in (
        lambda t, x, time: [-time * x[0]],
        lambda t, x, state: [-state * x[0]],
        lambda t, x, self: [-self * x[0]],
    ):
        name = f.__code__.co_varnames[2]
        run = saltus.solve(f, (0, 1), [1.0], parameters={name: 2.0}, rtol=1e-9)
        np.testing.assert_allclose(run.y[0, -1], np.exp(-2), atol=1e-7)


def test_an_argument_mode_makes_a_run_with_modes():
    run = saltus.solve(lambda t, x, mode: [1.0 + mode], (0, 1), [0.0])
    np.testing.assert_allclose(run.y[0, -1], 1.0)
    args = saltus.solve(lambda t, x, mode: [mode], (0, 1), [0.0], args=(4.0,))
    np.testing.assert_allclose(args.y[0, -1], 4.0)


@pytest.mark.parametrize("sparse", [False, True])
def test_a_constant_jacobian_goes_with_parameters(sparse):
    import scipy.sparse

    matrix = [[-2.0]]
    run = saltus.solve(
        decay, (0, 1), [1.0], parameters={"k": 2.0}, method="bdf", rtol=1e-9,
        jacobian=scipy.sparse.csr_matrix(matrix) if sparse else matrix,
    )  # fmt: skip
    np.testing.assert_allclose(run.y[0, -1], np.exp(-2), atol=1e-6)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"parameters": {"q": 1.0}}, r"no function has an argument 'q'; did you mean 'k'"),
        ({"parameters": [1.0]}, "expected a dict of names and numbers"),
        ({"parameters": {"k": "a"}}, "parameter 'k': expected numbers, found 'a'"),
        ({"parameters": {"mode": 1}}, "other than 'mode'"),
        ({"parameters": {"k": 1.0}, "mode": 1.5}, "mode: expected a whole number, found 1.5"),
        ({"parameters": {"k": 1.0}, "y0": [1.0]}, "as x0 or as y0, found both"),
        ({"parameters": {"x": 1.0}}, "'x' is one of the first 2 arguments of decay"),
        ({"parameters": {"k": 1.0}, "args": (2,)}, "'k' is one of the first 3 arguments"),
        ({}, r"Is a parameter missing in args=\(...\) or parameters=\{...\}"),
    ],
)
def test_what_makes_no_sense_is_refused(arguments, message):
    with pytest.raises(saltus.ModelError, match=message):
        saltus.solve(decay, (0, 1), [1.0], **arguments)
    with pytest.raises(saltus.ModelError, match="found none"):
        saltus.solve(decay, (0, 1))
