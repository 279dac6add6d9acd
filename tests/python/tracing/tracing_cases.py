"""Trace a function and call it, at values of the test's own choice."""

import numpy as np
from saltus.tracing import Refused, Signature, Traced, trace

EPS = np.finfo(float).eps


def signature(function, x=(0.7, -0.4), **options):
    x = np.asarray(x, dtype=float)
    return Signature(function=function, state_shape=x.shape, x=x, **options)


def traced(function, x=(0.7, -0.4), **options):
    outcome = trace(signature(function, x, **options))
    assert isinstance(outcome, Traced), outcome
    return outcome


def reason(function, x=(0.7, -0.4), **options):
    outcome = trace(signature(function, x, **options))
    assert isinstance(outcome, Refused), outcome.tape.to_string()
    return outcome.reason


class State:
    """What a function is called with here; not the tracer's own."""

    def __init__(self, x, z=(), mode=0, entry=0):
        self.continuous_state = np.array(x, dtype=float)
        self.discrete_state = np.array(z, dtype=float)
        self.mode = mode
        self.entry = entry


def evaluate(outcome, x, z=(), time=0.0, mode=0, entry=0, p=(), u=()):
    values = outcome.tape(time, np.ravel(x), np.array(z, float), mode, entry, np.array(p, float), u)
    return values.reshape(outcome.shape)


def assert_agrees(function, x=(0.7, -0.4), ulps=8, mode=0):
    """The tape gives what the function gives, shape too, near x and for the other sign.

    A handful of operations of at most 4 ulp each (numpy's vector loops; the C library errs by less
    than one): 8 ulp of the result where nothing cancels, which the functions here keep to.
    """
    outcome = traced(function, x, mode=mode)
    for factor in (1.0, 0.9, 1.7, -0.6):
        for time in (0.0, 1.3):
            state = State(factor * np.asarray(x, dtype=float), mode=mode)
            with np.errstate(all="ignore"):
                called = np.asarray(function(time, state))
            taped = evaluate(outcome, state.continuous_state, time=time, mode=mode)
            assert taped.shape == called.shape
            assert outcome.boolean == (called.dtype == bool)
            # room near zero: absolute errors of the size of the rounding of the arguments
            np.testing.assert_allclose(taped, called.astype(float), rtol=ulps * EPS, atol=4 * EPS)
    return outcome
