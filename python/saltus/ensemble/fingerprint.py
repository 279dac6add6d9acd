"""The fingerprint of a sweep: a digest of each thing on which its results depend."""

from __future__ import annotations

import functools
import hashlib
import re
import types
from typing import Any

import numpy as np

from saltus import _core
from saltus._engine import core_context
from saltus.ensemble.job import Job
from saltus.ensemble.table import Table
from saltus.system import OutputPort, System

__all__ = ["digest", "fingerprint"]

ADDRESS = re.compile(r" at 0x[0-9a-f]+")
UNSEEN = ("_callbacks", "_made")
"""attributes of a system that a run changes"""
OWN = ("saltus", "numpy", "builtins")
"""packages that belong to the version, not to the user"""
NUMBERS = (bool, int, float, complex, str, bytes, type(None), np.generic)


def fingerprint(job: Job, table: Table) -> dict[str, str]:
    """Name -> digest.

    Of a Python function count its code, its defaults, and the values of the variables that it reads
    if these are numbers, texts, arrays, functions, or lists and dicts of them. Not seen are fixed
    arguments of compiled blocks, and files.
    """
    options = {k: v for k, v in vars(job.options).items() if k != "progress"}
    return {
        "system": _digest(_system(job)),
        "values": _digest([(name, _Values().of(c)) for name, c in table.columns.items()]),
        "t_span": _digest(_Values().of(job.span)),
        "options": _digest(_Values().of(options)),
        "recorded_signals": _digest([(n, _port(p)) for n, p in job.signals.items()]),
        "context": _digest(None if job.context is None else core_context(job.context).to_json()),
        "reduce": _digest(_Values().of(job.reduce)),
        "saltus": _core.__version__,
    }


def digest(value: object) -> str:
    """The digest of values, of functions by their code, and of what they read."""
    return _digest(_Values().of(value))


def _digest(value: object) -> str:
    return hashlib.sha256(ADDRESS.sub("", repr(value)).encode()).hexdigest()


def _system(job: Job) -> object:
    """The values at the start, the wires, and all functions; or the code of a factory."""
    values = _Values()
    if not isinstance(job.system, System):
        return values.of(job.system)
    begin = core_context(job.system.create_context(job.span[0])).to_json()
    blocks = [
        [(f["role"], values.of(f["function"])) for f in block["functions"] if not f["compiled"]]
        for block in _core.Traces(job.system).blocks()
    ]
    return begin, job.system.to_dot(), values.of(job.system), blocks


def _port(port: OutputPort | str) -> str:
    return port if isinstance(port, str) else repr(port)


class _Values:
    """Values by their bits, functions by their code and what they read. Each object is seen once;
    of an object that is none of the known ones, the class and the attributes.
    """

    def __init__(self) -> None:
        self._seen: dict[int, object] = {}  # keeps the objects, so that no address is used again

    def of(self, value: Any) -> object:
        if isinstance(value, np.ndarray) and value.dtype != object:
            return value.dtype.str, value.shape, value.tobytes().hex()
        if isinstance(value, NUMBERS):
            return type(value).__name__, repr(value)
        if id(value) in self._seen:
            return type(value).__qualname__
        self._seen[id(value)] = value
        return type(value).__qualname__, self._parts(value)

    def _parts(self, value: Any) -> object:
        if isinstance(value, (list, tuple, np.ndarray)):
            return [self.of(v) for v in value]
        if isinstance(value, (set, frozenset)):
            return sorted(repr(self.of(v)) for v in value)
        if isinstance(value, dict):
            return [(str(k), self.of(v)) for k, v in value.items()]
        if isinstance(value, functools.partial):
            return [self.of(v) for v in (value.func, value.args, value.keywords)]
        if isinstance(value, types.MethodType):
            return self.of(value.__func__), self.of(value.__self__)
        if isinstance(value, types.FunctionType):
            return self._function(value)
        if isinstance(value, type):
            return value.__qualname__, self._class(value)
        if isinstance(value, types.ModuleType):
            return value.__name__
        return self._class(type(value)), [(n, self.of(v)) for n, v in _attributes(value)]

    def _function(self, function: types.FunctionType) -> object:
        cells = [cell.cell_contents for cell in function.__closure__ or () if _is_set(cell)]
        parts = [self.of(v) for v in (function.__defaults__, function.__kwdefaults__, cells)]
        if _is_own(function):
            return function.__qualname__, parts
        names, known = _names(function.__code__), function.__globals__
        read = {name: known[name] for name in names if name in known}
        return function.__qualname__, _code(function.__code__), parts, self.of(read)

    def _class(self, kind: type) -> object:
        """The functions of a class of the user."""
        if _is_own(kind):
            return kind.__qualname__
        return [(n, self.of(v)) for n, v in sorted(vars(kind).items()) if callable(v)]


def _is_own(value: Any) -> bool:
    return str(value.__module__).partition(".")[0] in OWN


def _attributes(value: Any) -> list[tuple[str, Any]]:
    """The attributes in the dict of an object, and in its slots."""
    slots = [n for kind in type(value).__mro__ for n in _slots(kind) if hasattr(value, n)]
    found = {name: getattr(value, name) for name in slots} | getattr(value, "__dict__", {})
    return sorted((n, v) for n, v in found.items() if not n.startswith("__") and n not in UNSEEN)


def _slots(kind: type) -> tuple[str, ...]:
    slots = vars(kind).get("__slots__", ())
    return (slots,) if isinstance(slots, str) else tuple(slots)


def _is_set(cell: types.CellType) -> bool:
    try:
        return cell.cell_contents is not cell
    except ValueError:
        return False


def _names(code: types.CodeType) -> list[str]:
    """The names that a function and the functions in it read."""
    inner = [n for c in code.co_consts if isinstance(c, types.CodeType) for n in _names(c)]
    return sorted({*code.co_names, *inner})


def _code(code: types.CodeType) -> object:
    constants = [_code(c) if isinstance(c, types.CodeType) else repr(c) for c in code.co_consts]
    return code.co_code.hex(), code.co_names, constants
