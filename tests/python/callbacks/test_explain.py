"""`system.explain()`: how each callback runs, and why not faster; nothing is run."""

import runpy
from pathlib import Path

import numpy as np
import saltus
from saltus.library import FunctionBlock, Gain, Step

from models import Pendulum, leaf


def test_a_line_for_each_callback():
    explanation = Pendulum().explain()
    assert [(r.block, r.callback, r.runs) for r in explanation] == [
        ("pendulum", "ode", "traced"),
        ("pendulum", "output 'energy'", "traced"),
        ("pendulum", "guard of 'low'", "traced"),
        ("pendulum", "reset map of 'low'", "traced"),
    ]
    assert str(explanation).splitlines()[0].split() == ["pendulum:", "ode", "traced"]


def test_why_not():
    def ode(time, state):
        return [-1.0 if state.continuous_state[0] > 0.0 else 1.0]

    (callback,) = leaf(ode).explain()
    assert callback.runs == callback.rung == "called"
    assert "test_explain.py" in callback.reason
    assert "np.where" in callback.reason or "mode" in callback.reason
    assert callback.reason in str(leaf(ode).explain())


def test_paths_of_nested_blocks():
    inner, outer = saltus.DiagramBuilder(), saltus.DiagramBuilder()
    inner.add(Pendulum())
    outer.add(inner.build("inner"))
    assert {r.block for r in outer.build().explain()} == {"inner.pendulum"}


def test_open_inputs_are_said():
    explanation = FunctionBlock(lambda u: np.sin(u), name="sine").explain()
    assert [r.runs for r in explanation] == ["traced"]
    assert "open inputs" in str(explanation)


def test_no_python_at_all():
    assert Gain(2.0).explain() == ()
    assert "no callback is a Python function" in str(Gain(2.0).explain())
    assert saltus.scene("bouncing-ball").system.explain() == ()


def test_the_scenes_of_the_tutorial_are_traced():
    scenes = Path(__file__).parents[1] / "scenes"
    ball = runpy.run_path(str(scenes / "ball_leaf.py"))["Ball"]()
    over = runpy.run_path(str(scenes / "ball_zeno.py"))["ball_over"]
    diagram = over(Step(name="floor"), 9.81, 0.9)
    assert [r.runs for r in ball.explain()] == ["traced"] * 3
    assert [r.runs for r in diagram.explain()] == ["traced"]
    assert "opaque" not in saltus.Simulator(diagram).describe()


def test_nothing_runs():
    times = []
    block = leaf(lambda t, s: times.append(t) or [0.0])
    block.explain()
    assert times == []
