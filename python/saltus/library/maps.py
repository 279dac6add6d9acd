"""Blocks that are a function of a number, entry by entry."""

from __future__ import annotations

from numpy.typing import ArrayLike

from saltus import _core
from saltus.library.block import Block

__all__ = ["Exponent", "Logarithm", "Power", "Reciprocal", "SquareRoot", "Trigonometric"]


class Exponent(Block, _core.Exponent):
    """y = e^u, or 2^u, entry by entry.

    Parameters
    ----------
    base
        "exp" or "2".
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If the base is unknown.

    Examples
    --------
    >>> from saltus.library import Exponent
    >>> saltus.response(Exponent("2"), [3.0, -1.0])
    array([8. , 0.5])
    """

    def __init__(self, base: str = "exp", *, name: str | None = None):
        super().__init__(self._named(name), base)


class Logarithm(Block, _core.Logarithm):
    """y = log(u), entry by entry. For u <= 0 the run ends with an error.

    Parameters
    ----------
    base
        "natural", "10" or "2".
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If the base is unknown.

    Examples
    --------
    >>> from saltus.library import Logarithm
    >>> saltus.response(Logarithm("10"), [1.0, 1000.0])
    array([0., 3.])
    """

    def __init__(self, base: str = "natural", *, name: str | None = None):
        super().__init__(self._named(name), base)


class Power(Block, _core.Power):
    """y = u^exponent, entry by entry.

    Parameters
    ----------
    exponent
        A number, or a vector as wide as the input. It is the parameter `exponent` of the context. A
        negative u needs a whole exponent: otherwise y is not a number, and the run ends with an
        error.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Examples
    --------
    >>> from saltus.library import Power
    >>> saltus.response(Power(2.0), [1.0, -3.0])
    array([1., 9.])
    """

    def __init__(self, exponent: ArrayLike, *, name: str | None = None):
        super().__init__(self._named(name), exponent)


class Reciprocal(Block, _core.Reciprocal):
    """y = 1 / u, entry by entry. A division by zero ends the run with an error.

    Parameters
    ----------
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Examples
    --------
    >>> from saltus.library import Reciprocal
    >>> saltus.response(Reciprocal(), [4.0, -0.5])
    array([ 0.25, -2.  ])
    """

    def __init__(self, *, name: str | None = None):
        super().__init__(self._named(name))


class SquareRoot(Block, _core.SquareRoot):
    """y = sqrt(u), entry by entry. For u < 0 the run ends with an error.

    Parameters
    ----------
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Examples
    --------
    >>> from saltus.library import SquareRoot
    >>> saltus.response(SquareRoot(), [4.0, 0.25])
    array([2. , 0.5])
    """

    def __init__(self, *, name: str | None = None):
        super().__init__(self._named(name))


class Trigonometric(Block, _core.Trigonometric):
    """y = function(u), entry by entry; angles are in rad. Outside the domain of an inverse function
    the run ends with an error.

    Parameters
    ----------
    function
        "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "asinh", "acosh" or
        "atanh".
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If the function is unknown.

    Examples
    --------
    >>> from saltus.library import Trigonometric
    >>> saltus.response(Trigonometric("cos"), [0.0, np.pi])
    array([ 1., -1.])
    """

    def __init__(self, function: str, *, name: str | None = None):
        super().__init__(self._named(name), function)
