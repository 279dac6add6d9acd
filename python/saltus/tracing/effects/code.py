"""The writes that the instructions of a function show."""

from __future__ import annotations

import dis
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from types import CodeType

__all__ = ["MUTATORS", "Facts", "facts_of"]

BINDS = {"STORE_ATTR", "DELETE_ATTR", "STORE_GLOBAL", "DELETE_GLOBAL"}
CELLS = {"STORE_DEREF", "DELETE_DEREF"}
ENTRIES = {"STORE_SUBSCR", "DELETE_SUBSCR", "STORE_SLICE"}

MUTATORS = frozenset(
    """
    add append appendleft at byteswap clear copyto difference_update discard extend extendleft fill
    fill_diagonal iadd iand iconcat ifloordiv ilshift imatmul imod imul insert intersection_update
    ior ipow irshift isub itemset itruediv ixor delitem move_to_end next partition place pop popitem
    popleft put put_along_axis putmask remove resize reverse rotate setdefault setfield setflags
    setitem shuffle sort subtract symmetric_difference_update update
    __setitem__ __delitem__ __iadd__ __imul__ __ior__ __isub__ __itruediv__ __iand__ __ixor__
    """.split()
)
"""names of functions and methods that change a list, a dictionary, a set or an array they get"""

OF_ARRAYS = frozenset("data dtype flat imag real shape strides".split())
"""attributes of an array whose assignment changes its entries"""

DYNAMIC = frozenset(
    """
    setattr delattr exec eval compile globals locals vars getattr __import__ import_module
    __dict__ __setattr__ __delattr__ __getattribute__ __globals__ __closure__ cell_contents
    f_locals f_globals f_back gi_frame _getframe modules get_referents get_referrers get_objects
    __setstate__ ctypes
    """.split()
)
"""names with which a function can reach or write objects that its code does not name"""


@dataclass(frozen=True)
class Facts:
    """The names that one function, with the functions inside it, looks up and writes."""

    names: frozenset[str]
    """every attribute and global variable it may look up"""
    binds: frozenset[str]
    """the attributes and global variables that it binds"""
    cells: frozenset[str]
    """the variables of functions around it that it binds"""
    mutates: bool
    """it writes to an entry of something, or calls a function that may"""
    arguments: int
    """the number of arguments of the longest call; one argument more than a function of NumPy needs
    may be its `out`
    """
    dynamic: str
    """a name with which it can write everything; or nothing"""


def _all(code: CodeType) -> Iterator[CodeType]:
    yield code
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from _all(constant)


def _texts(constants: object) -> Iterator[str]:
    """The texts among the constants, which may name attributes, as for operator.methodcaller."""
    if isinstance(constants, str):
        yield constants
    elif isinstance(constants, tuple):
        for one in constants:
            yield from _texts(one)


def _in_place(instruction: dis.Instruction) -> bool:
    """x += 1 and its like, which change a list or an array that has another name elsewhere."""
    if instruction.opname == "BINARY_OP":
        return instruction.argrepr.endswith("=")
    return instruction.opname.startswith("INPLACE_")


def _arguments(instruction: dis.Instruction) -> int:
    name = instruction.opname
    if name == "CALL_FUNCTION_EX":
        return 1000  # an unknown number of arguments
    call = name.startswith("CALL") and "INTRINSIC" not in name
    return instruction.arg or 0 if call else 0


def _stores(parts: list[CodeType]) -> tuple[set[str], set[str], bool, int]:
    """The names it binds there and around it; whether it writes entries; its longest call."""
    binds: set[str] = set()
    cells: set[str] = set()
    writes, arguments = False, 0
    for part, instruction in ((p, i) for p in parts for i in dis.get_instructions(p)):
        if instruction.opname in BINDS:
            binds.add(instruction.argval)
        elif instruction.opname in CELLS and instruction.argval in part.co_freevars:
            cells.add(instruction.argval)
        writes |= instruction.opname in ENTRIES or _in_place(instruction)
        arguments = max(arguments, _arguments(instruction))
    return binds, cells, writes, arguments


def _names(parts: list[CodeType]) -> set[str]:
    names = {name for part in parts for name in part.co_names}
    return names | {
        text for part in parts for text in _texts(part.co_consts) if text.isidentifier()
    }


@lru_cache(maxsize=4096)
def facts_of(code: CodeType) -> Facts:
    """The facts of a function by its code."""
    parts = list(_all(code))
    binds, cells, writes, arguments = _stores(parts)
    names = _names(parts)
    if "print" in names:
        names |= {"write", "flush"}  # of a file that a user wrote
    if binds:
        names |= {"__setattr__", "__delattr__"}
    called = not names.isdisjoint(MUTATORS | {"out"})
    mutates = writes or called or not binds.isdisjoint(OF_ARRAYS)
    used = {name for part in parts for name in part.co_names}
    dynamic = min(used & DYNAMIC, default="")
    found = frozenset(names), frozenset(binds), frozenset(cells)
    return Facts(*found, mutates, arguments, dynamic)
