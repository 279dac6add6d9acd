"""`Forms`: results as tables of other libraries, and as files."""

from __future__ import annotations

from dataclasses import asdict
from os import PathLike
from typing import TYPE_CHECKING, Any, cast

from saltus.results.record import KeptRun, Record
from saltus.results.saving import save
from saltus.results.tables import to_pandas, to_xarray, write_csv

if TYPE_CHECKING:
    import pandas  # type: ignore[import-untyped,import-not-found,unused-ignore]
    import xarray  # type: ignore[import-not-found,unused-ignore]

    from saltus.results.outcome import Results

__all__ = ["Forms"]


class Forms:
    """The part of `Results` that gives tables and files.

    Examples
    --------
    >>> import saltus
    >>> len(saltus.scene("bouncing-ball").simulate().to_pandas().columns)
    2
    """

    _core: Record

    @property
    def _whole(self) -> Results:
        return cast("Results", self)

    def to_pandas(self) -> pandas.DataFrame:
        """A row for each (time, jump), a column for each number: 'y', or 'y[0]', 'y[1]', ... for a
        vector. Needs pandas.

        Returns
        -------
        pandas.DataFrame
            Its index is unique: (time, jump).

        Examples
        --------
        >>> import saltus
        >>> solution = saltus.solve(lambda t, x: -x, (0, 1), [1.0], t_eval=[0, 0.5, 1])
        >>> solution.to_pandas().shape
        (3, 1)
        """
        return to_pandas(self._whole)

    def to_csv(self, path: str | PathLike[str]) -> None:
        """Writes the rows as text, with a line for each row: time, jump, then the signals.

        Numbers have all their digits, so that reading them gives the same bits.

        Parameters
        ----------
        path : str or path
            The file, which is written over.

        Raises
        ------
        ModelError
            If two columns would have one name, such as a signal called 'time'.

        Examples
        --------
        >>> import os, tempfile, saltus
        >>> path = os.path.join(tempfile.mkdtemp(), "decay.csv")
        >>> saltus.solve(lambda t, x: -x, (0, 1), [1.0], t_eval=[0, 1]).to_csv(path)
        >>> with open(path) as file:
        ...     print(file.readline().strip())
        time,jump,x[0]
        """
        write_csv(self._whole, path)

    def to_xarray(self) -> xarray.Dataset:
        """A variable for each signal over 'time', with 'jump' beside it; vectors have a second
        dimension of their own, called after them. Needs xarray.

        Returns
        -------
        xarray.Dataset
            The dataset, with the status among its attributes.

        Examples
        --------
        >>> import saltus
        >>> solution = saltus.solve(lambda t, x: -x, (0, 1), [1.0], t_eval=[0, 0.5, 1])
        >>> dict(solution.to_xarray().sizes)
        {'time': 3, 'x_entry': 1}
        """
        return to_xarray(self._whole)

    def save(self, path: str | PathLike[str]) -> None:
        """Writes everything but the dense output to a file that `saltus.load_results` reads.

        Parameters
        ----------
        path : str or path
            The file, which is replaced if it is there; '.npz' suits it. The format is NumPy's own,
            and `numpy.load` opens it too.

        Raises
        ------
        ModelError
            If the suffix is of another format, such as '.csv'; the message says how to write that.

        Examples
        --------
        >>> import os, tempfile, saltus
        >>> path = os.path.join(tempfile.mkdtemp(), "ball.npz")
        >>> saltus.scene("bouncing-ball").simulate().save(path)
        >>> saltus.load_results(path).status
        'reached_end'
        """
        save(KeptRun.of(self._core), path, self._kind())

    def _kind(self) -> dict[str, Any]:
        """The entries of the file's header that say which class of results it holds, and what its
        signals show.
        """
        known = self._whole._quantities
        return {"kind": "Results", "quantities": {name: asdict(one) for name, one in known.items()}}
