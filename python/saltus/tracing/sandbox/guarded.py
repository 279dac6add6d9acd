"""`Guarded`: an object from outside, such as `self`: reads are recorded, writes refused."""

from __future__ import annotations

import functools
from types import FunctionType
from typing import Any, Protocol

from saltus.tracing.refusal import refuse
from saltus.tracing.sandbox.dependencies import MISSING, AttributeOf, Dependencies

__all__ = ["Guarded", "parent", "unguarded"]

OUTSIDE = "what changes something outside is called; keep it in the state"


class Forms(Protocol):
    """The part of a `Sandbox` that a guarded object needs."""

    dependencies: Dependencies

    def form_of(self, value: Any, words: str) -> Any: ...


def _sandbox(guarded: Guarded) -> tuple[Forms, Any, str]:
    parts: tuple[Forms, Any, str] = object.__getattribute__(guarded, "_parts")
    return parts


def unguarded(value: Any) -> Any:
    """The object itself."""
    return _sandbox(value)[1] if type(value) is Guarded else value


def parent(guarded: Guarded, after: type) -> Guarded:
    """super(): attributes of the classes after that one."""
    made = Guarded(*_sandbox(guarded))
    object.__setattr__(made, "_after", after)
    return made


class Guarded:
    """Stands for one object while a function of it is traced."""

    __slots__ = ("_after", "_parts")

    def __init__(self, sandbox: Forms, value: Any, words: str):
        object.__setattr__(self, "_parts", (sandbox, value, words))
        object.__setattr__(self, "_after", None)

    @property  # type: ignore[misc]
    def __class__(self) -> Any:  # guarded, too: a class can be written to
        sandbox, value, _ = _sandbox(self)
        return sandbox.form_of(type(value), type(value).__name__)

    def __getattr__(self, name: str) -> Any:
        return read(self, name)

    def __setattr__(self, name: str, value: Any) -> None:
        refuse(f"writes {_sandbox(self)[2]}.{name}", OUTSIDE)

    def __delattr__(self, name: str) -> None:
        refuse(f"deletes {_sandbox(self)[2]}.{name}", OUTSIDE)

    def __call__(self, *arguments: Any, **options: Any) -> Any:
        made = _sandbox(self)[1]
        if isinstance(made, type):
            if made.__mro__[1:] == (tuple, object) and hasattr(made, "_fields"):
                return made(*arguments, **options)  # a named tuple
            refuse(f"makes an object of the class {_sandbox(self)[2]}", "use numbers and arrays")
        return read(self, "__call__")(*arguments, **options)

    def __getitem__(self, key: Any) -> Any:
        return read(self, "__getitem__")(key)

    def __setitem__(self, key: Any, value: Any) -> None:
        refuse(f"writes to {_sandbox(self)[2]}", OUTSIDE)

    def __len__(self) -> int:
        length: int = read(self, "__len__")()
        return length

    def __bool__(self) -> bool:
        _, value, words = _sandbox(self)
        if hasattr(type(value), "__bool__") or hasattr(type(value), "__len__"):
            refuse(f"branches on the object {words}", "branch on a number of it")
        return True

    def __repr__(self) -> str:
        return f"<{_sandbox(self)[2]}>"


def read(guarded: Guarded, name: str) -> Any:
    """The form of an attribute; it is found where Python finds it, and recorded there."""
    sandbox, value, words = _sandbox(guarded)
    where = f"{words}.{name}"
    if isinstance(value, type):
        return _of_class(sandbox, value, name, where)
    sandbox.dependencies.add_entry(f"the class of {words}", _TypeOf(value), None, type(value))
    after = object.__getattribute__(guarded, "_after")
    found = _in_class(value, name, after)
    if found is not None and _is_data_descriptor(found[1]):
        _record_class(sandbox, type(value), name, where)
        return _described(guarded, found[1], name, where)
    own = getattr(value, "__dict__", {}) if after is None else {}
    if name in own:
        sandbox.dependencies.add_entry(where, own, name, own[name])
        return sandbox.form_of(own[name], where)
    if found is None:
        if hasattr(type(value), "__getattr__"):
            refuse(f"reads {where}, which __getattr__ makes up", "make it an attribute")
        sandbox.dependencies.add_entry(where, own, name, MISSING)  # hasattr, getattr(.., default)
        _record_class(sandbox, type(value), name, where)
        raise AttributeError(f"'{type(value).__name__}' object has no attribute '{name}'")
    sandbox.dependencies.add_entry(where, own, name, MISSING)
    _record_class(sandbox, type(value), name, where)
    return _described(guarded, found[1], name, where)


class _TypeOf(AttributeOf):
    """The class of an object, as an entry of a dictionary."""

    def get(self, key: None, default: Any) -> Any:
        return self("__class__", default)


def _in_class(value: Any, name: str, after: type | None) -> tuple[type, Any] | None:
    order = type(value).__mro__
    for base in order if after is None else order[order.index(after) + 1 :]:
        if name in base.__dict__:
            return base, base.__dict__[name]
    return None


def _record_class(sandbox: Forms, owner: type, name: str, where: str) -> None:
    """Record the class that has the attribute, and those before it that might get it."""
    for base in owner.__mro__:  # all of them: super() may have passed over some
        if base is not object:
            entry = base.__dict__.get(name, MISSING)
            sandbox.dependencies.add(where, functools.partial(_class_entry, base), name, entry)


def _class_entry(base: type, name: str, default: Any) -> Any:
    return base.__dict__.get(name, default)


def _is_data_descriptor(entry: Any) -> bool:
    return hasattr(type(entry), "__set__") or hasattr(type(entry), "__delete__")


def _described(guarded: Guarded, entry: Any, name: str, where: str) -> Any:
    """The value of an entry of the class, read through this object."""
    sandbox, value, _ = _sandbox(guarded)
    if object.__getattribute__(guarded, "_after") is not None:
        guarded = Guarded(*_sandbox(guarded))  # methods get the whole object
    if isinstance(entry, property) and isinstance(entry.fget, FunctionType):
        return sandbox.form_of(entry.fget, where)(guarded)
    if isinstance(entry, functools.cached_property):
        return sandbox.form_of(entry.func, where)(guarded)
    if isinstance(entry, staticmethod):
        return sandbox.form_of(entry.__func__, where)
    if isinstance(entry, classmethod):
        owner = sandbox.form_of(type(value), type(value).__name__)
        return functools.partial(sandbox.form_of(entry.__func__, where), owner)
    if isinstance(entry, FunctionType):
        return functools.partial(sandbox.form_of(entry, where), guarded)
    if hasattr(type(entry), "__get__"):
        now = getattr(value, name)
        sandbox.dependencies.add(where, AttributeOf(value), name, now)
        return sandbox.form_of(now, where)
    return sandbox.form_of(entry, where)


def _of_class(sandbox: Forms, owner: type, name: str, where: str) -> Any:
    """A constant of a class, a member of an enumeration, a static method."""
    value = getattr(owner, name)
    _record_class(sandbox, owner, name, where)
    return sandbox.form_of(value, where)
