"""Callbacks that the user compiled: `compiled` and the pointers it takes."""

from __future__ import annotations

import ctypes
import re
import sys
from dataclasses import dataclass, field
from typing import Any

from saltus.errors import ModelError

__all__ = ["Compiled", "as_compiled", "compiled"]

CTYPES: Any = ctypes.CFUNCTYPE(None).__base__  # the base of every function pointer of ctypes
SIGNATURE = "int (double, double *, double *, double *, double *, void *)"


@dataclass(frozen=True)
class Compiled:
    """A compiled function in place of a Python one; made by `saltus.compiled`.

    Parameters
    ----------
    address
        The address of the function.
    user_data
        The address that the function gets as its last argument.
    owner
        The object that keeps the function and its data alive.

    Examples
    --------
    >>> saltus.compiled(0x7F0000001000).user_data
    0
    """

    address: int
    """the address of the function"""
    user_data: int = 0
    """the address it gets as its last argument"""
    owner: object = field(default=None, repr=False, compare=False)
    """the object that keeps the function and its data alive"""


def compiled(function: Any, user_data: Any = None) -> Compiled:
    """A compiled function as a callback: it runs without the interpreter and its lock.

    It may be given wherever a block takes a Python function of `(time, state, *inputs,
    **parameters)`. A pointer that shows its signature may be given to the block directly; an
    address must go through this function.

    Its signature in C is::

        int f(double t, const double* x, const double* u, const double* p, double* out,
              void* user_data);

    - `t` is the time [s];
    - `x` is the continuous state, then the discrete state, each in C order, then the mode, then
      the entry (in a reset map: the index of the guard that fired, in a vector of guards);
    - `u` is the inputs that `requires_inputs` names, one after the other, and for an event input the
      weight after them;
    - `p` is all parameters of the block, one after the other, in the order of declaration;
    - `out` is the array to write: the derivatives, the guards, the output (the block has to give
      its `shape`), a Jacobian row by row, the values of a sparse one. For a reset map or an update
      it begins as the present continuous state, discrete state and mode, one after the other, and
      the function changes any of them;
    - it returns 0. Any other number ends the run with a `SimulationError` that gives the number.

    The engine calls it any number of times, from the thread that runs the simulation, so it must
    change nothing but `out`.

    Parameters
    ----------
    function : int, ctypes or cffi function pointer, PyCapsule, LowLevelCallable or numba cfunc
        An address, or an object that has one. The name of a capsule, if it has one, is its
        signature, as in SciPy, and its context is `user_data`.
    user_data : int or ctypes pointer, optional
        The last argument of the function; NULL if not given.

    Returns
    -------
    Compiled
        The object that keeps `function` and `user_data` alive as long as a block uses them.

    Raises
    ------
    ModelError
        If it is anything else, or a pointer with another signature.

    Examples
    --------
    >>> import ctypes, saltus
    >>> number, numbers = ctypes.c_double, ctypes.POINTER(ctypes.c_double)
    >>> kind = ctypes.CFUNCTYPE(
    ...     ctypes.c_int, number, numbers, numbers, numbers, numbers, ctypes.c_void_p)
    >>> @kind
    ... def decay(t, x, u, p, out, user_data):
    ...     out[0] = -x[0]
    ...     return 0
    >>> block = saltus.LeafSystem(name="decay")
    >>> block.declare_continuous_state(default_value=[1.0], ode=saltus.compiled(decay))
    >>> end = saltus.simulate(block, block.create_context(), (0.0, 1.0)).context
    >>> print(round(end.continuous_state[0], 4))
    0.3679
    """
    found = as_compiled(function, user_data)
    if found is None and isinstance(function, int) and not isinstance(function, bool):
        found = Compiled(function, _data(user_data), user_data)
    if found is None:
        raise ModelError(
            "compiled: expected an address, a ctypes or cffi function pointer, a PyCapsule, a "
            f"scipy.LowLevelCallable or a numba cfunc, found {function!r}"
        )
    if found.address <= 0:
        raise ModelError(f"compiled: {found.address} is not the address of a function")
    return found


def as_compiled(function: Any, user_data: Any = None) -> Compiled | None:
    """The compiled function behind an object that shows its signature, otherwise None."""
    if isinstance(function, Compiled):
        return function
    owner = (function, user_data)
    kind = type(function)
    if isinstance(function, CTYPES):
        _check_ctypes(function)
        address = ctypes.cast(function, ctypes.c_void_p).value or 0
        return Compiled(address, _data(user_data), owner)
    if kind.__name__ == "PyCapsule":
        return _from_capsule(function, user_data, owner)
    if kind.__name__ == "LowLevelCallable" and isinstance(function, tuple):  # of SciPy
        return _from_capsule(tuple.__getitem__(function, 0), user_data, owner)
    if kind.__module__.startswith("numba."):
        found = getattr(function, "address", None)  # a cfunc has one, a jitted function none
        return Compiled(found, _data(user_data), owner) if isinstance(found, int) else None
    if kind.__module__ == "_cffi_backend":
        ffi = sys.modules["_cffi_backend"].FFI()  # cffi is there: it made the pointer
        return Compiled(int(ffi.cast("intptr_t", function)), _data(user_data), owner)
    return None


def _data(user_data: Any) -> int:
    """An address as an integer."""
    if user_data is None:
        return 0
    if isinstance(user_data, int):
        return user_data
    try:
        return ctypes.cast(user_data, ctypes.c_void_p).value or 0
    except (TypeError, ctypes.ArgumentError):
        raise ModelError(
            f"compiled: user_data: expected an address or a ctypes pointer, found {user_data!r}"
        ) from None


def _check_ctypes(function: Any) -> None:
    """Checks that a pointer which knows its arguments has six of them and returns an int."""
    if function.argtypes is None:
        return
    if len(function.argtypes) != 6 or function.restype is not ctypes.c_int:
        raise ModelError(
            f"compiled: expected a function '{SIGNATURE}', found one of {len(function.argtypes)} "
            f"arguments that returns {getattr(function.restype, '__name__', 'nothing')}"
        )


def _from_capsule(capsule: Any, user_data: Any, owner: object) -> Compiled:
    api = ctypes.pythonapi
    for name, kind in (("Name", ctypes.c_char_p), ("Context", ctypes.c_void_p)):
        get = getattr(api, f"PyCapsule_Get{name}")
        get.restype, get.argtypes = kind, [ctypes.py_object]
    pointer = api.PyCapsule_GetPointer
    pointer.restype, pointer.argtypes = ctypes.c_void_p, [ctypes.py_object, ctypes.c_char_p]
    name = api.PyCapsule_GetName(capsule)
    if name is not None and _plain(name.decode()) != _plain(SIGNATURE):
        raise ModelError(f"compiled: expected a function '{SIGNATURE}', found '{name.decode()}'")
    data = _data(user_data) if user_data is not None else api.PyCapsule_GetContext(capsule) or 0
    return Compiled(pointer(capsule, name), data, owner)


def _plain(signature: str) -> str:
    """A C signature without `const`, names of arguments and spaces."""
    signature = re.sub(r"\bconst\b", "", signature)
    signature = re.sub(r"\b(double|void)(\s*\*?\s*)\w+(?=\s*[,)])", r"\1\2", signature)
    return re.sub(r"\s", "", signature)
