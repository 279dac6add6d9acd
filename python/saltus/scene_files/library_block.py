"""A block of the library, made by its constructor from the table of a scene."""

from __future__ import annotations

import functools
import inspect
from typing import Any

from saltus import library
from saltus._core import known_names
from saltus.library.called import elsewhere
from saltus.scene_files.evaluation import evaluated
from saltus.scene_files.expression import expression
from saltus.scene_files.functions import function_of, list_of, number_of, value_of
from saltus.scene_files.state_machine import state_machine
from saltus.scene_files.words import ANY, EITHER, Word
from saltus.scene_files.wrong import Path, Wrong, found, placed, table_at
from saltus.system import System

__all__ = ["SUBSYSTEMS", "arguments_of", "library_block"]

SUBSYSTEMS = ("EnabledSubsystem", "TriggeredSubsystem")
"""the blocks that are made of a system of the scene, which takes the key `parameters`"""

FUNCTION_OF = {
    "ReduceBlock": {"u": Word("u", ANY)},
    "FunctionBlock": {"u": Word("u", EITHER)},
    "FeedthroughBlock": {"u": Word("u", EITHER)},
    "SourceBlock": {"t": Word("t")},
}
"""block -> the names in the text of its function"""


@functools.cache
def arguments_of(block: str) -> dict[str, inspect.Parameter]:
    """The arguments of the constructor of a block, except its name."""
    found = inspect.signature(getattr(library, block)).parameters
    return {name: each for name, each in found.items() if name != "name"}


def library_block(
    path: Path,
    table: dict[str, Any],
    name: str,
    values: dict[str, Any],
    made: dict[str, System] | None = None,
) -> System:
    """The block of a table; `made` has arguments that are systems. Wrong for an unknown block, and
    for arguments that it does not have.
    """
    made = made or {}
    block = _known(path, table["block"])
    known = arguments_of(block)
    given = {key: value for key, value in table.items() if key != "block"}
    for key in given:
        if key not in known:
            raise Wrong((*path, key), f"{block} has no '{key}'{known_names(key, list(known))}")
    for key, parameter in known.items():
        if parameter.default is parameter.empty and key not in given and key not in made:
            raise Wrong(path, f"{block} needs '{key}'")
    if block == "StateMachine":
        return state_machine(path, table, name, values)
    arguments = {
        key: _argument((*path, key), block, known[key], value, values)
        for key, value in given.items()
    }
    with placed(path):
        system: System = getattr(library, block)(**arguments, **made, name=name)
    return system


def _known(path: Path, block: Any) -> str:
    path = (*path, "block")
    if not isinstance(block, str):
        raise Wrong(path, f"expected the name of a block such as 'Gain', found {found(block)}")
    if block not in library.__all__:
        raise Wrong(path, f"the library has no block '{block}'{_advice(block)}")
    return block


def _advice(block: str) -> str:
    """The name here for a block of another tool, or the nearest name."""
    error = elsewhere(block, library.__all__)
    if isinstance(error, ImportError):
        return f"; {str(error).partition('; ')[2]}"
    return known_names(block, sorted(library.__all__))


def _argument(
    path: Path, block: str, parameter: inspect.Parameter, value: Any, values: dict[str, Any]
) -> Any:
    """A value of a table as the constructor takes it, by the annotation of its argument."""
    kind = str(parameter.annotation)
    if "Callable" in kind:
        return _function(path, block, value, values)
    if kind.startswith("Mapping") or ("Mapping" in kind and isinstance(value, dict)):
        table = table_at(path, value, "{ out = 1.0 }")
        return {key: value_of((*path, key), each, values) for key, each in table.items()}
    if isinstance(value, str) and "str" in kind:
        return value
    if isinstance(value, list) and "str" in kind and all(isinstance(v, str) for v in value):
        return value  # names, such as those of the signals of a bus
    if isinstance(value, bool) != (kind in ("bool", "bool | None")) and value is not None:
        raise Wrong(path, f"expected {_kind(kind)}, found {found(value)}")
    if isinstance(value, str) and kind.startswith("int"):
        number = number_of(path, value, values)
        if not number.is_integer():
            raise Wrong(path, f"expected a whole number, found {number:g}")
        return int(number)
    return value_of(path, value, values)


def _kind(annotation: str) -> str:
    words = {"bool": "true or false", "int": "a whole number", "float": "a number", "str": "text"}
    return words.get(annotation.partition(" |")[0], "a number or a list of numbers")


def _function(path: Path, block: str, text: Any, values: dict[str, Any]) -> Any:
    """The function of an expression; parameters of the scene are constants in it."""
    scope = FUNCTION_OF.get(block)
    if scope is None:
        raise Wrong(path, f"a function of {block} cannot be written in a scene; use a leaf")
    numbers = {n: float(v) for n, v in values.items() if isinstance(v, (int, float))}
    words = {n: Word(f"({v!r})".replace("inf", "np.inf")) for n, v in numbers.items()} | scope
    texts = [((*path, i), t) for i, t in enumerate(text)] if isinstance(text, list) else None
    made = [expression(p, t, words) for p, t in texts or [(path, text)]]
    for (p, t), each in zip(texts or [(path, text)], made, strict=True):
        evaluated(p, t, each.tree, {}, whole=False)
    return function_of(list(scope), list_of(made) if texts is not None else made[0].tree)
