"""`Pictures`: the plots and films of results, each by matplotlib or plotly when it is asked for."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

if TYPE_CHECKING:
    from saltus.results.animation import Animation
    from saltus.results.outcome import Results
    from saltus.system import System

__all__ = ["Pictures"]


class Pictures:
    """The part of `Results` that draws.

    Examples
    --------
    >>> import saltus
    >>> saltus.scene("bouncing-ball").simulate().plot_phase().get_ylabel()
    'y[1]'
    """

    def plot(self, *names: str, ax: Any = None, backend: str = "matplotlib", **style: Any) -> Any:
        """Draws recorded signals over time. Needs matplotlib or plotly.

        A jump is a gap with a hollow marker before and a filled one after it, a Zeno hold is
        shaded, each event of a guard has a tick at the bottom. Where the run kept dense output,
        curves are drawn from that, else straight from row to row. Where the blocks say them, the
        label of a state has its unit, and an axis that shows nothing but a mode has the names of
        the modes.

        Parameters
        ----------
        *names : str
            The signals, or entries such as 'state[0]'; by default all.
        ax : matplotlib Axes, optional
            The axes to draw into; by default each signal gets axes of its own in a new figure, one
            below the other.
        backend : {'matplotlib', 'plotly'}
            plotly's figures can be zoomed in a notebook, and show the values under the pointer.
        **style
            Passed on to matplotlib's `plot`, or plotly's `Scatter`, for every curve, such as
            ``color="k"``.

        Returns
        -------
        Axes, array of Axes, or plotly Figure
            A single Axes for one signal, so that ``results.plot("y").set_title(...)`` works.

        Raises
        ------
        ModelError
            If a name is unknown, or nothing was recorded.
        ImportError
            If the library is not installed; it says how to install it.

        Examples
        --------
        >>> import saltus
        >>> axes = saltus.solve(lambda t, x: -x, (0, 1), [1.0]).plot()
        >>> axes.get_xlabel()
        'time [s]'
        """
        from saltus.results.charts import draw_signals

        return draw_signals(self._results, names, ax, backend, style)

    def plot_phase(
        self, x: str | int = 0, y: str | int = 1, *, ax: Any = None,
        backend: str = "matplotlib", **style: Any,
    ) -> Any:  # fmt: skip
        """Draws one recorded number over another: the phase portrait.

        The flow is a line. Each jump is a dashed line from a hollow marker, x-, to a filled one,
        x+. The start is a square.

        Parameters
        ----------
        x, y : str or int
            A signal, an entry of a signal such as 'state[0]', or the number of an entry counted
            over all recorded signals.
        ax, backend, **style
            As in `plot`.

        Returns
        -------
        Axes, or plotly Figure

        Raises
        ------
        ModelError
            If a name is unknown, or nothing was recorded.

        Examples
        --------
        >>> import saltus
        >>> ball = saltus.scene("bouncing-ball").simulate(dense_output=True)
        >>> axes = ball.plot_phase("y[0]", "y[1]")
        >>> axes.get_xlabel(), axes.get_ylabel()
        ('y[0]', 'y[1]')
        """
        from saltus.results.charts import draw_phase

        return draw_phase(self._results, x, y, ax, backend, style)

    def plot_events(
        self, *names: str, ax: Any = None, backend: str = "matplotlib", **style: Any
    ) -> Any:
        """Draws the times of the events, a row for each name: the event raster.

        A hold is a bar in the row of the event at which it began.

        Parameters
        ----------
        *names : str
            The names of events, with or without their blocks, in order from the top; by default all
            that happened, in the order in which they first did.
        ax, backend, **style
            As in `plot`.

        Returns
        -------
        Axes, or plotly Figure

        Raises
        ------
        ModelError
            If no event has a name, or none happened.

        Examples
        --------
        >>> import saltus
        >>> tanks = saltus.scene("water-tanks", t_end=7.0).simulate()
        >>> [label.get_text() for label in tanks.plot_events().get_yticklabels()]
        ['tanks.second_low', 'tanks.first_low']
        """
        from saltus.results.charts import draw_raster

        return draw_raster(self._results, names, ax, backend, style)

    def plot_zeno(
        self, name: str | None = None, signal: str | int | None = None, *, ax: Any = None,
        backend: str = "matplotlib", **style: Any,
    ) -> Any:  # fmt: skip
        """Draws events that accumulate, over the logarithm of the time that is left.

        With the accumulation time t* that was predicted at the hold and the events at t_k before
        it, the picture has the points (t* - t_k, k), or the `signal` over t* - t, with logarithmic
        axes. Time runs to the right. Where gaps shrink by a constant factor, the points are on a
        straight line.

        Parameters
        ----------
        name : str, optional
            The event; by default the first that has a hold.
        signal : str or int, optional
            A recorded number, such as a height, in place of the number k of the event.
        ax, backend, **style
            As in `plot`.

        Returns
        -------
        Axes, or plotly Figure

        Raises
        ------
        ModelError
            If no event, or none of this name, accumulated.

        Examples
        --------
        >>> import saltus
        >>> ball = saltus.scene("bouncing-ball", t_end=40.0).simulate()
        >>> ball.plot_zeno("bounce").get_ylabel()
        'number of the event'
        """
        from saltus.results.charts import draw_zeno

        return draw_zeno(self._results, name, signal, ax, backend, style)

    def plot_section(
        self, name: str, x: str | int = 0, y: str | int = 1, *, side: str = "right",
        ax: Any = None, backend: str = "matplotlib", **style: Any,
    ) -> Any:  # fmt: skip
        """Draws one recorded number over another at the events of one name: a Poincare section.

        Parameters
        ----------
        name : str
            The event, with or without its block. A guard without an effect, or a time event once a
            period, is a section too.
        x, y : str or int
            As in `plot_phase`.
        side : {'right', 'left'}
            The values after each event, or those before it.
        ax, backend, **style
            As in `plot`; matplotlib draws with `plot`, marker by marker.

        Returns
        -------
        Axes, or plotly Figure

        Raises
        ------
        ModelError
            If no event has the name, it never happened, or a signal is unknown.

        Examples
        --------
        >>> import saltus
        >>> table = saltus.scene("ball-table").simulate()
        >>> axes = table.plot_section("bounce", "state[0]", "state[1]")
        >>> len(axes.lines[0].get_xdata())
        12
        """
        from saltus.results.charts import draw_section

        return draw_section(self._results, name, (x, y), side, ax, backend, style)

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

        return animate(self._results, draw, speed, fps, slow_motion or {}, slow_window, ax)

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

        return view_results(self._results, path, draw, system, title, browse)

    @property
    def _results(self) -> Results:
        return cast("Results", self)
