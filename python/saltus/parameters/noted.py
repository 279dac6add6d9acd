"""A `Parameter` where a block expects a number: the block gets the value, and the expression is
noted, so that the diagram can compute the parameter of the block from it.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from saltus.errors import BlockParameterError
from saltus.parameter import Parameter, given

__all__ = ["note", "plain"]

STARTS = {"initial_state"}
"""parameters of the context with which a state starts: a context has the state itself"""


def plain(arguments: Mapping[str, Any]) -> tuple[dict[str, Any], dict[str, Parameter]]:
    """The arguments with numbers in place of expressions, and the expressions."""
    found = {name: one for name, value in arguments.items() if (one := given(value)) is not None}
    return {**arguments, **{name: one.value for name, one in found.items()}}, found


def note(block: Any, expressions: Mapping[str, Parameter]) -> None:
    """Notes the expressions of parameters of a block; BlockParameterError for an argument that is
    no parameter of the context.
    """
    known = [name for name in block.create_context().parameters if name not in STARTS]
    for name in expressions:
        if name not in known:
            what = "a start value" if name in STARTS else "no parameter of the context"
            raise BlockParameterError(
                f"block '{block.name}': '{name}' is {what}, so it cannot follow a Parameter (those "
                f"that can: {', '.join(known) or 'none'}); give a number, such as its .value"
            )
    block._expressions = {**getattr(block, "_expressions", {}), **expressions}
