"""`System`: the base of blocks and diagrams, with its name and its contexts."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike

from saltus import _core, callbacks
from saltus.callbacks import Explanation
from saltus.errors import ModelError
from saltus.system.drawn import Drawn
from saltus.system.living import remember
from saltus.system.named_ports import NamedPorts

__all__ = ["System"]


class System(NamedPorts, Drawn):
    """A block or a diagram: structure, which a run never changes. The values are in a `Context`.

    Examples
    --------
    >>> from saltus.library import Adder
    >>> total = Adder("+-", name="total")
    >>> total.name, total.input_names, total.output_names
    ('total', ['in_0', 'in_1'], ['out'])
    >>> total.input_ports[1]
    <input 'in_1' of 'total'>
    >>> total.output_ports[0] == total.output()
    True
    """

    name: str
    """the name in messages and for `diagram[...]`"""
    system_id: int
    """the number for `context[...]`"""
    interpreted_blocks: list[str]
    """the paths of the blocks in it whose Python functions a run calls"""

    def context_from_json(self, text: str) -> _core.Context:
        """The context that `context.to_json()` wrote, of this system or one of the same blocks.

        It has the same bits, and a run goes on from it as from the context in memory.

        Parameters
        ----------
        text
            The text from `Context.to_json`.

        Raises
        ------
        ModelError
            If the text is no context, or belongs to a system with other blocks.

        Examples
        --------
        >>> from saltus.library import Integrator
        >>> x = Integrator(2.0)
        >>> text = x.create_context(time=1.5).to_json()
        >>> x.context_from_json(text)
        Context(time=1.5, continuous_state=[2], mode=0)
        """
        import json  # which few scripts need

        try:
            data = json.loads(text)
        except (ValueError, TypeError, RecursionError) as error:
            raise ModelError(f"a context in JSON: {error}") from None
        if not isinstance(data, dict):
            raise ModelError(f"a context in JSON: expected an object, found {type(data).__name__}")
        remember(self)
        return _core.context_from_dict(self, data)

    def explain(self) -> Explanation:
        """How each Python callback runs: 'compiled', 'traced' or 'called', and why not faster.

        Nothing is simulated. The functions are traced as they are before a run; outputs without a
        given shape are called once.

        Returns
        -------
        Explanation
            A tuple of `ExplainedCallback(block, callback, runs, reason)`; printed, a line for each.

        Examples
        --------
        >>> import saltus
        >>> block = saltus.library.FunctionBlock(lambda u: 2.0 * u, name="twice")
        >>> print(block.explain())
        twice: output 'out'  traced
        the system has open inputs; each is taken for a single number here
        """
        return callbacks.explain(self)

    def create_context(
        self, time: float = 0.0, values: Mapping[str, ArrayLike] | None = None
    ) -> _core.Context:
        """The values every block starts with. A change of a context changes no system.

        Parameters
        ----------
        time
            [s]
        values
            Other start values, parameters and modes, by the names that a sweep has for them:
            ``{"ball.height": 5.0, "ball.e": 0.9}``, ``"x[0]"`` for an entry of a state without a
            name, ``"x"`` for all of them, ``"room.mode"``.

        Raises
        ------
        ModelError
            For a name that is not there, with the nearest one; for values that are no finite
            numbers, or of another number than the state or the parameter has.

        Examples
        --------
        >>> from saltus.library import Integrator
        >>> Integrator([1.0, 2.0]).create_context()
        Context(time=0, continuous_state=[1, 2], mode=0)
        >>> Integrator([1.0, 2.0]).create_context(values={"x[1]": 5.0})
        Context(time=0, continuous_state=[1, 5], mode=0)
        """
        remember(self)
        if isinstance(time, Mapping):
            raise ModelError(
                "create_context: time: expected a time [s], found a dict; give it as values={...}"
            )
        context = _core.System.create_context(self, time)
        if values is None:
            return context
        from saltus._start_values import with_values

        return with_values(context, values)

    def eval_time_derivatives(self, context: _core.Context) -> np.ndarray:
        """dx/dt of the continuous states of this system at a context, without a run.

        Parameters
        ----------
        context
            The values of this system, or of a diagram around it. No event happens.

        Returns
        -------
        numpy.ndarray
            A number for each continuous state, in the order of `context.continuous_state`.

        Raises
        ------
        ModelError
            If the context is of another system, or an input is open; and wherever a run would.

        Examples
        --------
        >>> from saltus.library import Integrator
        >>> x = Integrator([1.0, 2.0])
        >>> x.input().fix_value([0.5, -1.0])
        >>> x.eval_time_derivatives(x.create_context())
        array([ 0.5, -1. ])
        """
        from saltus import _evaluate

        return _evaluate.rates(self, context)

    def __repr__(self) -> str:
        if not _core.made(self):  # its constructor has raised, and a traceback shows it
            return f"<{type(self).__name__}, which was not made>"
        return f"<{type(self).__name__} '{self.name}'>"
