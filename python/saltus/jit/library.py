"""Functions of the processor from modules of LLVM, each made once."""

from __future__ import annotations

import importlib.util
import threading
from collections import OrderedDict
from typing import Any

from saltus.errors import ModelError
from saltus.jit import disk

__all__ = ["functions", "is_installed", "require_installed"]

KEPT = 64
"""the number of libraries that are kept for equal systems after their last user is gone; each takes
about 10 kB
"""

_lock = threading.RLock()  # reentrant: a signal handler may interrupt the thread that has it
_libraries: OrderedDict[str, Any] = OrderedDict()


def is_installed() -> bool:
    """Whether llvmlite can be imported. It is not imported to find out."""
    return importlib.util.find_spec("llvmlite") is not None


def require_installed() -> None:
    """ModelError without llvmlite."""
    if not is_installed():
        raise ModelError(
            "option machine_code='always' needs llvmlite, which is not installed: "
            'pip install "saltus[jit]"'
        )


def functions(module: str, count: int) -> tuple[list[int], Any]:
    """The addresses of ``saltus_tape_0`` to ``saltus_tape_<count - 1>`` in a module of LLVM.

    Parameters
    ----------
    module : str
        The module as text, see ``saltus/tape/machine_code.hpp``.
    count : int
        The number of its functions.

    Returns
    -------
    (list of int, object)
        The addresses, and the library: the addresses hold while it lives.
    """
    require_installed()
    from saltus.jit import compiler

    with _lock:
        key = compiler.key_of(module)
        library = _libraries.pop(key, None)
        if library is None:
            object_code = disk.load(key)
            if object_code is None:
                object_code = compiler.compiled(module)
                disk.store(key, object_code)
            library = compiler.linked(key, object_code, count)
        _libraries[key] = library  # the last one used is the last one to go
        while len(_libraries) > KEPT:
            _libraries.popitem(last=False)
    return [library[f"saltus_tape_{i}"] for i in range(count)], library
