"""The names and the obstacles in the code of a function, read before the function runs."""

from __future__ import annotations

import dis
import inspect
import os
from collections.abc import Iterator
from functools import lru_cache
from types import CodeType

from saltus.tracing.refusal import Refusal

__all__ = ["names_in", "refuse_code"]

SINCE_311 = "PUSH_EXC_INFO" in dis.opmap
HANDLERS = {"PUSH_EXC_INFO"} if SINCE_311 else {"SETUP_FINALLY"}
IN_WITH = {"WITH_EXCEPT_START"} if SINCE_311 else set()  # before 3.11 a `with` has no handler
LOOKS_UP = {
    "LOAD_GLOBAL",
    "LOAD_NAME",
    "LOAD_FROM_DICT_OR_GLOBALS",
    "STORE_GLOBAL",
    "DELETE_GLOBAL",
}
KINDS = (
    (inspect.CO_COROUTINE, "is a coroutine (async def)"),
    (inspect.CO_ASYNC_GENERATOR, "is an asynchronous generator"),
)


def _all(code: CodeType) -> Iterator[CodeType]:
    yield code
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from _all(constant)


@lru_cache(maxsize=4096)
def names_in(code: CodeType) -> tuple[str, ...]:
    """Every name it looks up globally, those of functions inside it too; no attribute."""
    return tuple(
        dict.fromkeys(
            instruction.argval
            for part in _all(code)
            for instruction in dis.get_instructions(part)
            if instruction.opname in LOOKS_UP
        )
    )


def _catches(code: CodeType) -> int | None:
    """The line where an exception is caught, if there is one; a `with` does not count."""
    if getattr(code, "co_exceptiontable", None) == b"":
        return None  # quickly, since Python 3.11
    handlers, withs, line, first = 0, 0, code.co_firstlineno, None
    for instruction in dis.get_instructions(code):
        line = getattr(instruction, "line_number", None) or instruction.starts_line or line
        if instruction.opname in HANDLERS:
            handlers += 1
            first = first or line
        withs += instruction.opname in IN_WITH
    return first if handlers > withs else None


@lru_cache(maxsize=4096)
def reason_against(code: CodeType) -> str | None:
    """Why this code cannot be traced, if that shows without running it."""
    for part in _all(code):
        place = f"{os.path.basename(part.co_filename)}:{part.co_firstlineno}"
        for flag, what in KINDS:
            if part.co_flags & flag:
                return f"{what} at {place}; write a plain function"
        line = _catches(part)
        if line is not None:
            place = f"{os.path.basename(part.co_filename)}:{line}"
            return (
                f"catches exceptions at {place}, which values would decide; "
                "test the values by np.where, or leave it called"
            )
    return None


def refuse_code(code: CodeType) -> None:
    reason = reason_against(code)
    if reason is not None:
        raise Refusal(reason)
