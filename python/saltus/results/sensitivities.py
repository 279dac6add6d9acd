"""`Sensitivities`: the derivatives of a run by parameters and start values."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from saltus._core import known_names
from saltus._entries import dimension_names
from saltus.errors import ModelError
from saltus.results.record import NOT_KEPT, same
from saltus.results.tables import extra
from saltus.results.values import Values, values_at

if TYPE_CHECKING:
    import xarray  # type: ignore[import-not-found,unused-ignore]

    from saltus.results.record import Record

__all__ = ["Gap", "Sensitivities"]


class Gap(NamedTuple):
    """An instant from which on a derivative does not exist, or at which it does not.

    A run that ends at an event that moves, or a single row there, has one-sided derivatives only.

    Examples
    --------
    >>> from saltus.results import Gap
    >>> Gap(1.0, "ball.bounce", "e", "the guard only grazes zero").event
    'ball.bounce'
    """

    time: float
    """[s]"""
    event: str
    """path of the event, 'ball.bounce'"""
    parameter: str
    """with respect to which there is no derivative"""
    reason: str


class _Dense:
    """The run from which values between the rows are read. All are equal, a copy is the same one,
    and a pickle knows no run.
    """

    def __init__(self, record: Record | None = None, asks: Any = None):
        self._record = record
        self._asks = asks  # the system whose outputs are called

    def at(self, t: ArrayLike, side: str) -> Values:
        if self._record is None:
            raise ModelError(NOT_KEPT)
        if self._record.dense and self._asks is None:
            raise ModelError("these results do not know their system, so no output can be computed")
        return values_at(self._record, t, side, derivatives=True)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Dense)

    __hash__ = None  # type: ignore[assignment]

    def __deepcopy__(self, memo: dict[int, Any]) -> _Dense:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        return _Dense, ()


class Sensitivities(Mapping[str, np.ndarray]):
    """The derivatives of the recorded signals, by the names of the signals, and of the final state.

    Those of a scalar signal have the axes (row, parameter), those of a vector (row, entry,
    parameter), of a matrix (row, row of the matrix, column, parameter), with the rows of the
    results. They are derivatives at a fixed time: at an event the row before it and the row after
    it differ by the jump that the moving event makes. After a gap they are nan. Between the rows
    they are called at a time, as the results are.

    Examples
    --------
    >>> import saltus
    >>> results = saltus.scene("bouncing-ball").simulate(sensitivity=["e", "x[0]"])
    >>> results.sensitivities["x"].shape == (*results["x"].shape, 2)
    True
    """

    def __init__(self, record: Record, asks: Any = None):
        found = record.sensitivities
        if found is None:
            raise ModelError(
                "this run has no derivatives; ask for them with sensitivity=['e', ...]"
            )
        self._outputs: dict[str, np.ndarray] = found["outputs"]
        self._dense = _Dense(record, asks)
        self._time, self._jump = record.time, record.jump
        self.parameters: tuple[str, ...] = tuple(found["parameters"])
        """the names of the last axis; a vector has a name for each entry"""
        self.continuous_state: np.ndarray = found["continuous_state"]
        """at the end: (state, parameter), in the order of the context"""
        self.discrete_state: np.ndarray = found["discrete_state"]
        self.gaps: tuple[Gap, ...] = tuple(Gap(*gap) for gap in found["gaps"])

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Sensitivities) and same(vars(self), vars(other))

    __hash__ = None  # type: ignore[assignment]

    def __getitem__(self, name: str) -> np.ndarray:
        try:
            return self._outputs[name]
        except KeyError:
            raise ModelError(
                f"nothing was recorded under {name!r}{known_names(str(name), list(self))}"
            ) from None

    def __contains__(self, name: object) -> bool:
        return name in self._outputs

    def __iter__(self) -> Iterator[str]:
        return iter(self._outputs)

    def __len__(self) -> int:
        return len(self._outputs)

    def __call__(self, t: ArrayLike, side: str = "right") -> Values:
        """The derivatives of every recorded signal, and of the continuous state, at any time.

        Needs the option ``dense_output=True`` of the run. With x(t) = ``results(t)`` they are
        dx(t)/dp at a fixed t: the polynomials by which the equation of the derivatives was solved
        (docs/derivatives.md). At a recorded row they are those of the row.

        Parameters
        ----------
        t : float or array of float
            [s] within the run.
        side : {'right', 'left'}
            At the time of an event the derivatives after it, or those before it.

        Returns
        -------
        Values
            By the names of the signals, shaped like `t`, then like the signal; the last axis
            counts `parameters`. `continuous_state` has the axes of `t`, the state, the parameter.
            After a gap they are nan.

        Raises
        ------
        ModelError
            For a time outside the run, and for a run without dense output.

        Examples
        --------
        >>> import saltus
        >>> ball = saltus.scene("bouncing-ball")
        >>> results = ball.simulate(sensitivity=["x[0]"], dense_output=True)
        >>> results.sensitivities(0.5).continuous_state.round(9).tolist()
        [[1.0], [0.0]]
        """
        return self._dense.at(t, side)

    def to_xarray(self) -> xarray.Dataset:
        """A variable for each signal over 'time' and 'parameter'. Needs xarray.

        Examples
        --------
        >>> import saltus
        >>> results = saltus.scene("bouncing-ball").simulate(sensitivity=["e"])
        >>> results.sensitivities.to_xarray()["x"].dims
        ('time', 'x_entry', 'parameter')
        """
        library: Any = extra("xarray", "to_xarray")
        variables: dict[str, Any] = {}
        for name, values in self._outputs.items():
            axes = dimension_names(name, values.ndim - 2)
            variables[name] = (("time", *axes, "parameter"), values)
        dataset: xarray.Dataset = library.Dataset(
            variables,
            coords={
                "time": self._time,
                "jump": ("time", self._jump),
                "parameter": list(self.parameters),
            },
        )
        return dataset

    def __repr__(self) -> str:
        lines = [f"  {name}: {values.shape}" for name, values in self._outputs.items()]
        lines += [f"  ends at t = {g.time} s for {g.parameter}: {g.reason}" for g in self.gaps]
        return "\n".join([f"derivatives by {', '.join(self.parameters)}", *lines])
