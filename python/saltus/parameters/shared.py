"""The parameters that a diagram declares, and those of its blocks that it computes from them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from saltus.errors import BuilderError, ModelError
from saltus.parameter import Parameter, roots_of
from saltus.parameters.tape import tape_of

__all__ = ["Shared"]


class Shared:
    """`parameters` of `DiagramBuilder.build`, for a diagram of these blocks."""

    def __init__(self, parameters: Mapping[str, Parameter], blocks: Mapping[str, Any]):
        if not isinstance(parameters, Mapping):
            raise ModelError(
                f"build: parameters: expected names and parameters, such as {{'mass': m}}, found "
                f"{parameters!r}"
            )
        self.parameters = dict(parameters)
        self._blocks = blocks
        self._declared: dict[int, tuple[int, Any]] = {}
        first = 0
        for name, one in self.parameters.items():
            if not isinstance(one, Parameter) or not isinstance(name, str):
                raise ModelError(
                    f"build: parameters: expected a name and a Parameter, found {name!r}: {one!r}; "
                    f"write m = Parameter('mass', ...), give m to blocks, and 'mass': m to build"
                )
            if id(one) in self._declared:
                raise ModelError(
                    f"build: parameters: '{name}' is declared by another name already; a parameter "
                    f"has one name in a diagram"
                )
            self._declared[id(one)] = first, one.value
            first += np.size(one.value)

    def add_to(self, core: Any) -> None:
        """Declares and computes them in the builder; what is wrong is said before."""
        tapes = [
            (block, name, self._tape(path, block, name)) for path, block, name in self._found()
        ]
        for name, one in self.parameters.items():
            core.declare_parameter(name, one.value)
        for block, name, tape in tapes:
            core.compute_parameter(block, name, tape)

    def _found(self) -> Iterator[tuple[str, Any, str]]:
        """The blocks, and the names of their parameters, that follow a declared one."""
        for path, block, inner in _holders(self._blocks):
            for name, one in getattr(block, "_expressions", {}).items():
                if self._declared.keys().isdisjoint(roots_of(one, self._declared)):
                    continue
                done = next((i for i in inner if _reads(i, one)), None)
                if done is None:
                    yield path, block, name
                elif not self._declared.keys().isdisjoint(roots_of(one, done) - done.keys()):
                    raise BuilderError(
                        f"build: parameter '{path}.{name}' is computed in an inner diagram "
                        f"already, from parameters that this one does not declare; declare those "
                        f"of this diagram there, too"
                    )

    def _tape(self, path: str, block: Any, name: str) -> Any:
        expression = block._expressions[name]
        size = np.size(block.create_context().parameters[name])
        return tape_of(f"parameter '{path}.{name}'", expression, self._declared, size)


def _reads(inner: Mapping[int, Any], expression: Parameter) -> bool:
    return not inner.keys().isdisjoint(roots_of(expression, inner))


def _holders(
    blocks: Mapping[str, Any], path: str = "", inside: tuple[Mapping[int, Any], ...] = ()
) -> Iterator[tuple[str, Any, tuple[Mapping[int, Any], ...]]]:
    """Each block with its path, and what the diagrams around it declare below this one."""
    for name, block in blocks.items():
        yield path + name, block, inside
        children = getattr(block, "_children", None)
        if children is not None:
            own = {id(one): one for one in getattr(block, "_expressions", {}).values()}
            yield from _holders(children, f"{path}{name}.", (*inside, own) if own else inside)
