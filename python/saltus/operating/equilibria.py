"""`equilibria`: several operating points, each once."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from saltus import _core
from saltus._whole import is_whole
from saltus.errors import ModelError
from saltus.operating.point import OperatingPoint
from saltus.operating.question import Question, question_of
from saltus.system import System

__all__ = ["Equilibria", "equilibria"]

SAME = 1e-6
"""[of the size of a value] two searches to one point end closer than this"""


class Equilibria(Sequence[OperatingPoint]):
    """Distinct operating points, by the first free value, then by the second, and so on.

    Examples
    --------
    >>> import saltus
    >>> cubic = saltus.system_of(lambda t, x: [x[0] - x[0]**3], [0.5])
    >>> found = saltus.equilibria(cubic, {"x[0]": (-3, 2)})
    >>> len(found), found[0].stability
    (3, 'stable')
    """

    def __init__(self, points: Sequence[OperatingPoint], starts: int, failures: Sequence[str]):
        self.points: tuple[OperatingPoint, ...] = tuple(points)
        self.starts: int = starts
        """the number of starts"""
        self.failures: tuple[str, ...] = tuple(failures)
        """the messages of the starts that led to no point"""

    def __len__(self) -> int:
        return len(self.points)

    def __getitem__(self, index: Any) -> Any:
        return self.points[index]

    def __iter__(self) -> Iterator[OperatingPoint]:
        return iter(self.points)

    def __repr__(self) -> str:
        lines = [
            f"{len(self)} distinct points from {self.starts} starts, "
            f"{len(self.failures)} of which led to none"
        ]
        for point in self.points:
            values = ", ".join(f"{name} = {value:.6g}" for name, value in point.values.items())
            poles = ", ".join(f"{pole:.4g}" for pole in point.poles[:6])
            lines.append(f"  {values}: {point.stability}, poles {poles or 'none'}")
            lines += [f"    {note}" for note in point.notes]
        return "\n".join(lines)


def equilibria(
    system: System,
    starts: Mapping[str, tuple[float, float]] | Sequence[Mapping[str, float]],
    *,
    count: int = 32,
    seed: int = 0,
    hold: Sequence[str] | Mapping[str, Any] = (),
    derivatives: Sequence[str] | Mapping[str, float | None] = (),
    outputs: Mapping[str, Any] | None = None,
    context: _core.Context | None = None,
    tolerance: float = 1e-9,
    max_nfev: int | None = None,
    python: str = "traced",
) -> Equilibria:
    """Operating points from several starts, each point once, with its poles and its stability.

    Each start is a search by `trim`. There is no proof that all points are found; more starts find
    more.

    Parameters
    ----------
    system : System
        A block or a diagram.
    starts : dict of str to (lower, upper), or list of dict of str to float
        A box: the free values with their bounds, within which `count` starts are drawn by a Latin
        hypercube (McKay, Beckman and Conover, Technometrics 21, 1979), and the points are looked
        for. Or starts, each with a value for the same free names.
    count : int
        The number of starts in a box.
    seed : int
        Of the draw.
    hold, derivatives, outputs, context, tolerance, max_nfev, python
        As for `trim`.

    Returns
    -------
    Equilibria
        A sequence of `OperatingPoint`.

    Raises
    ------
    ModelError
        As `trim` does, but a start that fails is counted in `failures`; and for a name without
        bounds, and starts with different names.
    ImportError
        If SciPy is not installed.

    Examples
    --------
    A pendulum hangs and stands:

    >>> import numpy as np
    >>> pendulum = saltus.system_of(
    ...     lambda t, x: [x[1], -np.sin(x[0]) - 0.1 * x[1]], [0.1, 0.0]
    ... )
    >>> found = saltus.equilibria(pendulum, {"x[0]": (-1, 4), "x[1]": (-1, 1)})
    >>> [(round(p.values["x[0]"], 6), p.stability) for p in found]
    [(0.0, 'stable'), (3.141593, 'unstable')]
    """
    where = "equilibria"
    free = _frees(where, starts, count)
    question = question_of(
        where, system, free, hold, derivatives, outputs, context, python, tolerance, max_nfev
    )
    if isinstance(starts, Mapping):
        begins = _drawn(where, question.bounds, int(count), seed)
    else:
        begins = [np.array([each[name] for name in free], dtype=float) for each in starts]
    return _distinct(question, begins)


def _frees(where: str, starts: Any, count: Any) -> dict[str, Any]:
    """The free values as `trim` takes them."""
    if isinstance(starts, Mapping):
        if not is_whole(count) or count < 1:
            raise ModelError(f"{where}: count: expected 1 or more starts, found {count!r}")
        for name, bounds in starts.items():
            if not (isinstance(bounds, (tuple, list)) and np.all(np.isfinite(bounds))):
                raise ModelError(
                    f"{where}: starts: '{name}': expected finite bounds (lower, upper), found "
                    f"{bounds!r}"
                )
        return dict(starts)
    if not (isinstance(starts, (list, tuple)) and starts):
        raise ModelError(f"{where}: expected a box or a list of starts, found {starts!r}")
    for each in starts:
        if not isinstance(each, Mapping) or set(each) != set(starts[0]):
            raise ModelError(
                f"{where}: starts: expected dicts with the same names, found {starts[0]!r} and "
                f"{each!r}"
            )
    return dict(starts[0])


def _drawn(
    where: str, bounds: tuple[np.ndarray, np.ndarray], count: int, seed: Any
) -> list[np.ndarray]:
    """A start in each of `count` equal parts of each free value."""
    try:
        draw = np.random.default_rng(seed)
    except (TypeError, ValueError):
        raise ModelError(f"{where}: seed: expected an integer, found {seed!r}") from None
    lower, upper = bounds
    cells = np.column_stack([draw.permutation(count) for _ in lower])
    return list(lower + (cells + draw.random(cells.shape)) / count * (upper - lower))


def _distinct(question: Question, begins: Sequence[np.ndarray]) -> Equilibria:
    points: list[OperatingPoint] = []
    failures = []
    for start in begins:
        try:
            point = question.answer(start)
        except ModelError as error:
            failures.append(str(error))
            continue
        if not point.success:
            failures.append(point.message)
        elif not any(_same(point, other) for other in points):
            points.append(point)
    points.sort(key=lambda point: tuple(point.values.values()))
    return Equilibria(points, len(begins), failures)


def _same(one: OperatingPoint, other: OperatingPoint) -> bool:
    a, b = (np.array(list(point.values.values())) for point in (one, other))
    size = np.maximum(np.abs(a), np.abs(b))
    return bool(np.all(np.abs(a - b) <= SAME * np.where(size > SAME, size, 1.0)))
