"""Blocks whose signals are matrices: vectors of the entries, row by row, as `A.ravel()` gives."""

from __future__ import annotations

from collections.abc import Sequence

from saltus import _core
from saltus._whole import is_whole
from saltus.errors import ModelError
from saltus.library.block import Block

__all__ = ["MatrixInversion", "MatrixMultiplication", "MatrixTransposition"]


def _count(block: str, what: str, given: object) -> int:
    if is_whole(given) and given > 0:
        return int(given)
    raise ModelError(f"block '{block}': {what}: expected a whole number above 0, found {given!r}")


def _shape(block: str, what: str, given: object) -> tuple[int, int]:
    if isinstance(given, (tuple, list)) and len(given) == 2:
        return _count(block, f"rows of {what}", given[0]), _count(
            block, f"columns of {what}", given[1]
        )
    raise ModelError(
        f"block '{block}': {what}: expected (rows, columns), such as (2, 3), found {given!r}"
    )


class MatrixMultiplication(Block, _core.MatrixMultiplication):
    """Y = U_0 U_1, of two matrices.

    A matrix travels as the vector of its entries, row by row: `A.ravel()`. Inputs: in_0, m k entries,
    and in_1, k n entries. Output: out, m n entries.

    Parameters
    ----------
    left_shape
        (m, k), the rows and columns of U_0.
    right_shape
        (k, n), those of U_1.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If the columns of U_0 are not as many as the rows of U_1, or a shape is no pair of whole
        numbers above 0; when the diagram is built, if an input has another width.

    Examples
    --------
    >>> from saltus.library import MatrixMultiplication
    >>> product = MatrixMultiplication((2, 2), (2, 1))
    >>> saltus.response(product, [1.0, 2.0, 3.0, 4.0], [5.0, 6.0])
    array([17., 39.])
    """

    def __init__(
        self,
        left_shape: Sequence[int],
        right_shape: Sequence[int],
        *,
        name: str | None = None,
    ):
        own = self._named(name)
        super().__init__(
            own, _shape(own, "left_shape", left_shape), _shape(own, "right_shape", right_shape)
        )


class MatrixTransposition(Block, _core.MatrixTransposition):
    """Y = U^T, of a matrix.

    A matrix travels as the vector of its entries, row by row: `A.ravel()`. Input: in, m n entries.
    Output: out, those of the n x m matrix.

    Parameters
    ----------
    shape
        (m, n), the rows and columns of U.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If the shape is no pair of whole numbers above 0; when the diagram is built, if the input has
        another width.

    Examples
    --------
    >>> from saltus.library import MatrixTransposition
    >>> saltus.response(MatrixTransposition((2, 3)), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0])
    array([1., 4., 2., 5., 3., 6.])
    """

    def __init__(self, shape: Sequence[int], *, name: str | None = None):
        own = self._named(name)
        super().__init__(own, _shape(own, "shape", shape))


class MatrixInversion(Block, _core.MatrixInversion):
    """Y = U^-1, of a square matrix, by LU factorisation with partial pivoting.

    A matrix travels as the vector of its entries, row by row: `A.ravel()`. Input: in, n n entries.
    Output: out, n n entries. Golub and Van Loan, Matrix Computations, 4th edition, section 3.4.

    Parameters
    ----------
    rows
        n.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If `rows` is no whole number above 0; when the diagram is built, if the input has another
        width.
    SimulationError
        In a run, where the matrix is singular to working precision: its reciprocal condition number,
        estimated in the 1-norm, is below 2.2e-16, or an entry is not finite.

    Examples
    --------
    >>> from saltus.library import MatrixInversion
    >>> saltus.response(MatrixInversion(2), [2.0, 0.0, 0.0, 4.0])
    array([0.5 , 0.  , 0.  , 0.25])
    """

    def __init__(self, rows: int, *, name: str | None = None):
        own = self._named(name)
        super().__init__(own, _count(own, "rows", rows))
