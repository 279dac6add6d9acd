"""`SymbolArray`: an array of numbers, each known or symbolic, that behaves as numpy's.

The entries are in an array of objects, so that shapes, views and broadcasting are numpy's own.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from saltus.tracing.numbers.scalars import cast, is_number
from saltus.tracing.numbers.symbol import Symbol, joint, kind_of
from saltus.tracing.refusal import refuse

__all__ = [
    "LARGEST_TABLE",
    "Objects",
    "SymbolArray",
    "array",
    "as_array",
    "index_of",
    "is_known",
    "kind_of_type",
    "known",
    "objects_of",
    "wrapped",
]

Objects = NDArray[np.object_]

LARGEST_TABLE = 64  # entries to choose from by a value; each is compared at every evaluation

TYPES = {"b": np.dtype(bool), "i": np.dtype(np.int64), "f": np.dtype(np.float64)}
WHOLE: dict[str, str] = {"b": "b", "i": "i", "u": "i", "f": "f"}


def kind_of_type(dtype: Any) -> str:
    """The kind of a dtype: 'b', 'i' or 'f'."""
    found = np.dtype(dtype)
    kind = WHOLE.get(found.kind)
    if kind is None or (kind == "f" and found.itemsize < 8):
        refuse(f"computes with {found}", "every value of a tape is a double")
    return kind


def objects_of(value: Any) -> Objects:
    """The entries of any value that numpy accepts as an array, lists of symbols too."""
    if isinstance(value, SymbolArray):
        return value.data
    if isinstance(value, np.ndarray):
        if value.dtype != object:
            kind_of_type(value.dtype)
        return value.astype(object, copy=False)
    if isinstance(value, (list, tuple)):
        return _stacked([objects_of(item) for item in value])
    if not is_number(value):
        raise TypeError(f"expected numbers, found {type(value).__name__}")
    entry = np.empty((), dtype=object)
    entry[()] = value
    return entry


def _stacked(parts: list[Objects]) -> Objects:
    if len({part.shape for part in parts}) > 1:
        raise ValueError(
            "setting an array element with a sequence: the requested array has an inhomogeneous "
            f"shape, parts of shapes {[part.shape for part in parts]}"
        )
    result = np.empty((len(parts), *(parts[0].shape if parts else ())), dtype=object)
    for i, part in enumerate(parts):
        result[i] = part if part.ndim else part[()]
    return result


def _entry(item: Any) -> Any:
    """The entry of an array without dimensions, in which numpy may have put it."""
    return item[()] if isinstance(item, np.ndarray) and not item.ndim else item


def kind_in(data: Objects) -> str:
    return joint(
        *{kind_of(_entry(item)) or refuse(f"computes with {item!r}") for item in data.flat} or "f"
    )


def array(value: Any, kind: str = "") -> SymbolArray:
    """A new array, as np.array makes it."""
    data = objects_of(value)
    kind = kind or (value.kind if isinstance(value, SymbolArray) else kind_in(data))
    result = np.empty(data.shape, dtype=object)
    flat = result.reshape(-1)
    for i, item in enumerate(data.flat):
        flat[i] = cast(_entry(item), kind)
    return SymbolArray(result, kind)


def as_array(value: Any) -> SymbolArray:
    return value if isinstance(value, SymbolArray) else array(value)


def wrapped(data: Any, kind: str = "") -> Any:
    """The result of a numpy function on objects, as a number or an array."""
    if isinstance(data, np.ndarray) and data.ndim:
        return SymbolArray(data, kind) if kind else array(data)
    item = data[()] if isinstance(data, np.ndarray) else data
    kind = kind or kind_of(item)
    return cast(item, kind) if kind else item


def is_known(data: Objects) -> bool:
    """Whether no entry is symbolic."""
    return not any(type(item) is Symbol for item in data.flat)


def known(value: SymbolArray, what: str) -> NDArray[Any]:
    """The plain array of numbers, if all of them are known."""
    items = [item.known(what, "make it fixed") if type(item) is Symbol else item
             for item in value.data.flat]  # fmt: skip
    return np.array(items, dtype=TYPES[value.kind]).reshape(value.shape)


def index_of(key: Any) -> Any:
    """The index for numpy; arrays of known integers in it become arrays of numpy."""
    if isinstance(key, tuple):
        return tuple(index_of(part) for part in key)
    if isinstance(key, SymbolArray):
        return known(key, "uses values as indices")
    if isinstance(key, list):
        return [index_of(part) for part in key]
    return key.__index__() if type(key) is Symbol else key


class SymbolArray:
    """The arrays of a traced function: `state.continuous_state`, np.array(...), np.zeros(...).

    `frozen` names an array from outside the function, which must not be written to.
    """

    __array_priority__ = 1001.0
    __hash__ = None  # type: ignore[assignment]
    __slots__ = ("data", "frozen", "kind")

    _looked_up: Any  # these two are in operators.py
    _set_where: Any

    def __init__(self, data: Objects, kind: str, frozen: str = ""):
        self.data = data
        self.kind = kind
        self.frozen = frozen

    @property
    def shape(self) -> tuple[int, ...]:
        return self.data.shape

    @property
    def ndim(self) -> int:
        return self.data.ndim

    @property
    def size(self) -> int:
        return self.data.size

    @property
    def dtype(self) -> np.dtype[Any]:
        return TYPES[self.kind]

    @property
    def T(self) -> SymbolArray:
        return self._view(self.data.T)

    @property
    def real(self) -> SymbolArray:
        return self

    @property
    def flat(self) -> Iterator[Any]:
        return iter(self.ravel())

    def _view(self, data: Objects) -> SymbolArray:
        return SymbolArray(data, self.kind, self.frozen)

    def __len__(self) -> int:
        return len(self.data)

    def __iter__(self) -> Iterator[Any]:
        return (self[i] for i in range(len(self.data)))

    def __getitem__(self, key: Any) -> Any:
        if type(key) is Symbol and key.value is None and self.ndim:
            return self._looked_up(key)
        part = self.data[index_of(key)]
        return self._view(part) if isinstance(part, np.ndarray) else cast(part, self.kind)

    def __setitem__(self, key: Any, value: Any) -> None:
        if self.frozen:
            refuse(f"writes to {self.frozen}", "what changes something outside is called; copy it")
        if isinstance(key, SymbolArray) and key.kind == "b" and not is_known(key.data):
            self._set_where(key, value)
            return
        place = index_of(key)
        source = objects_of(value)
        cells = np.empty(source.shape, dtype=object)
        for i, item in enumerate(source.flat):
            cells.reshape(-1)[i] = cast(item, self.kind)
        if not isinstance(self.data[place], np.ndarray) and cells.ndim:
            if cells.size != 1:
                raise ValueError("setting an array element with a sequence.")
            cells = cells.reshape(())
        self.data[place] = cells if cells.ndim else cells[()]

    def _one(self) -> Any:
        if self.size != 1:
            raise ValueError(f"an array of {self.size} numbers is not one number")
        return self.data.reshape(-1)[0]

    def __bool__(self) -> bool:
        return bool(self._one())

    def __float__(self) -> float:
        return float(self._one())

    def __int__(self) -> int:
        return int(self._one())

    def __index__(self) -> int:
        if self.ndim:
            raise TypeError("only integer scalar arrays can be converted to a scalar index")
        return int(cast(self._one(), self.kind).__index__())

    def __contains__(self, value: Any) -> bool:
        return any(bool(item == value) for item in self.ravel())

    def __copy__(self) -> SymbolArray:
        return self.copy()

    def __deepcopy__(self, memo: object) -> SymbolArray:
        return self.copy()

    def __repr__(self) -> str:
        return f"<array of symbols, shape {self.shape}>"

    # methods of ndarray that only arrange
    def copy(self, order: str = "C") -> SymbolArray:
        return SymbolArray(self.data.copy(), self.kind)

    def astype(self, dtype: Any, copy: bool = True) -> SymbolArray:
        return array(self, kind_of_type(dtype))

    def reshape(self, *shape: Any, **options: Any) -> SymbolArray:
        return self._view(self.data.reshape(*shape, **options))

    def ravel(self, order: Any = "C") -> SymbolArray:
        return self._view(self.data.ravel(order))

    def flatten(self, order: Any = "C") -> SymbolArray:
        return SymbolArray(self.data.flatten(order), self.kind)

    def transpose(self, *axes: Any) -> SymbolArray:
        return self._view(self.data.transpose(*axes))

    def squeeze(self, axis: Any = None) -> SymbolArray:
        return self._view(self.data.squeeze(axis))

    def swapaxes(self, a: int, b: int) -> SymbolArray:
        return self._view(self.data.swapaxes(a, b))

    def repeat(self, repeats: Any, axis: Any = None) -> SymbolArray:
        return SymbolArray(self.data.repeat(index_of(repeats), axis), self.kind)

    def take(self, indices: Any, axis: Any = None) -> Any:
        return wrapped(self.data.take(index_of(indices), axis), self.kind)

    def diagonal(self, *arguments: int) -> SymbolArray:
        return self._view(self.data.diagonal(*arguments))

    def fill(self, value: Any) -> None:
        self[...] = value

    def item(self, *place: Any) -> Any:
        entry = cast(self.data.item(*place) if place else self._one(), self.kind)
        return entry.item()

    def tolist(self) -> Any:
        if not self.ndim:
            return self.item()
        return [row.tolist() if isinstance(row, SymbolArray) else row.item() for row in self]
