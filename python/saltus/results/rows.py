"""`Rows`: the recorded rows of a run, their times and their signals."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from saltus import _core
from saltus.errors import ModelError
from saltus.results.record import Record

if TYPE_CHECKING:
    from saltus.results.islands import Island

__all__ = ["Rows"]


class _Outputs(dict[str, np.ndarray]):
    """Recorded signals by name; an unknown name is answered with the known names."""

    def __missing__(self, name: str) -> np.ndarray:
        if not isinstance(name, str):
            raise TypeError(f"expected the name of a recorded signal, found {name!r}")
        known = _core.known_names(name, list(self))
        how = known if len(self) else "; give the run recorded_signals={'name': 'block.port'}"
        raise ModelError(f"nothing was recorded under {name!r}{how}")


class Rows:
    """The part of `Results` that was recorded.

    Examples
    --------
    >>> import saltus
    >>> results = saltus.scene("bouncing-ball").simulate()
    >>> list(results), results["y"][0]
    (['y', 'v'], 10.0)
    """

    _core: Record

    @cached_property
    def time(self) -> np.ndarray:
        """[s] of each row; never decreases. Each event has a row before and a row after it.

        Raises
        ------
        ModelError
            If islands stepped apart and have rows of their own: use `time_of`.
        """
        self._require_common_rows("results.time")
        return self._core.time

    @cached_property
    def jump(self) -> np.ndarray:
        """Distinguishes rows of one time: it increases by one with each pass that changed
        something.

        Raises
        ------
        ModelError
            If islands stepped apart and have rows of their own: use `jump_of`.
        """
        self._require_common_rows("results.jump")
        return self._core.jump

    def time_of(self, name: str) -> np.ndarray:
        """[s] The times of the rows of one recorded signal: those of its island, or `time`.

        Raises
        ------
        ModelError
            If nothing was recorded under that name.

        Examples
        --------
        >>> import saltus
        >>> results = saltus.scene("bouncing-ball").simulate()
        >>> bool((results.time_of("y") == results.time).all())
        True
        """
        from saltus.results.islands import rows_of

        return rows_of(self._core, name)[0]

    def jump_of(self, name: str) -> np.ndarray:
        """`jump` of the rows of one recorded signal: that of its island, or `jump`.

        Examples
        --------
        >>> import saltus
        >>> results = saltus.scene("bouncing-ball").simulate()
        >>> bool((results.jump_of("y") == results.jump).all())
        True
        """
        from saltus.results.islands import rows_of

        return rows_of(self._core, name)[1]

    @cached_property
    def islands(self) -> tuple[Island, ...]:
        """The islands that stepped apart, each with its rows; empty without the option `islands`,
        and for a scene of one island.
        """
        from saltus.results.islands import islands_of

        return islands_of(self._core)

    def _require_common_rows(self, asked: str) -> None:
        if self._core.apart:
            from saltus.results.islands import refuse_common_rows

            refuse_common_rows(self._core, asked)

    @cached_property
    def outputs(self) -> dict[str, np.ndarray]:
        """Recorded signals by name, (rows,) of a scalar, (rows, n) of a vector, (rows, m, n) of a
        matrix.
        """
        return _Outputs(self._core.outputs)

    def __getitem__(self, name: str) -> np.ndarray:
        """A recorded signal, as ``outputs[name]``.

        Examples
        --------
        >>> import saltus
        >>> results = saltus.scene("bouncing-ball").simulate()
        >>> results["x"].shape == results.outputs["x"].shape
        True
        """
        return self.outputs[name]

    def __contains__(self, name: object) -> bool:
        return name in self.outputs

    def __iter__(self) -> Iterator[str]:
        return iter(self.outputs)
