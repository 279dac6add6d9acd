"""The values of a block: its states, its mode, its parameters."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from saltus import _core
from saltus._declarations import RequiresInputs, callback_of, initial_of, inputs_of, places_of
from saltus._porting import refusing
from saltus._quantities import Declared, mode_names, mode_of, units_of
from saltus.errors import ModelError
from saltus.leaf_system.derivatives import columns_of
from saltus.parameter import Parameter, given

__all__ = ["DeclaresValues"]


def names_of(what: str, names: Any) -> list[str]:
    """The names of a state; ModelError unless they are texts."""
    if isinstance(names, str) or any(not isinstance(name, str) for name in names):
        raise ModelError(f'{what}: names: expected ["height", "velocity"], found {names!r}')
    return list(names)


class DeclaresValues(_core.LeafSystem):
    """Declares the values that a context holds for a block."""

    __slots__ = ()

    _declared_quantities: Declared

    @refusing
    def declare_continuous_state(
        self,
        shape: int | tuple[int, ...] | ArrayLike | None = None,
        default_value: ArrayLike | None = None,
        ode: Callable[..., ArrayLike] | None = None,
        requires_inputs: RequiresInputs = True,
        jacobian: Callable[..., ArrayLike] | None = None,
        jacobian_sparsity: Any = None,
        sparse_jacobian: Callable[..., ArrayLike] | None = None,
        formula: bool = False,
        names: Sequence[str] = (),
        units: Sequence[str] = (),
        derivatives: Callable[..., Mapping[str, ArrayLike]] | None = None,
    ) -> None:
        """Declares the continuous state x, with dx/dt = ode(time, state, *inputs, **parameters), in
        units of x per second.

        `shape` n is a vector of n zeros, () a single number; `default_value` (or an array in place
        of the shape) is the value at the start. Without `ode` it is constant between resets.
        `jacobian` gives the n by n matrix d(ode)/dx, row by row, for a stiff method; without it,
        and for entries that are not finite, differences are used. A block declares it once.

        `jacobian_sparsity` names the entries of d(ode)/dx that may differ from zero, in every mode:
        an n by n array or a scipy.sparse matrix that is not zero there, or a pair (rows, columns)
        with each entry once; a stiff method then needs neither memory nor calls for the others.
        Name too many rather than too few. `sparse_jacobian` gives the values of these entries, in
        their order (for a matrix the order of its `nonzero()`).

        `names` names the entries, ``names=["height", "velocity"]``: each is an output of the block,
        which costs nothing, and a value of the context: ``results["height"]``, the columns of
        tables, ``sweep(ball, {"height": [5.0, 10.0]}, ...)``, ``--set height=5``. A run of the block
        alone records these outputs by default. `units`, ``units=["m", "m/s"]``, are in the labels of
        plots and in `Results.units`; nothing is converted or checked. A plain number has the unit "".

        `formula` has the meaning that it has in `declare_output_port`.

        `derivatives`, called like the ode, gives the derivatives of the ode by all that it reads,
        so that `sensitivity` and `linearize` take no differences of an ode that is called. It is a
        dict of arrays of n rows: by 'continuous_state', 'discrete_state', 'time' [1/s], each
        parameter and each input, by its name, with a column for each entry. Those that are missing
        are zero. An ode that is traced has exact derivatives by itself.
        """
        what = f"block '{self.name}': continuous state"
        initial = initial_of(what, shape, default_value)
        places = None if jacobian_sparsity is None else places_of(what, jacobian_sparsity)
        if sparse_jacobian is not None and places is None:
            raise ModelError(f"{what}: sparse_jacobian without jacobian_sparsity; give both")
        labels, checked = names_of(what, names), units_of(what, units, np.size(initial))
        super().declare_continuous_state(
            initial,
            callback_of(ode),
            inputs_of(requires_inputs),
            callback_of(jacobian),
            places,
            callback_of(sparse_jacobian),
            bool(formula),
            labels,
            columns_of(
                derivatives,
                self,
                inputs_of(requires_inputs),
                np.size(initial),
                "derivatives of ode",
            ),
        )
        self._declared_quantities.units = checked
        self._declared_quantities.states = tuple(self.output_names.index(name) for name in labels)

    @refusing
    def declare_discrete_state(
        self,
        default_value: ArrayLike | None = None,
        shape: int | tuple[int, ...] | None = None,
    ) -> None:
        """Declares the discrete state z, numbers that only resets and updates change. A block
        declares it once.
        """
        super().declare_discrete_state(
            initial_of(f"block '{self.name}': discrete state", shape, default_value)
        )

    @refusing
    def declare_default_mode(self, mode: int | str, names: Sequence[str] = ()) -> None:
        """Declares the mode in which the block starts: an integer that selects among its zero
        crossings, see `start_mode` there.

        `names` names the modes 0, 1, ...: ``declare_default_mode("off", names=["off", "on"])``. Then
        `start_mode` and `end_mode` may be names, and pictures show them. `state.mode` is the number.
        A later call without `names`, for example in a subclass, keeps the names.
        """
        what = f"block '{self.name}': default mode"
        labels = mode_names(what, names) or self._declared_quantities.modes
        super().declare_default_mode(mode_of(what, mode, labels))
        self._declared_quantities.modes = labels

    @refusing
    def declare_dynamic_parameter(self, name: str, default_value: ArrayLike | Parameter) -> None:
        """Declares a parameter: a number or an array that is a value of the context,
        `context.with_parameter(name, value)`, and that every callback gets by keyword. A
        `Parameter`, or an expression of such, gives the number; see there.
        """
        expression = given(default_value)
        value = default_value if expression is None else expression.value
        super().declare_dynamic_parameter(name, value)
        if expression is not None:
            from saltus.parameters.noted import note

            note(self, {name: expression})
