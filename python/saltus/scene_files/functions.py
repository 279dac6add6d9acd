"""Functions of Python made of checked expressions, and numbers made of them."""

from __future__ import annotations

import ast
import weakref
from collections.abc import Callable, Mapping, Sequence
from types import FunctionType
from typing import Any

import numpy as np

from saltus.scene_files.evaluation import evaluated
from saltus.scene_files.expression import Expression, expression
from saltus.scene_files.words import Word, template
from saltus.scene_files.wrong import Path, Wrong, found

__all__ = ["function_of", "list_of", "number_of", "numbers_scope", "value_of"]

_made: weakref.WeakValueDictionary[str, FunctionType] = weakref.WeakValueDictionary()
"""living functions, by their trees: equal trees share a function, which is traced once"""


def function_of(
    arguments: Sequence[str],
    body: ast.expr,
    rest: str | None = None,
    variables: Sequence[tuple[str, ast.expr]] = (),
) -> Callable[..., Any]:
    """A function with these arguments that sets the variables, one after another, and returns
    `body`; all trees are built by `expression`.
    """
    steps: list[ast.stmt] = [ast.Assign([_name(name)], tree) for name, tree in variables]
    steps.append(ast.Return(body))
    if any(isinstance(node, (ast.BinOp, ast.Call)) for step in steps for node in ast.walk(step)):
        # NumPy's warnings would name no line of the file; the engine reports what is not finite
        steps = [ast.With([ast.withitem(template('np.errstate(all="ignore")'))], steps)]
    key = f"{arguments} {rest} {[ast.dump(step) for step in steps]}"
    function = _made.get(key)
    if function is None:
        function = _compiled(arguments, steps, rest)
        _made[key] = function
    return function


def _name(name: str) -> ast.Name:
    return ast.Name(name, ast.Store())


def _compiled(arguments: Sequence[str], steps: list[ast.stmt], rest: str | None) -> FunctionType:
    whole = ast.parse("def function(): return 0")
    function = whole.body[0]
    assert isinstance(function, ast.FunctionDef)
    names = [ast.arg(name) for name in arguments]
    function.args = ast.arguments([], names, None, [], [], ast.arg(rest) if rest else None, [])
    function.body = steps
    made: dict[str, Any] = {}
    code = compile(ast.fix_missing_locations(whole), "<scene>", "exec")
    exec(code, {"np": np, "__builtins__": {}}, made)  # only defines the function
    defined: FunctionType = made["function"]
    return defined


def numbers_scope(values: Mapping[str, Any]) -> dict[str, Word]:
    """The scope of an expression that is a number as soon as a scene is read."""
    return {
        name: Word(f"p['{name}']", len(value) if isinstance(value, list) else None)
        for name, value in values.items()
    }


def number_of(
    path: Path, text: Any, values: Mapping[str, Any], read: dict[str, str] | None = None
) -> float:
    """The number of an expression of other numbers, whose names go to `read`, each with the key
    that reads it. Wrong if it has none.
    """
    made = expression(path, text, numbers_scope(values))
    if read is not None:
        key = next(f"'{key}'" for key in reversed(path) if isinstance(key, str))
        read |= {name: key for name in made.names if name not in read}
    return float(evaluated(path, text, made.tree, values))


def value_of(path: Path, value: Any, values: Mapping[str, Any]) -> Any:
    """A number, a truth, or a list of these. A text is an expression, or the name of a list."""
    if isinstance(value, list):
        return [value_of((*path, i), entry, values) for i, entry in enumerate(value)]
    if isinstance(value, str):
        whole = values.get(value.strip())
        return whole if isinstance(whole, list) else number_of(path, value, values)
    if isinstance(value, (int, float)):
        return value
    raise Wrong(path, f"expected a number, a list or an expression, found {found(value)}")


def list_of(expressions: Sequence[Expression]) -> ast.expr:
    """The tree of a list of expressions."""
    return ast.List([each.tree for each in expressions], ast.Load())
