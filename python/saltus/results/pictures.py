"""`Pictures`: the plots of results, each by matplotlib or plotly when it is asked for."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

from saltus.results.event_pictures import EventPictures
from saltus.results.films import Films

if TYPE_CHECKING:
    from saltus.results.outcome import Results

__all__ = ["Pictures"]


class Pictures(EventPictures, Films):
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

        return draw_signals(cast("Results", self), names, ax, backend, style)

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

        return draw_phase(cast("Results", self), x, y, ax, backend, style)
