"""Films: which time and which values each frame shows, and what is written."""

import subprocess
import sys
from itertools import pairwise

import numpy as np
import pytest
import saltus
from saltus import Guard, ModelError
from saltus.drawings import Drawing, pick

plt = pytest.importorskip("matplotlib.pyplot")
Image = pytest.importorskip("PIL.Image")
G, E = 10.0, 0.5
FRAME = 1e-9  # [frames] rounding of times


@pytest.fixture(autouse=True)
def close():
    yield
    plt.close("all")


def fall(until=3.0, **options):
    """Falls from 5 m: bounces at 1, 2, 2.5, 2.75, ... s, with speeds 10, 5, 2.5, ..."""
    floor = Guard(lambda t, x: x[0], lambda t, x: [0, -E * x[1]], "falling", name="bounce")
    return saltus.solve(
        lambda t, x: [x[1], -G], (0.0, until), [5.0, 0.0], events=floor, rtol=1e-10, atol=1e-12,
        **{"dense_output": True} | options,
    )  # fmt: skip


def in_rows(run, until, times):
    """The same run without dense output, with rows at these times and at events."""
    start = run.system.create_context()
    return saltus.simulate(
        run.system, start, (0.0, until), rtol=1e-10, atol=1e-12, save_at=times,
        recorded_signals={"x": run.system.output(0)},
    )  # fmt: skip


@pytest.fixture(scope="module")
def ball():
    return fall(until=2.6)


def nothing(ax, now):
    pass


def shown(animation):
    """(time, side) of the frames that show an event."""
    return [(now.time, now.side) for now in animation.film if now.events]


@pytest.mark.parametrize(("speed", "fps"), [(1.0, 30.0), (0.5, 10.0), (2.0, 7.0), (1.3, 24.0)])
def test_there_is_a_frame_for_each_tick_of_the_film(ball, speed, fps):
    """A run of T takes T / speed, so the film has floor(T fps / speed) + 1 frames."""
    film = ball.animate(nothing, speed=speed, fps=fps).film
    assert len(film) == int(np.floor(2.6 / speed * fps + 1e-9)) + 1
    assert film.times[0] == 0.0 and film.times[-1] == 2.6
    assert (np.diff(film.times) >= 0).all()


def test_a_frame_shows_its_own_time_but_beside_events(ball):
    """Frame k shows k speed / fps; the frames that moved to an event moved by a frame at most."""
    fps, speed = 40.0, 0.8
    film = ball.animate(nothing, fps=fps, speed=speed).film
    due = np.arange(len(film)) * speed / fps
    moved = [bool(now.events) for now in film]
    moved[-1] = True  # it shows the end, which is between two ticks
    np.testing.assert_allclose(film.times[~np.array(moved)], due[~np.array(moved)], atol=1e-12)
    assert np.max(np.abs(film.times - due)) <= (1 + FRAME) * speed / fps


def test_the_state_of_a_frame_is_that_of_dense_output(ball):
    film = ball.animate(nothing, fps=25.0).film
    for now in film:
        expected = ball(now.time, side=now.side)
        np.testing.assert_array_equal(now["x"], expected["x"])
        np.testing.assert_array_equal(now.continuous_state, expected.continuous_state)


def test_an_event_has_two_frames_at_its_own_time(ball):
    """x- and x+, next to each other; their speeds have the ratio -e, their heights are zero."""
    animation = ball.animate(nothing, fps=30.0)
    bounces = ball.events.times("bounce")
    assert shown(animation) == [(t, side) for t in bounces for side in ("left", "right")]
    np.testing.assert_allclose(bounces, [1.0, 2.0, 2.5], atol=1e-9)
    film = list(animation.film)
    for before, after in pairwise(film):
        if before.events and before.side == "left":
            assert after.side == "right" and after.time == before.time
            assert before["x"][1] == pytest.approx(-after["x"][1] / E)
            assert before.fired("bounce") + 1 == after.fired("bounce")


def test_slow_motion_stretches_the_film_around_events_only(ball):
    """Each window of 2 w takes 2 w / factor: three bounces whose windows do not meet."""
    window, factor, fps = 0.05, 0.1, 100.0
    plain = ball.animate(nothing, fps=fps).film
    slow = ball.animate(nothing, fps=fps, slow_motion={"bounce": factor}, slow_window=window).film
    more = 3 * 2 * window * (1.0 / factor - 1.0)  # [s]
    assert len(slow) - len(plain) == pytest.approx(more * fps, abs=1)
    steps = np.diff(slow.times) * fps
    middles = 0.5 * (slow.times[1:] + slow.times[:-1])
    far = np.min(np.abs(middles[:, None] - ball.events.times("bounce")), axis=1) > 1.5 * window
    near = np.min(np.abs(middles[:, None] - ball.events.times("bounce")), axis=1) < 0.5 * window
    moved = np.array([bool(now.events) for now in slow])
    beside = moved[1:] | moved[:-1]
    np.testing.assert_allclose(steps[far & ~beside][:-1], 1.0, rtol=1e-6)
    np.testing.assert_allclose(steps[near & ~beside], factor, rtol=1e-6)


def test_overlapping_windows_go_by_the_slower_one():
    """Two clocks with the same ticks; the film is as long as with the slower factor alone."""
    system = saltus.LeafSystem(name="clocks")
    system.declare_continuous_state([0.0], ode=lambda t, s: [1.0])
    system.declare_continuous_state_output("x")
    for name in ("fast", "slow"):
        system.declare_periodic_update(lambda t, s: s, 0.5, name=name)
    run = saltus.simulate(system, (0.0, 2.0), recorded_signals=["x"], dense_output=True)
    both = run.animate(nothing, slow_motion={"fast": 0.5, "slow": 0.2})
    alone = run.animate(nothing, slow_motion={"slow": 0.2})
    np.testing.assert_array_equal(both.film.times, alone.film.times)


def test_events_closer_than_two_frames_share_them():
    """A Zeno sequence: the film keeps its clock, and says how many events have no frames."""
    run = fall(until=4.0)
    animation = run.animate(nothing, fps=20.0)
    film = animation.film
    assert len(film) == 81
    due = np.arange(81) / 20.0
    assert np.max(np.abs(film.times - due)) <= (1 + FRAME) / 20.0
    instants = {e.time for e in run.events}
    assert film.schedule.crowded == len(instants - set(film.schedule.events)) > 0
    assert f"{film.schedule.crowded} events share frames" in repr(animation)


def test_the_first_frame_shows_the_start():
    """Also if the first event comes before the second frame."""
    run = fall(until=3.0)
    film = run.animate(nothing, fps=0.9, speed=1.0).film
    assert film.times[0] == 0.0 and not film[0].events
    assert (np.diff(film.times) >= 0).all()


def test_an_event_at_the_end_is_shown():
    stops = Guard(lambda t, x: x[0], terminal=True, name="lands", direction="falling")
    run = saltus.solve(
        lambda t, x: [x[1], -G], (0.0, 9.0), [5.0, 0.0], events=stops, dense_output=True
    )
    film = run.animate(nothing).film
    assert film.times[-1] == run.time[-1] == pytest.approx(1.0)
    assert film[-1].events == ("lands",)


def test_rows_that_are_close_enough_do_without_dense_output():
    """Straight lines between rows h apart are at most h^2 g / 8 off the parabola."""
    every = 1.0 / 60.0
    times = np.arange(0.0, 2.6, every)
    exact = fall(until=2.6)
    rows = in_rows(exact, 2.6, times)
    film = rows.animate(nothing, fps=30.0).film
    same = exact.animate(nothing, fps=30.0).film
    np.testing.assert_allclose(film.times, same.times, atol=1e-9)
    off = np.abs(pick(film.values, 0) - pick(same.values, 0))
    assert np.max(off) <= every**2 * G / 8 + 1e-7
    np.testing.assert_array_equal(film.left, same.left)


def test_rows_that_are_too_far_apart_are_refused():
    with pytest.raises(
        ModelError, match="run it with dense_output=True, or with rows at save_at times"
    ):
        fall(dense_output=False).animate(nothing)


def test_a_loaded_run_with_rows_can_be_animated(tmp_path):
    in_rows(fall(), 3.0, np.arange(0.0, 3.0, 1 / 30)).save(tmp_path / "run.npz")
    film = saltus.load_results(tmp_path / "run.npz").animate(nothing).film
    assert len(film) == 91 and film[0].continuous_state.shape == (0,)


def test_a_drawing_is_removed_before_the_next_frame(ball):
    """What was prepared stays, what was drawn for a frame goes."""
    seen = []

    def prepare(ax, film):
        ax.axhline(0.0)
        ax.set_xlim(-3, 3)
        seen.append(len(film))

    dot = Drawing(lambda ax, now: ax.plot([0], [now["x"][0]], "o"), prepare)
    animation = ball.animate(dot)
    ax = animation.figure.axes[0]
    for frame in (5, 9, 2):
        animation.show_frame(frame)
        assert len(ax.lines) == 2 and ax.get_xlim() == (-3, 3)
        assert ax.lines[1].get_ydata()[0] == animation.film[frame]["x"][0]
    assert seen == [len(animation.film)]


def test_a_plain_function_draws(ball):
    """Into axes of the user's own, which keep what they had."""
    _, ax = plt.subplots()
    (mine,) = ax.plot([0, 1], [0, 1])
    animation = ball.animate(lambda ax, now: ax.text(0, 0, f"{now.time:.2f}"), ax=ax)
    animation.show_frame(3)
    assert mine in ax.lines and [t.get_text() for t in ax.texts] == [
        f"{animation.film[3].time:.2f}"
    ]


def test_the_title_says_time_side_and_event(ball):
    animation = ball.animate(nothing)
    k = next(k for k, now in enumerate(animation.film) if now.events)
    ax = animation.show_frame(k).axes[0]
    assert ax.get_title("left") == "t = 1.000 s  x\u207b bounce"
    animation.show_frame(k + 1)
    assert ax.get_title("left") == "t = 1.000 s  x\u207a bounce"


def test_html_needs_nothing_from_elsewhere(ball, tmp_path):
    animation = ball.animate(nothing, fps=5)
    animation.save(tmp_path / "ball.html")
    text = (tmp_path / "ball.html").read_text()
    assert text.startswith("<!DOCTYPE html>") and text.count("data:image/png;base64") == 14
    for sign in ("http://", "https://", "<link", ' src="/', "@import", "fa-play"):
        assert sign not in text, sign
    assert "anim-slider" in animation._repr_html_()


def test_a_gif_has_the_frames(ball, tmp_path):
    """Each differs from the one before, so that none is merged with it."""
    animation = ball.animate(lambda ax, now: ax.plot([0, now.index], [0, 1]), fps=10)
    animation.save(tmp_path / "ball.gif", dpi=40)
    with Image.open(tmp_path / "ball.gif") as image:
        assert image.n_frames == len(animation.film) == 27
        assert image.info["duration"] == 100  # [ms]
        assert image.convert("RGB").getpixel((1, 1)) == (255, 255, 255)


def test_curves_keep_their_colour(ball):
    """Each frame draws them anew, with the first colour of the cycle."""
    animation = ball.animate(lambda ax, now: ax.plot([0, 1], [0, 1]), fps=10)
    ax = animation.figure.axes[0]
    colours = {animation.show_frame(k).axes[0].lines[0].get_color() for k in range(4)}
    assert len(colours) == 1 and len(ax.lines) == 1


def test_matplotlib_has_its_own_animation(ball):
    from matplotlib.animation import FuncAnimation

    animation = ball.animate(nothing)
    assert isinstance(animation.func_animation, FuncAnimation)
    assert animation.func_animation is animation.func_animation


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"speed": 0.0}, "speed: expected a number above 0, found 0.0"),
        ({"fps": -1}, "fps: expected a number above 0, found -1"),
        ({"fps": float("inf")}, "fps: expected a number above 0"),
        ({"slow_motion": {"bounce": 0}}, r"slow_motion\['bounce'\]: expected a factor above 0"),
        ({"slow_motion": {"bounce": 2.0}}, "up to 1, by which the film is slower there, found 2.0"),
        ({"slow_motion": {"bonce": 0.5}}, "did you mean 'bounce'"),
        ({"slow_window": -1.0}, "slow_window: expected seconds above 0, found -1.0"),
        ({"speed": 1e-6}, r"frames for 2.6 s at speed 1e-06 .* expected at most 20000"),
    ],
)
def test_wrong_options_are_named(ball, options, says):
    with pytest.raises(ModelError, match=says):
        ball.animate(nothing, **options)


def test_wrong_drawings_and_files_are_named(ball, tmp_path):
    with pytest.raises(ModelError, match=r"expected a function draw\(ax, now\)"):
        ball.animate("ball")
    with pytest.raises(ModelError, match=r"expected a name that ends in \.html, \.gif"):
        ball.animate(nothing).save(tmp_path / "ball.svg")
    with pytest.raises(IndexError, match="frame 79 of 79"):
        ball.animate(nothing).film[79]


def test_a_run_back_in_time_and_a_run_without_rows_are_refused():
    back = saltus.solve(lambda t, x: -x, (1.0, 0.0), [1.0], t_eval=np.linspace(1, 0, 99))
    with pytest.raises(ModelError, match="goes back in time"):
        back.animate(nothing)
    scene = saltus.scene("bouncing-ball")
    bare = saltus.simulate(scene.system, scene.context, (0, 1), recorded_signals={})
    with pytest.raises(ModelError, match="nothing was recorded"):
        bare.animate(nothing)


def test_without_matplotlib_the_message_says_what_to_install():
    code = (
        "import sys; sys.modules['matplotlib'] = None\n"
        "import saltus\n"
        "run = saltus.scene('two-walls', t_end=1.0).simulate(dense_output=True)\n"
        "for draw in (lambda: run.animate(saltus.drawings.ball()), run.plot_phase, run.plot):\n"
        "    try: draw()\n"
        "    except ImportError as error: print(error)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    lines = done.stdout.splitlines()
    assert len(lines) == 3
    assert all("needs matplotlib" in line and "pip install matplotlib" in line for line in lines)
