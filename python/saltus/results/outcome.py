"""`Results`: the outcome of a run."""

from __future__ import annotations

from collections.abc import Iterator
from copy import deepcopy
from functools import cached_property
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from saltus import _core
from saltus._porting import missing
from saltus.errors import Error, ModelError, SimulationError
from saltus.results.events import EventLog
from saltus.results.pictures import Pictures
from saltus.results.record import KINDS, KeptRun, Record
from saltus.results.saving import save
from saltus.results.sensitivities import Gap, Sensitivities
from saltus.results.statistics import Statistics
from saltus.results.tables import to_pandas, to_xarray, write_csv
from saltus.results.values import Values, values_at

if TYPE_CHECKING:
    import pandas  # type: ignore[import-untyped,import-not-found,unused-ignore]
    import xarray  # type: ignore[import-not-found,unused-ignore]

    from saltus.results.islands import Island

__all__ = ["INSTEAD", "Results"]


SHARED = {"_core", "_engine", "_asks", "_known", "system", "events"}
"""the attributes that a deep copy has in common with its original: nothing changes them"""


class _Outputs(dict[str, np.ndarray]):
    """Recorded signals by name; an unknown name is answered with the known names."""

    def __missing__(self, name: str) -> np.ndarray:
        raise ModelError(
            f"nothing was recorded under {name!r}{_core.known_names(name, list(self))}"
        )


STATE = "a recorded signal is results['name'], and the final state results.context.continuous_state"
INSTEAD = {
    **dict.fromkeys(("t", "ts", "times"), "the times of the rows are results.time"),
    **dict.fromkeys(("x", "xs", "y", "ys", "state", "states", "continuous_state"), STATE),
    **dict.fromkeys(
        ("signals", "recorded_signals", "data"), "recorded signals are results.outputs"
    ),
    **dict.fromkeys(("df", "to_dataframe", "to_df", "dataframe"), "it is results.to_pandas()"),
    **dict.fromkeys(("to_file", "write", "dump"), "results.save(path), or results.to_csv(path)"),
    "keys": "the names of the recorded signals are list(results)",
    "sol": "values at any time are results(t), with the option dense_output=True",
    "success": "a run came to its end if results.status == 'reached_end'",
    "t_events": "the times of an event are results.events.times('name')",
    "y_events": "the states at an event are results.events[0].before and .after",
    "nfev": "it is results.statistics.right_hand_side_calls",
    "njev": "it is results.statistics.jacobian_calls",
    "nlu": "it is results.statistics.linear_setups",
    "final_context": "it is results.context",
    "parameters": "they are those of results.context",
}
"""names of results in SciPy and similar tools -> where it is here"""


class Results(Pictures):
    """The recorded signals, the event log, the final values, and the way the run ended.

    Each part is made once, when it is first read. The arrays of a whole run show its memory without
    a copy, and keep it as long as one of them lives; the arrays of a `Simulator`, whose run may
    continue, are copies.
    Results can be saved (`save`), pickled, and called for values between the rows.

    Examples
    --------
    >>> import saltus
    >>> results = saltus.scene("bouncing-ball").simulate()
    >>> results.status
    'reached_end'
    >>> results.time.shape == results.jump.shape
    True
    """

    cause: BaseException | None = None
    """the exception, if the status is 'failed'"""

    def __init__(self, core: Record, raised: BaseException | None = None, asks: Any = None):
        self._core = core
        self._asks = asks if core.dense else None  # the system whose outputs dense output calls
        if core.status == "failed" and asks is not None:
            self._explain(core, raised, asks)
        if raised is not None and core.status == "failed":
            self.cause = raised
            if not isinstance(raised, Error):  # the message of the run has no more information
                self.message = f"t = {self._ended_at} s: {type(raised).__name__}: {raised}"

    if not TYPE_CHECKING:  # a type checker knows the names that are there

        def __getattr__(self, name: str) -> Any:
            if not name.startswith("_") and name in self._core.outputs:
                return missing(self, name, {name: f"the recorded signal is results[{name!r}]"})
            return missing(self, name, self._elsewhere())

    def _elsewhere(self) -> dict[str, str]:
        """Names that are tried, and where it is here."""
        return INSTEAD

    def _explain(self, core: Record, raised: BaseException | None, system: Any) -> None:
        """Adds what the system knows to the message of the engine."""
        from saltus.results.outside import explained

        message = explained(core.message, core.block, core.context, system)
        if message != core.message:
            self.message = message
            if isinstance(raised, SimulationError):
                raised.args = (message,)

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

    @cached_property
    def events(self) -> EventLog:
        """Every event, in order; a table with `to_pandas()` and `times(name)`."""
        return EventLog(self._core)

    @cached_property
    def sensitivities(self) -> Sensitivities:
        """The derivatives of the run by the parameters of the option `sensitivity`.

        Raises
        ------
        ModelError
            For a run without that option.

        Examples
        --------
        >>> import saltus
        >>> ball = saltus.scene("bouncing-ball")
        >>> results = ball.simulate(sensitivity=["e", "x[0]"])
        >>> results.sensitivities.parameters
        ('e', 'x[0]')
        """
        return Sensitivities(self._core, self._asks)

    @property
    def sensitivity_gaps(self) -> tuple[Gap, ...]:
        """Where derivatives end: the time, the event, the parameter and the reason. Empty if all of
        them exist.
        """
        return self.sensitivities.gaps

    @cached_property
    def context(self) -> _core.Context:
        """The values at the end; a run can continue from them."""
        return self._core.context

    @cached_property
    def status(self) -> str:
        """'reached_end', 'terminal', 'zeno_stop', 'step_limit', 'chattering', 'interrupted' or
        'failed'.
        """
        return self._core.status

    @cached_property
    def message(self) -> str:
        """The reason for any status but the first three."""
        return self._core.message

    @cached_property
    def block(self) -> str:
        """Path of the block at fault, if a single block is."""
        return self._core.block

    @cached_property
    def statistics(self) -> Statistics:
        """The numbers of steps and calls."""
        return Statistics(**self._core.statistics)

    @property
    def stats(self) -> Statistics:
        """The same as `statistics`."""
        return self.statistics

    @property
    def _ended_at(self) -> float:
        """[s] The time of the end, also where nothing was recorded."""
        return self.context.time

    @property
    def dense(self) -> bool:
        """Whether values between the rows were kept: the option `dense_output`."""
        return self._core.dense

    @property
    def span(self) -> tuple[float, float]:
        """[s] The span in which `results(t)` answers; nan without dense output."""
        return self._core.span if self.dense else (np.nan, np.nan)

    def __call__(self, t: ArrayLike, side: str = "right") -> Values:
        """Every recorded signal, and the continuous state, at any time of the run.

        Needs the option ``dense_output=True``. Between the steps the state is the solver's own
        interpolant, so the order of the method is kept: 4 for dopri5, 7 for dop853, the order of
        the step for adams and bdf. Signals are computed from that state by the blocks themselves,
        as for a recorded row.

        Parameters
        ----------
        t : float or array of float
            [s] within the run.
        side : {'right', 'left'}
            At the time of an event the value after it, or the value before it.

        Returns
        -------
        Values
            The signals by name, shaped like `t`, and `continuous_state`.

        Raises
        ------
        ModelError
            For a time outside the run (nothing is extrapolated), and for a run without dense
            output.

        Examples
        --------
        >>> import saltus
        >>> ball = saltus.scene("bouncing-ball")
        >>> results = ball.simulate(dense_output=True)
        >>> bounce = results.events[0].time
        >>> before, after = results(bounce, side="left"), results(bounce)
        >>> bool(before.continuous_state[1] < 0 < after.continuous_state[1])
        True
        """
        if self.dense and self._asks is None:  # its outputs would be called
            raise ModelError("these results do not know their system, so no output can be computed")
        return values_at(self._core, t, side)

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
        return to_pandas(self)

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
        write_csv(self, path)

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
        return to_xarray(self)

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
        """The entries of the file's header that say which class of results it holds."""
        return {"kind": "Results"}

    def __copy__(self) -> Results:
        made = object.__new__(type(self))
        made.__dict__.update(self.__dict__)
        return made

    def __deepcopy__(self, memo: dict[int, Any]) -> Results:
        made = self.__copy__()
        memo[id(self)] = made
        for name in ("outputs",) if self._core.apart else ("outputs", "time", "jump"):
            getattr(made, name)  # the memory of the run, which is copied below
        for name, value in vars(made).items():
            # An exception that the user wrote may refuse to be copied, so it is shared. An exception
            # of Saltus is copied, because it refers to the results.
            if name not in SHARED and (name != "cause" or isinstance(value, Error)):
                made.__dict__[name] = deepcopy(value, memo)
        return made

    def __reduce__(self) -> tuple[Any, ...]:
        return Results, (KeptRun.of(self._core),), self._failure()

    def _failure(self) -> dict[str, Any]:
        """The state of a pickle: its cause may refer back to these results."""
        return {"cause": self.cause, "message": self.message}

    def __repr__(self) -> str:
        from saltus.results.text import as_text

        return as_text(self)

    def _repr_html_(self) -> str:
        from saltus.results.text import as_html

        return as_html(self)


KINDS["Results"] = lambda run, header: Results(run)
