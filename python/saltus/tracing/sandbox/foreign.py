"""`Foreign`: an object that a traced function may mention, but not use."""

from __future__ import annotations

from typing import Any, NoReturn

from saltus.tracing.refusal import refuse

__all__ = ["Foreign"]


class Foreign:
    """An object of another library, or a function with effects. Any use of it is refused."""

    __slots__ = ("_hint", "_words")

    def __init__(self, words: str, hint: str = ""):
        object.__setattr__(self, "_words", words)
        object.__setattr__(self, "_hint", hint)

    def _refuse(self, *arguments: Any, **options: Any) -> NoReturn:
        refuse(
            f"uses {self._words}, which cannot be traced"
            + (f" ({self._hint})" if self._hint else ""),
            "functions of numpy and math, and plain Python ones, can be",
        )

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__") and name.endswith("__"):
            raise AttributeError(name)
        return Foreign(f"{self._words}.{name}", self._hint)

    def __setattr__(self, name: str, value: Any) -> None:
        refuse(f"writes {self._words}.{name}", "what changes something outside is called")

    __call__ = __getitem__ = __setitem__ = __iter__ = __len__ = __contains__ = _refuse
    __next__ = __bool__ = __float__ = __int__ = __index__ = __enter__ = __exit__ = _refuse
    __add__ = __radd__ = __sub__ = __rsub__ = __mul__ = __rmul__ = __truediv__ = _refuse
    __rtruediv__ = __pow__ = __rpow__ = __matmul__ = __rmatmul__ = __neg__ = __abs__ = _refuse
    __lt__ = __le__ = __gt__ = __ge__ = __eq__ = __ne__ = _refuse
    __and__ = __or__ = __invert__ = __mod__ = __floordiv__ = _refuse

    def __hash__(self) -> int:
        return id(self)

    def __array__(self, *arguments: Any, **options: Any) -> Any:
        self._refuse()
