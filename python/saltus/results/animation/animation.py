"""`Animation`: a run as a film, drawn by matplotlib."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from saltus.errors import ModelError
from saltus.results.animation.film import Film, film_of
from saltus.results.animation.gif import write_gif
from saltus.results.animation.player import page, player
from saltus.results.animation.schedule import Schedule, schedule_of, slow_spans
from saltus.results.record import FIRINGS
from saltus.results.tables import extra

if TYPE_CHECKING:
    from saltus.results.outcome import Results

__all__ = ["Animation", "animate"]

EFFECTS = (*FIRINGS, "zeno_enter", "zeno_release")
LARGEST = 200.0  # [MB] of frames in a page; matplotlib would drop frames beyond 20 and say so
DPI = 100.0
WINDOW = 0.1  # [s] of the film at full speed, on each side of an event in slow motion


class Animation:
    """A run as a film. Made by `Results.animate`; a notebook plays it.

    Attributes
    ----------
    film : Film
        The frames: ``film.times`` [s], ``film.left`` (the frame shows x-), ``film[k]``, which is
        what the drawing gets, and ``len(film)``.
    figure : matplotlib Figure
    func_animation : matplotlib FuncAnimation
        For everything else that matplotlib does with a film.

    Examples
    --------
    >>> import os, tempfile, saltus
    >>> ball = saltus.scene("bouncing-ball", t_end=1.0).simulate(dense_output=True)
    >>> animation = ball.animate(saltus.drawings.ball(), fps=10)
    >>> len(animation.film)
    11
    >>> animation.save(os.path.join(tempfile.mkdtemp(), "ball.gif"))
    """

    def __init__(self, film: Film, draw: Callable[..., Any], fps: float, ax: Any):
        self.film = film
        self.fps = fps
        self._draw = draw
        self._ax = _axes() if ax is None else ax
        self.figure = self._ax.figure
        prepare = getattr(draw, "prepare", None)
        if prepare is not None:
            prepare(self._ax, film)
        self._caption = self._ax.set_title("", loc="left", fontsize="medium", family="monospace")
        self._fixed = set(self._ax.get_children())
        self.show_frame(0)
        if ax is None:  # laid out once: doing it again for each frame takes most of the time
            self.figure.draw_without_rendering()
            self.figure.set_layout_engine("none")

    def show_frame(self, index: int) -> Any:
        """Draws a frame into the figure, in place of the one before.

        What the drawing added to the axes for the frame before is removed; what was there when the
        film was made stays.

        Returns
        -------
        matplotlib Figure
        """
        moment = self.film[index]
        for artist in self._ax.get_children():
            if artist not in self._fixed:
                artist.remove()
        self._ax.set_prop_cycle(None)  # a curve has the same colour in each frame
        self._draw(self._ax, moment)
        side = {"left": "x\u207b", "right": "x\u207a"}[moment.side]
        names = f"  {side} {', '.join(moment.events)}" if moment.events else ""
        self._caption.set_text(f"t = {moment.time:.3f} s{names}")
        return self.figure

    @cached_property
    def func_animation(self) -> Any:
        library = extra("matplotlib.animation", "animate")
        film = library.FuncAnimation(
            self.figure,
            self._step,
            frames=len(self.film),
            interval=1000.0 / self.fps,
            repeat=True,
            cache_frame_data=False,
        )
        film._draw_was_started = True  # it would warn if it is never shown
        return film

    def _step(self, index: int) -> list[Any]:
        self.show_frame(index)
        return []

    def to_jshtml(self, default_mode: str = "loop") -> str:
        """The film as HTML with buttons, for a page of your own. Nothing is fetched from elsewhere.

        Parameters
        ----------
        default_mode : {'loop', 'once', 'reflect'}
            What happens at the end.
        """
        matplotlib = extra("matplotlib", "animate")
        kept = self.figure.dpi
        try:
            with matplotlib.rc_context({"animation.embed_limit": LARGEST, "savefig.dpi": DPI}):
                text = self.func_animation.to_jshtml(fps=self.fps, default_mode=default_mode)
        finally:
            self.figure.set_dpi(kept)
        return player(text)

    def save(self, path: str | PathLike[str], dpi: float = DPI) -> None:
        """Writes the film.

        Parameters
        ----------
        path : str or path
            The suffix says what is written: '.html', one page that needs nothing else; '.gif', by
            pillow, which comes with matplotlib, with 64 colours and times in hundredths of a
            second; '.png' and '.webp'; '.mp4', '.mov' and '.mkv', for which ffmpeg is needed.
        dpi : float
            Pixels an inch of the figure; not for '.html'.

        Raises
        ------
        ModelError
            For another suffix, or if ffmpeg is needed and not installed.
        """
        suffix = Path(path).suffix.lower()
        if suffix in (".html", ".htm"):
            Path(path).write_text(page(Path(path).stem, self.to_jshtml()), encoding="utf-8")
            return
        if suffix == ".gif":
            write_gif(path, self.show_frame, len(self.film), self.fps, dpi)
            return
        self.func_animation.save(path, writer=_writer(suffix, self.fps), dpi=dpi)

    def _repr_html_(self) -> str:
        text = self.to_jshtml()
        extra("matplotlib.pyplot", "animate").close(self.figure)  # or a notebook shows it again
        return text

    def __repr__(self) -> str:
        last = (len(self.film) - 1) / self.fps
        shared = self.film.schedule.crowded
        more = f"; {shared} events share frames with others" if shared else ""
        return (
            f"<Animation: {len(self.film)} frames, {last:.3g} s at {self.fps:g} frames a second"
            f"{more}>"
        )


def animate(
    results: Results,
    draw: Callable[..., Any],
    speed: float,
    fps: float,
    slow_motion: Mapping[str, float],
    slow_window: float | None,
    ax: Any,
) -> Animation:
    """Makes the film for `Results.animate`."""
    extra("matplotlib", "animate")
    for name, value in (("speed", speed), ("fps", fps)):
        if not (isinstance(value, (int, float, np.number)) and 0 < value < np.inf):
            raise ModelError(f"animate: {name}: expected a number above 0, found {value!r}")
    if not callable(draw):
        raise ModelError(
            "animate: draw: expected a function draw(ax, now), such as saltus.drawings.ball(), "
            f"found {draw!r}"
        )
    schedule = _schedule(results, float(speed), float(fps), slow_motion, slow_window)
    return Animation(film_of(results, schedule, speed / fps), draw, fps, ax)


def _schedule(
    results: Results,
    speed: float,
    fps: float,
    slow_motion: Mapping[str, float],
    slow_window: float | None,
) -> Schedule:
    if not results.outputs and not results.dense:
        raise ModelError(
            "animate: nothing was recorded: give recorded_signals=['block.port'] to the run"
        )
    if not results.dense and not len(results.time):
        raise ModelError("animate: the run has no rows: run it with dense_output=True")
    begin, end = results.span if results.dense else (results.time[0], results.time[-1])
    if len(results.time) and results.time[0] > results.time[-1]:
        raise ModelError("animate: this run goes back in time, and a film goes forward")
    window = WINDOW * speed if slow_window is None else slow_window
    if not (isinstance(window, (int, float, np.number)) and 0 < window < np.inf):
        raise ModelError(f"animate: slow_window: expected seconds above 0, found {slow_window!r}")
    instants = np.unique([e.time for e in results.events if e.kind in EFFECTS])
    instants = instants[(instants >= begin) & (instants <= end)]
    slow = slow_spans(results.events, slow_motion, float(window))
    return schedule_of((float(begin), float(end)), instants, speed, fps, slow)


def _axes() -> Any:
    plt = extra("matplotlib.pyplot", "animate")
    _, ax = plt.subplots(figsize=(5.0, 3.6), layout="constrained")
    return ax


def _writer(suffix: str, fps: float) -> Any:
    library = extra("matplotlib.animation", "animate")
    if suffix in (".png", ".apng", ".webp"):
        return library.PillowWriter(fps=fps)
    if suffix not in (".mp4", ".mov", ".mkv"):
        raise ModelError(
            f"animate: expected a name that ends in .html, .gif, .webp, .png, .mp4, .mov or .mkv, "
            f"found '{suffix}'"
        )
    if not library.FFMpegWriter.isAvailable():
        raise ModelError(
            f"animate: '{suffix}' is written by ffmpeg, which is not installed; .html and .gif "
            "need nothing more"
        )
    return library.FFMpegWriter(fps=fps)
