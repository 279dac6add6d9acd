"""Lists, tuples, dictionaries from outside, to read only; a mode may choose among their entries."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NoReturn

from saltus.tracing.numbers import Symbol, apply, array
from saltus.tracing.refusal import refuse

__all__ = ["FrozenDict", "FrozenList", "FrozenTuple"]

OUTSIDE = "what changes something outside is called"


class FrozenList(list[Any]):
    """A copy of a list from outside; every method that would change it refuses."""

    def __init__(self, items: Iterable[Any] = (), words: str = "it"):
        super().__init__(items)
        self._words = words

    def __getitem__(self, key: Any) -> Any:
        return array(list(self))[key] if type(key) is Symbol else super().__getitem__(key)

    def _refuse(self, *arguments: Any, **options: Any) -> NoReturn:
        refuse(f"writes to the list {self._words}", OUTSIDE)

    append = extend = insert = pop = remove = clear = sort = reverse = _refuse
    __setitem__ = __delitem__ = __iadd__ = __imul__ = _refuse


class FrozenTuple(tuple[Any, ...]):
    """A tuple whose entry a value may choose."""

    __slots__ = ()

    def __getitem__(self, key: Any) -> Any:
        return array(tuple(self))[key] if type(key) is Symbol else super().__getitem__(key)


class FrozenDict(dict[Any, Any]):
    """A copy of a dictionary from outside; a mode may choose among its values."""

    def __init__(self, items: Any = (), words: str = "it"):
        super().__init__(items)
        self._words = words

    def __getitem__(self, key: Any) -> Any:
        if type(key) is not Symbol or key.kind != "i" or key.value is not None:
            return super().__getitem__(key)
        result: Any = float("nan")  # a KeyError when called
        for known, value in self.items():
            result = apply("select", apply("eq", key, known), value, result)
        return result

    def _refuse(self, *arguments: Any, **options: Any) -> NoReturn:
        refuse(f"writes to the dictionary {self._words}", OUTSIDE)

    update = pop = popitem = clear = setdefault = _refuse
    __setitem__ = __delitem__ = __ior__ = _refuse
