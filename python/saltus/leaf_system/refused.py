"""Declarations of similar tools that are not here, each refused with what to do."""

from __future__ import annotations

from typing import Any, NoReturn

from saltus import _core
from saltus.errors import ModelError

__all__ = ["RefusesDeclarations"]


class RefusesDeclarations(_core.LeafSystem):
    """The declarations of Collimator and Drake that a block has not."""

    __slots__ = ()

    def declare_cache(self, *_: Any, **__: Any) -> NoReturn:
        """Refused: a block keeps no values that callbacks share.

        Call a method of the block from each callback that needs the value: it is traced as a part
        of the callback, and is never out of date. A value that is computed at ticks and held in
        between is an output with a `period`, or a discrete state that an update sets.

        Examples
        --------
        >>> class Tank(saltus.LeafSystem):
        ...     def __init__(self):
        ...         super().__init__(name="tank")
        ...         self.declare_continuous_state([4.0], ode=self.ode)
        ...         self.declare_output_port(self.outflow, name="outflow")
        ...
        ...     def flow(self, state):  # in place of a cache
        ...         return 0.1 * np.sqrt(state.continuous_state[0])
        ...
        ...     def ode(self, time, state):
        ...         return [-self.flow(state)]
        ...
        ...     def outflow(self, time, state):
        ...         return self.flow(state)
        >>> [callback.runs for callback in Tank().explain()]
        ['traced', 'traced']
        >>> Tank().declare_cache(None)
        Traceback (most recent call last):
            ...
        saltus.errors.ModelError: block 'tank': there is no cache; call a method of the block, ...
        """
        raise ModelError(
            f"block '{self.name}': there is no cache; call a method of the block, such as "
            "self.flow(state), from each callback that needs the value: it is traced with them. A "
            "value that is held between ticks is an output: declare_output_port(..., period=...)"
        )

    def declare_static_parameter(self, *_: Any, **__: Any) -> NoReturn:
        """Refused: what is no number of a context is an attribute of the block."""
        raise ModelError(
            f"block '{self.name}': there are no static parameters; set an attribute before the "
            "declarations, self.kind = kind. A sweep varies it by a function that makes the block"
        )

    declare_static_parameters = declare_static_parameter
