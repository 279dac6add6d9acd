"""`EventPictures`: the plots of the events of a run: their times, their accumulation, a section."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

if TYPE_CHECKING:
    from saltus.results.outcome import Results

__all__ = ["EventPictures"]


class EventPictures:
    """The part of `Results` that draws its events.

    Examples
    --------
    >>> import saltus
    >>> saltus.scene("bouncing-ball").simulate().plot_events().get_xlabel()
    'time [s]'
    """

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

        return draw_raster(cast("Results", self), names, ax, backend, style)

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

        return draw_zeno(cast("Results", self), name, signal, ax, backend, style)

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

        return draw_section(cast("Results", self), name, (x, y), side, ax, backend, style)
