"""`Results`: the outcome of a run."""

from __future__ import annotations

from collections.abc import Callable
from copy import deepcopy
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from saltus import _core
from saltus._porting import missing
from saltus._quantities import Quantity
from saltus.errors import Error, ModelError, SimulationError
from saltus.results.elsewhere import INSTEAD
from saltus.results.events import EventLog
from saltus.results.forms import Forms
from saltus.results.header import checked_quantities
from saltus.results.pictures import Pictures
from saltus.results.record import KINDS, KeptRun, Record
from saltus.results.rows import Rows
from saltus.results.sensitivities import Gap, Sensitivities
from saltus.results.statistics import Statistics
from saltus.results.values import Values, values_at

__all__ = ["Results"]


SHARED = {"_core", "_engine", "_asks", "_known", "system", "events"}
"""the attributes that a deep copy has in common with its original: nothing changes them"""


class Results(Rows, Pictures, Forms):
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

    def __init__(
        self,
        core: Record,
        raised: BaseException | None = None,
        asks: Any = None,
        quantities: Callable[[], dict[str, Quantity]] = dict,
    ):
        self._core = core
        self._find_quantities = quantities
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

    @cached_property
    def _quantities(self) -> dict[str, Quantity]:
        """What signals show, where their blocks say it."""
        return self._find_quantities()

    @property
    def units(self) -> dict[str, str | tuple[str, ...]]:
        """The unit of each recorded signal that has one, of a vector one for each entry.

        It is what the block says that declares the state, ``declare_continuous_state(...,
        units=["m", "m/s"])``; a signal that is computed has none.

        Examples
        --------
        >>> import saltus
        >>> tank = saltus.LeafSystem(name="tank")
        >>> tank.declare_continuous_state(
        ...     [0.0], ode=lambda t, s: [0.1], names=["level"], units=["m"]
        ... )
        >>> saltus.simulate(tank, (0.0, 2.0)).units
        {'level': 'm'}
        """
        known = {name: one.units for name, one in self._quantities.items() if any(one.units)}
        return {
            name: units if self.outputs[name].ndim > 1 else units[0]
            for name, units in known.items()
        }

    @property
    def mode_names(self) -> dict[str, tuple[str, ...]]:
        """The names of the modes 0, 1, ... of each recorded signal that shows a mode with names."""
        return {name: one.modes for name, one in self._quantities.items() if one.modes}

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
        return {"cause": self.cause, "message": self.message, "_quantities": self._quantities}

    def __repr__(self) -> str:
        from saltus.results.text import as_text

        return as_text(self)

    def _repr_html_(self) -> str:
        from saltus.results.text import as_html

        return as_html(self)


def _loaded(run: KeptRun, header: dict[str, Any]) -> Results:
    results = Results(run)
    results._quantities = checked_quantities(header.get("quantities", {}), run.outputs)
    return results


KINDS["Results"] = _loaded
