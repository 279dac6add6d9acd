"""What `print(results)` and a notebook show."""

import numpy as np
import pytest
import saltus
from systems import Ball, run


def test_a_run_in_words():
    ball = Ball(e=0.5)
    context = ball.create_context().with_continuous_state([10.0, 0.0])
    text = repr(run(ball, (0.0, 6.0), context, dense_output=True))
    assert text.startswith("<Results: reached_end, ")
    assert "t = 0 to 6 s" in text
    assert "state (" in text
    assert "events: ball.bounce " in text
    assert "at rest       ball from 4.28" in text  # t1 (1 + e) / (1 - e), t1 = sqrt(2 y0 / g)
    assert "steps of dopri5, 0 rejected" in text
    assert "at any time from 0 to 6 s" in text
    assert "took" in text


def test_what_there_is_not_is_not_told():
    system = Ball()
    results = saltus.simulate(system, (0, 1), record_events=False, recorded_signals=[])
    text = repr(results)
    assert "nothing recorded" in text
    assert "dense output" not in text and "why" not in text and "at rest" not in text


def test_why_it_ended_badly():
    results = run(Ball(), (0.0, 1.0), max_major_steps=1, throw=False)
    assert "<Results: step_limit" in repr(results)
    assert "raise max_major_steps" in repr(results)
    assert "#b3261e" in results._repr_html_()


@pytest.mark.parametrize(
    ("scene", "options"),
    [
        ("bouncing-ball", {}),
        ("bouncing-ball", {"dense_output": True}),
        ("bouncing-ball", {"max_major_steps": 2, "throw": False}),
        ("water-tanks", {"record_events": False}),
        ("newtons-cradle", {"islands": True}),
        ("van-der-pol", {"ode_solver_method": "auto"}),
    ],
)
def test_cpp_shows_the_same(scene, options):
    results = saltus.scene(scene).simulate(**options)
    assert repr(results._core) == repr(results)


def test_html_of_a_notebook():
    results = saltus.scene("bouncing-ball").simulate()
    page = results._repr_html_()
    assert page.count("<tr>") == page.count("</tr>") >= 5
    assert "reached_end" in page and "#2a7d2a" in page


def test_names_are_escaped():
    ball = Ball()
    recorded = {"<script>": ball.output()}
    page = saltus.simulate(
        ball, ball.create_context(), (0, 1), recorded_signals=recorded
    )._repr_html_()
    assert "<script>" not in page and "&lt;script&gt;" in page


def test_several_methods_are_told_in_brief():
    text = repr(saltus.scene("van-der-pol").simulate())
    assert "steps of dopri5 and radau (" in text and "stretches)" in text


def test_statistics_under_both_names():
    results = saltus.scene("kepler").simulate()
    assert results.stats is results.statistics
    assert np.isnan(results.span).all() and not results.dense


def test_a_diagram_that_exports_nothing_says_how_to_record():
    builder = saltus.DiagramBuilder()
    builder.add(saltus.library.Clock(name="clock"))
    diagram = builder.build()
    results = saltus.simulate(diagram, (0, 1))
    assert "recorded_signals=['block.port']" in repr(results)
    with pytest.raises(saltus.ModelError, match=r"recorded_signals=\['block.port'\] to the run"):
        results.plot()
    assert saltus.simulate(diagram, (0, 1), recorded_signals=["clock.out"])["clock.out"][-1] == 1.0
