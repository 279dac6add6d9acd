"""Blocks whose signals are matrices."""

from __future__ import annotations

from collections.abc import Sequence

from saltus import _core
from saltus._whole import is_whole
from saltus.errors import ModelError
from saltus.library.block import Block

__all__ = [
    "MatrixConcatenation",
    "MatrixInversion",
    "MatrixMultiplication",
    "MatrixTransposition",
    "Reshape",
]


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

    Inputs: in_0, of shape (m, k), and in_1, of shape (k, n). Output: out, of shape (m, n). As in
    NumPy's `A @ B` a vector of k entries may stand in the place of either: on the left it is a row,
    on the right a column, and out is a vector, of two vectors a number.

    Parameters
    ----------
    left_shape, right_shape
        (m, k) and (k, n), both or neither. By default the wires decide. An input of given shape
        takes a vector of its m k, or k n, entries row by row too, as `A.ravel()` gives.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If the columns of U_0 are not as many as the rows of U_1, which is found here or when the
        diagram is built; for a scalar wire; if a shape is no pair of whole numbers above 0, or only
        one is given.

    Examples
    --------
    >>> from saltus.library import MatrixMultiplication
    >>> saltus.response(MatrixMultiplication(), [[1.0, 2.0], [3.0, 4.0]], [5.0, 6.0])
    array([17., 39.])
    >>> saltus.response(MatrixMultiplication((2, 2), (2, 1)), [1.0, 2.0, 3.0, 4.0], [5.0, 6.0])
    array([[17.],
           [39.]])
    """

    def __init__(
        self,
        left_shape: Sequence[int] | None = None,
        right_shape: Sequence[int] | None = None,
        *,
        name: str | None = None,
    ):
        own = self._named(name)
        if right_shape is None and is_whole(left_shape) and left_shape == 2:
            left_shape = None  # it is the number of inputs in pycollimator
        if left_shape is None and right_shape is None:
            super().__init__(own)
            return
        if left_shape is None or right_shape is None:
            given = "left_shape" if right_shape is None else "right_shape"
            raise ModelError(
                f"block '{own}': expected left_shape and right_shape, or neither; found "
                f"{given} only"
            )
        super().__init__(
            own, _shape(own, "left_shape", left_shape), _shape(own, "right_shape", right_shape)
        )


class MatrixTransposition(Block, _core.MatrixTransposition):
    """Y = U^T, of a matrix.

    Input: in, of shape (m, n). Output: out, of shape (n, m).

    Parameters
    ----------
    shape
        (m, n). By default the wire decides. An input of given shape takes a vector of its entries
        row by row too, as `A.ravel()` gives.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If the shape is no pair of whole numbers above 0; when the diagram is built, if the input is
        no matrix, or one of another shape.

    Examples
    --------
    >>> from saltus.library import MatrixTransposition
    >>> saltus.response(MatrixTransposition(), [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]])
    array([[1., 4.],
           [2., 5.],
           [3., 6.]])
    """

    def __init__(self, shape: Sequence[int] | None = None, *, name: str | None = None):
        own = self._named(name)
        if shape is None:
            super().__init__(own)
        else:
            super().__init__(own, _shape(own, "shape", shape))


class MatrixInversion(Block, _core.MatrixInversion):
    """Y = U^-1, of a square matrix, by LU factorisation with partial pivoting.

    Input: in, of shape (n, n). Output: out, of the same shape. Golub and Van Loan, Matrix
    Computations, 4th edition, section 3.4.

    Parameters
    ----------
    rows
        n. By default the wire decides. If it is given, the input takes a vector of the n n entries
        row by row too, as `A.ravel()` gives.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If `rows` is no whole number above 0; when the diagram is built, if the input is no square
        matrix, or one of another shape.
    SimulationError
        In a run, where the matrix is singular to working precision: its reciprocal condition
        number, estimated in the 1-norm, is below 2.2e-16, or an entry is not finite.

    Examples
    --------
    >>> from saltus.library import MatrixInversion
    >>> saltus.response(MatrixInversion(), [[2.0, 0.0], [0.0, 4.0]])
    array([[0.5 , 0.  ],
           [0.  , 0.25]])
    """

    def __init__(self, rows: int | None = None, *, name: str | None = None):
        own = self._named(name)
        if rows is None:
            super().__init__(own)
        else:
            super().__init__(own, _count(own, "rows", rows))


class MatrixConcatenation(Block, _core.MatrixConcatenation):
    """Y = (U_0; U_1; ...), one below the other, or (U_0 U_1 ...), one beside the other.

    Inputs: in_0, in_1, ..., matrices of as many columns along axis 0, of as many rows along axis 1.
    A vector is a row along axis 0 and a column along axis 1, a number is 1 x 1: so `np.vstack` and
    `np.column_stack` do. Output: out, a matrix.

    Parameters
    ----------
    n_inputs
        The number of inputs.
    axis
        0: the rows of the inputs follow each other. 1: their columns do.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If `n_inputs` is no whole number above 0, or the axis not 0 or 1; when the diagram is built,
        if the inputs have different numbers of columns, or rows along axis 1.

    Examples
    --------
    >>> from saltus.library import MatrixConcatenation
    >>> saltus.response(MatrixConcatenation(2), [1.0, 2.0], [3.0, 4.0])
    array([[1., 2.],
           [3., 4.]])
    >>> saltus.response(MatrixConcatenation(2, axis=1), [[1.0, 2.0], [3.0, 4.0]], [5.0, 6.0])
    array([[1., 2., 5.],
           [3., 4., 6.]])
    """

    def __init__(self, n_inputs: int = 2, axis: int = 0, *, name: str | None = None):
        own = self._named(name)
        if not is_whole(axis) or axis not in (0, 1):
            raise ModelError(f"block '{own}': axis: expected 0 or 1, found {axis!r}")
        super().__init__(own, _count(own, "n_inputs", n_inputs), int(axis))


class Reshape(Block, _core.Reshape):
    """y = the entries of u in another shape, row by row, as `np.reshape(u, shape)` has them.

    Input: in, of any shape of as many entries. Output: out, of the given shape.

    Parameters
    ----------
    shape
        (m, n) for a matrix, n or (n,) for a vector, () for a number.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If the shape is none of these, with whole numbers above 0; when the diagram is built, if the
        input has another number of entries.

    Examples
    --------
    >>> from saltus.library import Reshape
    >>> saltus.response(Reshape((2, 2)), [1.0, 2.0, 3.0, 4.0])
    array([[1., 2.],
           [3., 4.]])
    """

    def __init__(self, shape: int | Sequence[int], *, name: str | None = None):
        own = self._named(name)
        entries = [shape] if is_whole(shape) else shape
        if not isinstance(entries, (tuple, list)) or len(entries) > 2:
            raise ModelError(
                f"block '{own}': shape: expected (m, n), a number of entries or (), found {shape!r}"
            )
        super().__init__(own, [_count(own, "entries of shape", one) for one in entries])
