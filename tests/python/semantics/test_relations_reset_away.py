"""Relations that cross their root and are put far beyond it in the same instant (semantics 3.5)."""

import numpy as np
import pytest
import saltus
from saltus.library import Comparator, Constant, Counter, Integrator, LookupTable1d, Pulse, Step

POINTS, VALUES = np.array([-1.0, -0.3, 0.4, 1.0]), np.array([0.6, 0.75, 0.3, -0.9])
METHODS = ["dopri5", "radau", "bdf"]


def table(interpolation, x):
    if interpolation == "nearest":
        return VALUES[np.argmin(abs(POINTS - x))]
    return VALUES[np.clip(np.searchsorted(POINTS, x, side="right") - 1, 0, 3)]


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("to", [-0.9, -0.5, -0.14663603, 0.2, 0.45])
@pytest.mark.parametrize("interpolation", ["nearest", "flat"])
def test_a_table_whose_jump_resets_its_own_input_knows_its_piece(interpolation, to, method):
    """x' = 0.7 from 0.5; where the table falls below 0, x goes back to `to`, one, two or three pieces
    away.
    """
    builder = saltus.DiagramBuilder()
    x = builder.add(Integrator(0.5, enable_reset=True, enable_external_reset=True, name="x"))
    lookup = builder.add(LookupTable1d(POINTS, VALUES, interpolation, name="table"))
    below = builder.add(Comparator("<"))
    for source, target in (
        (builder.add(Constant(0.7)), x.input("in")),
        (builder.add(Constant(to)), x.input("reset_value")),
        (x, lookup.input()),
        (lookup, below.input(0)),
        (builder.add(Constant(0.0)), below.input(1)),
        (below, x.input("reset_trigger")),
    ):
        builder.connect(source.output(), target)
    builder.export_output(x.output(), "x")
    builder.export_output(lookup.output(), "table")
    times = np.linspace(0.05, 2.5, 80)
    results = saltus.simulate(
        builder.build(), (0.0, 2.5), save_at=times, event_rows=False, ode_solver_method=method
    )
    knots = POINTS if interpolation == "flat" else 0.5 * (POINTS[1:] + POINTS[:-1])
    # At a knot the located root decides: rows nearer to it than 1e-6 are not asked.
    off = [k for k, x in enumerate(results["x"]) if np.min(abs(knots - x)) > 1e-6]
    assert len(off) > 70
    expected = [table(interpolation, results["x"][k]) for k in off]
    assert list(results["table"][off]) == expected


@pytest.mark.parametrize("method", ["dopri5", "dop853", "adams", "bdf", "radau"])
@pytest.mark.parametrize("start", [-2.0, -1.9, -1.5, -2.2])
def test_an_edge_is_counted_once(start, method):
    """c = pulse > x turns true with the pulse at 2 s, and its count resets x. From -2 on, x comes to
    the pulse's low level at that very time, and rounding decides whether c has an edge; it never has
    two.
    """
    builder = saltus.DiagramBuilder()
    pulse = builder.add(Pulse(1.5, period=2.0, pulse_width=0.4, phase_delay=2.0))
    x = builder.add(Integrator(start, name="x", enable_reset=True))
    rises, counted = builder.add(Comparator(">")), builder.add(Comparator("<"))
    counter, other = builder.add(Counter()), builder.add(Integrator())
    for source, target in (
        (builder.add(Constant(1.0)), x.input("in")),
        (pulse, rises.input(0)),
        (x, rises.input(1)),
        (rises, counter.input()),
        (builder.add(Constant(0.5)), counted.input(0)),
        (counter, counted.input(1)),
        (counted, x.input("reset_trigger")),
        (builder.add(Step(0.0, 1.0, 2.3)), other.input("in")),
    ):
        builder.connect(source.output(), target)
    signals = {"c": rises.output(), "n": counter.output()}
    results = saltus.simulate(
        builder.build(), (0.0, 2.7), recorded_signals=signals, ode_solver_method=method
    )
    edges = np.flatnonzero(np.diff(results["c"].astype(float)) > 0)
    assert results["n"][-1] == len(edges)
    assert len(edges) == 0 if start == -2.2 else len(edges) <= 1
