"""Blocks that calculate with their inputs, entry by entry. One input is called 'in', several
'in_0', 'in_1', ...; likewise outputs.
"""

from __future__ import annotations

from typing import Any

from numpy.typing import ArrayLike

from saltus import _core
from saltus._whole import is_whole
from saltus.errors import BlockParameterError
from saltus.library.block import Block

__all__ = ["Abs", "Adder", "Gain", "Offset", "Product", "Saturate"]


def _operators(block: str, usual: str, n_in: object, operators: object) -> str:
    """The operators, one for each input; `usual` for each if only their number is given."""
    given = [value for value in (n_in, operators) if value is not None] or [2]
    counts: list[Any] = [len(v) if isinstance(v, str) else v for v in given]
    for count in counts:
        if not is_whole(count) or count < 1:
            raise BlockParameterError(
                f"block '{block}': expected the number of inputs, or an operator for each such as "
                f"'{usual}{usual}', found {count!r}"
            )
    if len(set(counts)) > 1:
        raise BlockParameterError(
            f"block '{block}': {counts[0]} inputs and {counts[1]} operators {given[1]!r}; expected "
            "one operator for each input"
        )
    signs = [v for v in given if isinstance(v, str)]
    if len(set(signs)) > 1:
        raise BlockParameterError(
            f"block '{block}': operators {signs[0]!r} and {signs[1]!r}; say them once"
        )
    return signs[0] if signs else usual * counts[0]


class Gain(Block, _core.Gain):
    """y = gain u, entry by entry.

    Parameters
    ----------
    gain
        A number, or a vector as wide as the input. It is the parameter `gain` of the context.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Examples
    --------
    >>> from saltus.library import Gain
    >>> saltus.response(Gain(-2.0), [1.0, 3.0])
    array([-2., -6.])
    """

    def __init__(self, gain: ArrayLike, *, name: str | None = None):
        super().__init__(self._named(name), gain)


class Offset(Block, _core.Offset):
    """y = u + offset, entry by entry.

    Parameters
    ----------
    offset
        A number, or a vector as wide as the input. It is the parameter `offset` of the context.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Examples
    --------
    >>> from saltus.library import Offset
    >>> saltus.response(Offset(10.0), [1.0, 3.0])
    array([11., 13.])
    """

    def __init__(self, offset: ArrayLike, *, name: str | None = None):
        super().__init__(self._named(name), offset)


class Adder(Block, _core.Adder):
    """y = ±u_0 ±u_1 ..., entry by entry, with one sign for each input.

    Parameters
    ----------
    n_in
        The number of inputs; or the operators, in their place.
    operators
        The signs, one character an input: "+-" is u_0 - u_1. Without them all signs are plus, for
        two inputs if `n_in` is not given either.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If there is another character than + and -, or not one for each of `n_in` inputs.

    Examples
    --------
    >>> from saltus.library import Adder
    >>> saltus.response(Adder("+-"), 5.0, 2.0)
    3.0
    """

    def __init__(
        self,
        n_in: int | str | None = None,
        operators: str | int | None = None,
        *,
        name: str | None = None,
    ):
        name = self._named(name)
        super().__init__(name, _operators(name, "+", n_in, operators))


class Product(Block, _core.Product):
    """y = 1 */ u_0 */ u_1 ..., entry by entry, with one operator for each input.

    Parameters
    ----------
    n_in
        The number of inputs; or the operators, in their place.
    operators
        `"*"` or `"/"` for each input: `"*/"` is u_0 / u_1. Without them all are `"*"`, for two
        inputs if `n_in` is not given either.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If there is another character than * and /, or not one for each of `n_in` inputs.

    Examples
    --------
    >>> from saltus.library import Product
    >>> saltus.response(Product("*/"), 6.0, 4.0)
    1.5
    """

    def __init__(
        self,
        n_in: int | str | None = None,
        operators: str | int | None = None,
        *,
        name: str | None = None,
    ):
        name = self._named(name)
        super().__init__(name, _operators(name, "*", n_in, operators))


class Abs(Block, _core.Abs):
    """y = abs(u), entry by entry. The times at which u passes zero are located as events.

    Parameters
    ----------
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Examples
    --------
    >>> from saltus.library import Abs
    >>> saltus.response(Abs(), [-2.0, 3.0])
    array([2., 3.])
    """

    def __init__(self, *, name: str | None = None):
        super().__init__(self._named(name))


class Saturate(Block, _core.Saturate):
    """y = min(max(u, lower_limit), upper_limit), entry by entry.

    Parameters
    ----------
    lower_limit, upper_limit
        Numbers, vectors or matrices; one of them may be left out. The given limits are parameters
        of the context. The times at which u passes a limit are located as events.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If neither is given, or the lower one is above the upper one.

    Examples
    --------
    >>> from saltus.library import Saturate
    >>> saltus.response(Saturate(-1.0, 1.0), [-5.0, 0.5, 5.0])
    array([-1. ,  0.5,  1. ])
    """

    def __init__(
        self,
        lower_limit: ArrayLike | None = None,
        upper_limit: ArrayLike | None = None,
        *,
        name: str | None = None,
    ):
        super().__init__(self._named(name), lower_limit, upper_limit)
