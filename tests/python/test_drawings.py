"""Ready drawings: what is where in a frame."""

from itertools import pairwise

import numpy as np
import pytest
import saltus
from saltus import ModelError
from saltus.drawings import of_scene, pick
from saltus.drawings.of_scene import NAMES

plt = pytest.importorskip("matplotlib.pyplot")
MECHANICAL = [
    "bouncing-ball", "bouncing-ball-blocks", "ball-drag", "ball-table", "two-walls",
    "newtons-cradle", "rimless-wheel", "rocking-block", "stick-slip", "kepler", "pleiades",
]  # fmt: skip


@pytest.fixture(autouse=True)
def close():
    yield
    plt.close("all")


def film_of(name, draw=None, fps=10.0, speed=None, **parameters):
    scene = saltus.scene(name, **parameters)
    run = scene.simulate(dense_output=True)
    draw = draw or of_scene(name, scene.parameters)
    end = scene.t_span[1]
    return run.animate(draw, fps=fps, speed=end / 4.0 if speed is None else speed)


def discs(ax):
    return [(*patch.center, patch.radius) for patch in ax.patches if hasattr(patch, "radius")]


@pytest.mark.parametrize("name", MECHANICAL)
def test_scenes_of_the_shelf_have_a_drawing_inside_its_limits(name):
    animation = film_of(name)
    for frame in range(0, len(animation.film), 7):
        ax = animation.show_frame(frame).axes[0]
        left, right = ax.get_xlim()
        low, high = ax.get_ylim()
        for x, y, _ in discs(ax):
            assert left <= x <= right and low <= y <= high
        assert ax.get_children()


def test_a_reaction_has_none():
    assert of_scene("robertson", {}) is None


def test_a_ball_touches_the_floor_at_a_bounce_and_nowhere_else():
    animation = film_of("bouncing-ball", speed=1.0, fps=20.0)
    for now in animation.film:
        ((_, y, radius),) = discs(animation.show_frame(now.index).axes[0])
        assert y - radius == pytest.approx(now["y"][0], abs=1e-12)
        assert (abs(y - radius) < 1e-9) == bool(now.events)


def test_a_table_moves_under_its_ball():
    animation = film_of("ball-table", speed=0.5, fps=30.0)
    k = next(k for k, now in enumerate(animation.film) if now.events)
    now = animation.film[k]
    ax = animation.show_frame(k).axes[0]
    (level,) = {float(y) for line in ax.lines for y in line.get_ydata()}
    ((_, y, radius),) = discs(ax)
    assert level == pytest.approx(0.05 * np.sin(10.0 * now.time)) == pytest.approx(y - radius)


def test_balls_of_a_cradle_touch_at_an_impact():
    """The two of an impact are a diameter apart, and no ball is in another, in any frame."""
    animation = film_of("newtons-cradle", speed=0.002, fps=4.0, t_end=0.33)
    touched = 0
    for now in animation.film:
        if now.time < 0.3 and now.index % 40:
            continue
        places = discs(animation.show_frame(now.index).axes[0])
        gaps = [np.hypot(b[0] - a[0], b[1] - a[1]) - 2 * a[2]
                for a, b in pairwise(places)]  # fmt: skip
        # arcs of 0.39 m in place of straight lines: (0.1 m)^2 / (2 * 0.39 m) at most
        assert min(gaps) > -1e-5
        touched += bool(now.events) and min(map(abs, gaps)) < 1e-5
    assert touched >= 4


def test_the_wheel_turns_from_spoke_to_spoke():
    """Before and after a spoke lands the drawn spokes are in the same places."""
    animation = film_of("rimless-wheel", fps=30.0)
    k = next(k for k, now in enumerate(animation.film) if now.events)

    def ends(frame):
        ax = animation.show_frame(frame).axes[0]
        spokes = [line.get_xydata()[1] for line in ax.lines if line.get_xydata()[0, 0] == 0.0
                  and len(line.get_xydata()) == 2 and line.get_xydata()[0, 1] == 0.6]  # fmt: skip
        return np.array(sorted(map(tuple, np.round(spokes, 9))))

    before, after = ends(k), ends(k + 1)
    assert len(before) == 8
    np.testing.assert_allclose(before, after, atol=1e-6)
    assert animation.film[k].fired("spoke") + 1 == animation.film[k + 1].fired("spoke") == 1


def test_a_block_stands_on_the_edge_it_turns_about():
    animation = film_of("rocking-block")
    for now in animation.film:
        (block,) = animation.show_frame(now.index).axes[0].patches
        corners = block.get_xy()[:4]
        lowest = corners[np.argmin(corners[:, 1])]
        assert lowest[1] == pytest.approx(0.0, abs=1e-12)
        if abs(now["state"][0]) > 1e-6:
            assert np.sign(lowest[0]) == np.sign(now["state"][0])


def swing(t, x):
    return [x[1], -9.81 * np.sin(x[0])]


def test_a_pendulum_hangs_or_stands():
    run = saltus.solve(swing, (0, 1), [0.5, 0.0], dense_output=True)
    for upright, sign in ((False, -1.0), (True, 1.0)):
        animation = run.animate(saltus.drawings.pendulum("x[0]", upright=upright), fps=5)
        for now in animation.film:
            *_, (x, y, _) = discs(animation.show_frame(now.index).axes[0])
            angle = now["x"][0]
            assert (x, y) == pytest.approx((np.sin(angle), sign * np.cos(angle)))


@pytest.mark.parametrize("name", ["mass_on_spring", "quarter_car", "pendulum_on_cart"])
def test_other_drawings_follow_their_numbers(name):
    run = saltus.solve(
        lambda t, x: [x[1], -x[0], x[3], -4 * x[2]], (0, 3), [0.1, 0.0, 0.2, 0.0],
        dense_output=True,
    )  # fmt: skip
    animation = run.animate(NAMES[name](), fps=5)
    middles = []
    for now in animation.film:
        ax = animation.show_frame(now.index).axes[0]
        boxes = [p for p in ax.patches if hasattr(p, "get_xy") and len(p.get_xy()) == 5]
        middles.append(boxes[0].get_xy()[:4].mean(axis=0)[1 if name == "quarter_car" else 0])
    np.testing.assert_allclose(np.diff(middles), np.diff(pick(animation.film.values, 0)), atol=1e-9)


def test_pick_reads_names_and_numbers():
    values = saltus.scene("bouncing-ball-blocks").simulate(dense_output=True)([0.0, 0.5])
    np.testing.assert_array_equal(pick(values, "v"), values["v"])
    np.testing.assert_array_equal(pick(values, 1), values["v"])
    with pytest.raises(
        ModelError, match="needs entry 2 of what was recorded, and there are 2: y, v"
    ):
        pick(values, 2)
    with pytest.raises(ModelError, match="nothing was recorded under 'w'"):
        pick(values, "w")


def test_importing_drawings_imports_no_matplotlib():
    import subprocess
    import sys

    code = "import saltus, sys; saltus.drawings.ball(); print('matplotlib' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"
