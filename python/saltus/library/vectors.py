"""Blocks that put vectors together, cut them apart, and reduce them to a number."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from saltus import _core
from saltus._whole import is_whole
from saltus.errors import ModelError
from saltus.library.block import Block

__all__ = [
    "CrossProduct",
    "Demultiplexer",
    "DotProduct",
    "Multiplexer",
    "ProductOfElements",
    "ScalarBroadcast",
    "Slice",
    "SumOfElements",
]


def _entries(block: str, given: object) -> int | list[int] | slice:
    """The chosen entries; ModelError if the choice is not clear."""
    found = _read(given) if isinstance(given, str) else given
    if isinstance(found, slice):
        parts = (found.start, found.stop, found.step)
        if all(part is None or is_whole(part) for part in parts):
            return found
    elif is_whole(found):
        return int(found)
    elif isinstance(found, (list, tuple, np.ndarray)) and all(is_whole(each) for each in found):
        return [int(each) for each in found]
    raise ModelError(
        f"block '{block}': expected a whole number, a list of them or a slice such as '1:3', found "
        f"{given!r}"
    )


def _read(words: str) -> object:
    """The slice, number or list of a text such as "1:3", "2" or "[0, 2]"; any other text is
    returned as it is.
    """
    bare = words.strip().removeprefix("[").removesuffix("]")
    listed = bare != words.strip()
    try:
        if ":" in bare:
            return slice(*(int(part) if part.strip() else None for part in bare.split(":")))
        numbers = [int(part) for part in bare.split(",")]
    except (TypeError, ValueError):
        return words
    return numbers if listed or len(numbers) > 1 else numbers[0]


class Multiplexer(Block, _core.Multiplexer):
    """y = (u_0, u_1, ...): the inputs, one after the other, as one vector.

    Parameters
    ----------
    n_inputs
        How many inputs there are, 1 or more; each may be a number, a vector or a
        matrix, whose entries come row by row.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Examples
    --------
    >>> from saltus.library import Multiplexer
    >>> saltus.response(Multiplexer(2), 1.0, [2.0, 3.0])
    array([1., 2., 3.])
    """

    def __init__(self, n_inputs: int, *, name: str | None = None):
        super().__init__(self._named(name), n_inputs)


class Demultiplexer(Block, _core.Demultiplexer):
    """y_k = part k of u, which is cut into equal parts.

    Parameters
    ----------
    n_outputs
        How many parts there are, 1 or more; the width of u must be a multiple.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        When the diagram is used, if u cannot be cut so.

    Examples
    --------
    >>> from saltus.library import Demultiplexer
    >>> saltus.response(Demultiplexer(2), [1.0, 2.0, 3.0, 4.0])
    (array([1., 2.]), array([3., 4.]))
    """

    def __init__(self, n_outputs: int, *, name: str | None = None):
        super().__init__(self._named(name), n_outputs)


class CrossProduct(Block, _core.CrossProduct):
    """y = u_0 x u_1, of two vectors in space.

    Parameters
    ----------
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        When the diagram is built, if an input is no vector of 3.

    Examples
    --------
    >>> from saltus.library import CrossProduct
    >>> saltus.response(CrossProduct(), [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])
    array([0., 0., 1.])
    """

    def __init__(self, *, name: str | None = None):
        super().__init__(self._named(name))


class DotProduct(Block, _core.DotProduct):
    """y = u_0 . u_1, of two vectors of one width.

    Parameters
    ----------
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        When the diagram is used, if the widths differ.

    Examples
    --------
    >>> from saltus.library import DotProduct
    >>> saltus.response(DotProduct(), [1.0, 2.0, 3.0], [-4.0, 5.0, 6.0])
    24.0
    """

    def __init__(self, *, name: str | None = None):
        super().__init__(self._named(name))


class ProductOfElements(Block, _core.ProductOfElements):
    """y = u[0] u[1] ...: the product of the entries.

    Parameters
    ----------
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Examples
    --------
    >>> from saltus.library import ProductOfElements
    >>> saltus.response(ProductOfElements(), [2.0, 3.0, -4.0])
    -24.0
    """

    def __init__(self, *, name: str | None = None):
        super().__init__(self._named(name))


class ScalarBroadcast(Block, _core.ScalarBroadcast):
    """y = (u, u, ..., u): a number as a vector of equal entries.

    Parameters
    ----------
    n
        How many entries y has, 1 or more.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If `n` is less than one.

    Examples
    --------
    >>> from saltus.library import ScalarBroadcast
    >>> saltus.response(ScalarBroadcast(3), 7.0)
    array([7., 7., 7.])
    """

    def __init__(self, n: int, *, name: str | None = None):
        super().__init__(self._named(name), n)


class Slice(Block, _core.Slice):
    """y = u[entries]: the chosen entries of a vector.

    Parameters
    ----------
    entries
        The index, as within the brackets of an array: a whole number, which makes y a number, a
        list of whole numbers, a `slice`, or text such as "1:3" or "[0, 2]". Negative numbers count
        from the end.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If the entries are of another kind; and when the diagram is used, if u has no such entry.

    Examples
    --------
    >>> from saltus.library import Slice
    >>> saltus.response(Slice("1:3"), [10.0, 11.0, 12.0])
    array([11., 12.])
    >>> saltus.response(Slice(-1), [10.0, 11.0, 12.0])
    12.0
    """

    def __init__(self, entries: int | Sequence[int] | slice | str, *, name: str | None = None):
        name = self._named(name)
        chosen = _entries(name, entries)
        if isinstance(chosen, slice):
            step = 1 if chosen.step is None else chosen.step
            super().__init__(name, chosen.start, chosen.stop, step)
        else:
            super().__init__(name, chosen)


class SumOfElements(Block, _core.SumOfElements):
    """y = u[0] + u[1] + ...: the sum of the entries.

    Parameters
    ----------
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Examples
    --------
    >>> from saltus.library import SumOfElements
    >>> saltus.response(SumOfElements(), [1.0, 2.0, 4.0])
    7.0
    """

    def __init__(self, *, name: str | None = None):
        super().__init__(self._named(name))
