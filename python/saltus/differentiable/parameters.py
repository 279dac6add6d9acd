"""The parameters of a differentiable run, given as an array or as a dict of names."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from saltus._core import known_names
from saltus.differentiable.run import Run
from saltus.errors import ModelError

__all__ = ["flat"]

Array = Callable[[str, Any], Any]
"""the value under a name as an array of float64, or a ModelError"""


def flat(run: Run, p: Any, array: Array, join: Callable[[list[Any]], Any]) -> Any:
    """All parameters in one array, in the order of `wrt`. ModelError for unknown and missing names
    and for wrong shapes.
    """
    if not isinstance(p, Mapping):
        return _shaped(run, "p", array("p", p), (len(run.parameters),))
    for name in p:
        if name not in run.groups:
            hint = known_names(str(name), list(run.groups))
            raise ModelError(f"{run.where}: wrt has no name {name!r}{hint}")
    parts = []
    for name, places in run.groups.items():
        if name not in p:
            raise ModelError(f"{run.where}: the dict has no value of '{name}', which wrt names")
        shape = () if run.parameters[places[0]] == name else (len(places),)
        part = _shaped(run, name, array(name, p[name]), shape)
        parts.append(part.reshape(len(places)))
    return join(parts)


def _shaped(run: Run, name: str, array: Any, shape: tuple[int, ...]) -> Any:
    if tuple(array.shape) != shape:
        raise ModelError(
            f"{run.where}: {name}: expected the shape {shape}, found {tuple(array.shape)}; the "
            f"parameters are {', '.join(run.parameters)}"
        )
    return array
