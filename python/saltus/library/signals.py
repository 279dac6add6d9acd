"""Sources of signals: chirps, teeth, tables of data. Their output is called 'out'."""

from __future__ import annotations

from collections.abc import Sequence
from os import PathLike

import numpy as np
from numpy.typing import ArrayLike

from saltus import _core
from saltus.errors import ModelError
from saltus.library.block import Block

__all__ = ["Chirp", "DataSource", "Sawtooth"]


class Chirp(Block, _core.Chirp):
    """y = cos(phi + f0 t + (f1 - f0) t^2 / (2 stop_time)): the frequency grows from f0 at t = 0 to
    f1 at stop_time, evenly, and remains there afterwards.

    Parameters
    ----------
    f0, f1
        [rad/s] Numbers, vectors or matrices. Parameters of the context.
    stop_time
        [s] > 0, an exact event.
    phi
        [rad] The phase at t = 0. Parameter of the context.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If stop_time is not above 0.

    Examples
    --------
    >>> from saltus.library import Chirp
    >>> saltus.response(Chirp(f0=0.0, f1=2 * np.pi, stop_time=1.0), t=[0.0, 1.0, 2.0]).round(12)
    array([ 1., -1., -1.])
    """

    def __init__(
        self,
        f0: ArrayLike = 1.0,
        f1: ArrayLike = 10.0,
        stop_time: float = 10.0,
        phi: ArrayLike = 0.0,
        *,
        name: str | None = None,
    ):
        super().__init__(self._named(name), f0, f1, stop_time, phi)


class DataSource(Block, _core.DataSource):
    """y = the values of a table over the time. `DataSource.from_csv` reads it from a file.

    Each time of the table is an exact event, so no step of a solver spans one.

    Parameters
    ----------
    times
        [s] They increase.
    values
        A number for each time, for a scalar signal; or a row for each time, for a vector. The
        parameter `values` of the context, row by row.
    interpolation
        'linear', or 'zero_order_hold': the value of the time before, held.
    extrapolation
        Before the first time, and from the last one on: 'hold', the outer value, or 'zero'.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If the times do not increase, or there is not a value for each time.

    Examples
    --------
    >>> from saltus.library import DataSource
    >>> block = DataSource([0.0, 1.0, 3.0], [0.0, 4.0, 0.0])
    >>> saltus.response(block, t=[0.5, 1.0, 2.0, 9.0])
    array([2., 4., 2., 0.])
    """

    def __init__(
        self,
        times: ArrayLike,
        values: ArrayLike,
        interpolation: str = "linear",
        extrapolation: str = "hold",
        *,
        name: str | None = None,
    ):
        super().__init__(self._named(name), times, values, interpolation, extrapolation)

    @classmethod
    def from_csv(
        cls,
        path: str | PathLike[str],
        *,
        time_column: int = 0,
        data_columns: int | Sequence[int] = 1,
        header_lines: int = 1,
        delimiter: str = ",",
        interpolation: str = "linear",
        extrapolation: str = "hold",
        name: str | None = None,
    ) -> DataSource:
        """A table from a file of numbers with a delimiter.

        Parameters
        ----------
        path
            The file.
        time_column, data_columns
            Counted from 0. One number of a data column makes a scalar signal, a list a vector.
        header_lines
            How many lines to skip.
        delimiter
            The text between two numbers.
        interpolation, extrapolation, name
            As for the block.

        Returns
        -------
        DataSource
            The block; its values are copied.

        Raises
        ------
        OSError
            If the file cannot be read.
        ModelError
            If it has no such columns, or something else than numbers in them.
        """
        columns = [data_columns] if isinstance(data_columns, int) else list(data_columns)
        try:
            table = np.loadtxt(
                path,
                delimiter=delimiter,
                skiprows=header_lines,
                usecols=[time_column, *columns],
                ndmin=2,
            )
        except (ValueError, IndexError) as error:
            raise ModelError(f"DataSource: {path}: {error}; expected numbers") from None
        values = table[:, 1] if isinstance(data_columns, int) else table[:, 1:]
        return cls(table[:, 0], values, interpolation, extrapolation, name=name)


class Sawtooth(Block, _core.Sawtooth):
    """y = amplitude (t - t_k) / period in the period that begins at t_k = phase_delay + k period.

    Before phase_delay y is 0. At the end of a period it jumps from amplitude to 0; the jumps are
    exact events, counted by integers.

    Parameters
    ----------
    amplitude
        A number or a vector. Parameter of the context.
    frequency
        [1/s] > 0. The period is 1 / frequency.
    phase_delay
        [s] Where the first tooth begins.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If the frequency is not above 0.

    Examples
    --------
    >>> from saltus.library import Sawtooth
    >>> saltus.response(Sawtooth(2.0, frequency=0.5), t=[0.0, 1.0, 1.5, 2.0, 3.0])
    array([0. , 1. , 1.5, 0. , 1. ])
    """

    def __init__(
        self,
        amplitude: ArrayLike = 1.0,
        frequency: float = 1.0,
        phase_delay: float = 0.0,
        *,
        name: str | None = None,
    ):
        super().__init__(self._named(name), amplitude, frequency, phase_delay)
