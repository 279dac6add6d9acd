"""The outputs of one block, without a diagram written by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from saltus.diagram import DiagramBuilder
from saltus.errors import ModelError
from saltus.library.sources import Constant
from saltus.simulation.simulate import simulate
from saltus.system import System

__all__ = ["response"]


def response(
    system: System, *inputs: System | ArrayLike, t: ArrayLike = 0.0, **options: Any
) -> Any:
    """The outputs of a block, or of a diagram, at chosen times.

    It makes a diagram of the system and its sources, runs it from 0 to the last time and reads the
    outputs, after the events at each time. It is meant for trying a block; for a model make the
    diagram yourself.

    Parameters
    ----------
    system
        A block or a diagram. It is not changed, and may be used elsewhere.
    inputs
        A value for each input, in order: a number, a vector or a matrix, which stays constant, or a
        source, a system whose first output feeds the input. A source may be given more than once.
    t
        [s] A time, or several.
    options
        Options of `simulate`, such as `rtol`.

    Returns
    -------
    float, numpy.ndarray or a tuple of them
        The output; of several outputs a tuple. A number at one time is a float. If there are
        several times, they are the first dimension.

    Raises
    ------
    ModelError
        If the system has no outputs, or another number of inputs than was given.

    Examples
    --------
    >>> from saltus.library import Adder, Clock, Demultiplexer, Gain
    >>> saltus.response(Gain(-2.0), [1.0, 3.0])
    array([-2., -6.])
    >>> saltus.response(Adder("+-"), Clock(), 10.0, t=[1.0, 2.5])
    array([-9. , -7.5])
    >>> saltus.response(Demultiplexer(2), [1.0, 2.0])
    (1.0, 2.0)
    """
    times = np.asarray(t, dtype=float)
    if not system.output_names:
        raise ModelError(f"response: '{system.name}' has no output to read")
    if len(inputs) != len(system.input_names):
        raise ModelError(
            f"response: '{system.name}' has {len(system.input_names)} inputs "
            f"({', '.join(system.input_names)}), found {len(inputs)}"
        )
    builder = DiagramBuilder()
    builder.add(system)
    sources: dict[int, System] = {}
    for k, given in enumerate(inputs):
        source = given if isinstance(given, System) else Constant(given, name=f"input {k}")
        if id(source) not in sources:
            sources[id(source)] = source
            builder.add(source)
        builder.connect(source.output(), system.input(k))
    diagram = builder.build()
    asked = np.unique(times)
    span = (min(0.0, float(asked[0])), float(asked[-1]))
    recorded = {name: system.output(k) for k, name in enumerate(system.output_names)}
    results = simulate(
        diagram,
        diagram.create_context(),
        span,
        recorded_signals=recorded,
        save_at=asked,
        save_steps=False,
        **options,
    )
    rows = np.searchsorted(results.time, times, side="right") - 1
    found = [np.asarray(results.outputs[name][rows]) for name in recorded]
    values = tuple(array if array.ndim else float(array) for array in found)
    return values[0] if len(values) == 1 else values
