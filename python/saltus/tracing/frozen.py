"""`FrozenList`: a list from outside, to read only."""

from __future__ import annotations

from typing import Any, NoReturn

from saltus.tracing.refusal import refuse


class FrozenList(list[Any]):
    """Reads as the list it stands for; whatever would change it is refused."""

    def __init__(self, items: list[Any], words: str):
        super().__init__(items)
        self._words = words

    def _refuse(self, *arguments: Any, **options: Any) -> NoReturn:
        refuse(f"writes to the list {self._words}", "what changes something outside is called")

    append = extend = insert = pop = remove = clear = sort = reverse = _refuse
    __setitem__ = __delitem__ = __iadd__ = __imul__ = _refuse
