"""`Films`: a run as a film, and as a page of HTML that may hold the film."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from os import PathLike
from typing import TYPE_CHECKING, Any, cast

if TYPE_CHECKING:
    from pathlib import Path

    from saltus.results.animation import Animation
    from saltus.results.outcome import Results
    from saltus.system import System

__all__ = ["Films"]


class Films:
    """The part of `Results` that shows a run in motion.

    Examples
    --------
    >>> import saltus
    >>> ball = saltus.scene("bouncing-ball", t_end=1.0).simulate(dense_output=True)
    >>> ball.animate(saltus.drawings.ball(), fps=10.0)
    <Animation: 11 frames, 1 s at 10 frames a second>
    """

    def animate(
        self, draw: Callable[..., Any], *, speed: float = 1.0, fps: float = 30.0,
        slow_motion: Mapping[str, float] | None = None, slow_window: float | None = None,
        ax: Any = None,
    ) -> Animation:  # fmt: skip
        """The run as a film, by matplotlib.

        Frame k shows the values at k / fps seconds of the film, from dense output. An event has two
        frames at its own time: the frame before it shows x-, the frame after it x+, and the film
        keeps its clock. Events closer than two frames share them.

        Parameters
        ----------
        draw : callable
            ``draw(ax, now)`` adds to matplotlib's axes what one frame shows; it is removed before
            the next frame. `now` has the values of that time: ``now["y"]``,
            ``now.continuous_state``, ``now.time``, ``now.side``, ``now.events``, ``now.index``,
            ``now.fired("bounce")``. If `draw` has a method ``prepare(ax, film)``, it is called
            once, for limits and for what does not move. `saltus.drawings` has ready ones.
        speed : float
            [s of the run per s of the film]
        fps : float
            [1/s] frames a second.
        slow_motion : mapping of str to float, optional
            Names of events, with the factor by which the film is slower around them:
            ``{"bounce": 0.2}``. Where two overlap, the slower one holds.
        slow_window : float, optional
            [s of the run] before and after such an event; by default 0.1 s times `speed`.
        ax : matplotlib Axes, optional
            The axes to draw into; by default those of a new figure.

        Returns
        -------
        Animation
            Shown by a notebook. ``save("film.html")`` writes one page that needs nothing else,
            ``save("film.gif")`` a GIF.

        Raises
        ------
        ModelError
            If an option has no meaning, an event is unknown, the run goes back in time, or it kept
            no dense output and its rows are farther apart than two frames.
        ImportError
            If matplotlib is not installed.

        Examples
        --------
        >>> import saltus
        >>> ball = saltus.scene("bouncing-ball", t_end=3.0).simulate(dense_output=True)
        >>> animation = ball.animate(saltus.drawings.ball(), slow_motion={"bounce": 0.2})
        >>> animation
        <Animation: 115 frames, 3.8 s at 30 frames a second>
        """
        from saltus.results.animation import animate

        return animate(cast("Results", self), draw, speed, fps, slow_motion or {}, slow_window, ax)

    def view(
        self, path: str | PathLike[str] | None = None, *, draw: Callable[..., Any] | None = None,
        system: System | None = None, title: str = "", browse: bool | None = None,
    ) -> Path:  # fmt: skip
        """Writes one page of HTML about the run, and opens it in the browser. Needs matplotlib.

        The page has the diagram, the plots, the events, the counts and, with `draw`, the film. It
        is one file that needs nothing else.

        Parameters
        ----------
        path : str or path, optional
            The file; by default one in a temporary folder.
        draw : callable, optional
            As in `animate`.
        system : System, optional
            The system of the run, for its diagram; by default that which the results know.
        title : str
            By default the name of the system.
        browse : bool, optional
            Whether to open the page; by default if there is no `path`.

        Returns
        -------
        Path
            The file.

        Examples
        --------
        >>> import pathlib, tempfile, saltus
        >>> ball = saltus.scene("bouncing-ball").simulate(dense_output=True)
        >>> file = pathlib.Path(tempfile.mkdtemp(), "ball.html")
        >>> ball.view(file, draw=saltus.drawings.ball()) == file
        True
        """
        from saltus.viewing import view_results

        return view_results(cast("Results", self), path, draw, system, title, browse)
