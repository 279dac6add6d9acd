"""Random scenes: the derivatives agree with differences of tight runs where these converge."""

import os

import numpy as np
import saltus
from draw_scene import scenes
from hypothesis import HealthCheck, Phase, assume, event, given, note, settings
from known import is_known
from running import LIMIT, watched
from scene import build

EXAMPLES = os.environ.get("SALTUS_FUZZ_EXAMPLES")
several = settings(
    max_examples=int(EXAMPLES or 60),
    derandomize=EXAMPLES is None,
    deadline=None,
    suppress_health_check=list(HealthCheck),
    phases=set(Phase) - {Phase.explain, Phase.shrink},
)
TIGHT = {"rtol": 1e-11, "atol": 1e-13, "throw": False, "zeno_tolerance": 1e-6}
MOST = 3  # names a scene


def names_of(context):
    """Scalar parameters and start values, as many as a run shall be differentiated by."""
    parameters = [n for n, value in context.parameters.items() if np.ndim(value) == 0]
    single = len(context.modes) == 1
    states = [] if not single else [f"x[{i}]" for i in range(len(context.continuous_state))]
    return (parameters[:MOST] + states[:MOST])[: 2 * MOST]


def varied(context, name, by):
    if name.startswith("x["):
        x = context.continuous_state.copy()
        x[int(name[2:-1])] += by
        return context.with_continuous_state(x)
    return context.with_parameter(name, context.parameters[name] + by)


def run(diagram, context, scene, **options):
    with watched(scene, 4 * LIMIT):
        return saltus.simulate(diagram, context, scene.span, **(TIGHT | options))


def shape(results):
    """What has to stay for the derivative to exist: the same events, in the same order."""
    return results.status, [(e.block, e.name, e.kind) for e in results.events]


def difference(diagram, context, scene, name, step):
    """The central difference of the last state; None where the runs differ in their events."""
    up, down = (run(diagram, varied(context, name, s), scene) for s in (step, -step))
    if shape(up) != shape(down):
        return None
    return (up.context.continuous_state - down.context.continuous_state) / (2 * step)


@several
@given(scenes())
def test_derivatives_agree_with_differences_of_runs(scene):
    assume(not is_known(scene))
    try:
        diagram = build(scene)
        context = diagram.create_context(scene.span[0])
        names = names_of(context)
        assume(names and context.continuous_state.size)
        results = run(diagram, context, scene, sensitivity=names)
    except saltus.ModelError as error:
        event(f"refused: {type(error).__name__}")
        note(str(error))
        assume(False)
    assume(results.status in ("reached_end",))
    found = results.sensitivities.continuous_state
    lost = {gap.parameter for gap in results.sensitivity_gaps}
    compared = 0
    for k, name in enumerate(names):
        if name in lost:
            event("gap")
            assert np.isnan(found[:, k]).all()
            continue
        assert np.isfinite(found[:, k]).all()
        size = 1.0 if name.startswith("x[") else max(abs(context.parameters[name]), 1e-3)
        wide = difference(diagram, context, scene, name, 2e-4 * size)
        near = difference(diagram, context, scene, name, 1e-4 * size)
        if wide is None or near is None or shape(run(diagram, context, scene)) != shape(results):
            continue
        scale = 1.0 + np.abs(near).max()
        if np.abs(wide - near).max() > 1e-4 * scale:
            continue  # the differences do not converge
        compared += 1
        # The difference has the error of its steps, a third of what two of them differ by, and that
        # of the runs, 1e-10 / 1e-4.
        np.testing.assert_allclose(
            found[:, k], near, atol=1e-5 * scale + 2 * np.abs(wide - near).max(), err_msg=name
        )
    event(f"compared {min(compared, 1)}")
