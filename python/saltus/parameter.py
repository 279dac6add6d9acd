"""`Parameter`: a value with a name, or an expression of such values."""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np
from numpy.typing import ArrayLike

from saltus.errors import ModelError

__all__ = ["Parameter", "expression_of", "given", "roots_of", "value_of"]


class Parameter:
    """A value that blocks of a diagram share: give it, or an expression of it, to a block where it
    expects a number that is a parameter of the context.

    `DiagramBuilder.build(parameters={"mass": m})` makes it a parameter of the diagram. From then on
    ``context.with_parameter("mass", 3.0)`` sets all parameters of blocks that are computed from it,
    and so does ``sweep(diagram, {"mass": [...]}, ...)``. Until then, and in a diagram that does not
    declare it, a block has the value alone.

    Parameters
    ----------
    name
        For messages; the name in a context is that of `build`.
    value
        A number, a vector, or an expression of other parameters. `+ - * / // % **`, `abs`,
        comparisons (1 for true, 0 for false), an index, and the functions of numpy such as
        `np.sin` make expressions.

    Raises
    ------
    ModelError
        Where a plain number is needed: take `value`, which does not follow the parameter.

    Examples
    --------
    >>> from saltus.library import Constant, Gain
    >>> m = saltus.Parameter("mass", 2.0)
    >>> builder = saltus.DiagramBuilder()
    >>> one, weight = builder.add(Constant(1.0, name="one"), Gain(-9.81 * m, name="weight"))
    >>> builder.connect(one.output(), weight.input())
    >>> diagram = builder.build(parameters={"mass": m})
    >>> context = diagram.create_context().with_parameter("mass", 3.0)
    >>> context.parameters
    {'one.value': 1.0, 'weight.gain': -29.43, 'mass': 3.0}
    """

    __slots__ = ("function", "name", "operands")
    __hash__ = object.__hash__

    function: Callable[..., Any]
    """computes the value from those of the operands"""
    operands: tuple[Any, ...]

    def __init__(self, name: str | None = None, value: ArrayLike | Parameter | None = None):
        if name is not None and not isinstance(name, str):
            raise ModelError(f"Parameter: name: expected a text, found {name!r}")
        if value is None:
            raise ModelError("Parameter: give its value, as in Parameter('mass', 2.0)")
        self.name = name or "a parameter"
        self.function = _same
        self.operands = (value if isinstance(value, Parameter) else _number(self.name, value),)

    @property
    def value(self) -> Any:
        """The value, or that of the expression, from the values that parameters were made with."""
        return value_of(self, {})

    def __repr__(self) -> str:
        return f"<Parameter {self.name}: {self.value}>"

    if TYPE_CHECKING:  # defined at the end of the module

        def __add__(self, other: Any) -> Parameter: ...
        def __radd__(self, other: Any) -> Parameter: ...
        def __sub__(self, other: Any) -> Parameter: ...
        def __rsub__(self, other: Any) -> Parameter: ...
        def __mul__(self, other: Any) -> Parameter: ...
        def __rmul__(self, other: Any) -> Parameter: ...
        def __truediv__(self, other: Any) -> Parameter: ...
        def __rtruediv__(self, other: Any) -> Parameter: ...
        def __floordiv__(self, other: Any) -> Parameter: ...
        def __rfloordiv__(self, other: Any) -> Parameter: ...
        def __mod__(self, other: Any) -> Parameter: ...
        def __rmod__(self, other: Any) -> Parameter: ...
        def __pow__(self, other: Any) -> Parameter: ...
        def __rpow__(self, other: Any) -> Parameter: ...
        def __neg__(self) -> Parameter: ...
        def __pos__(self) -> Parameter: ...
        def __abs__(self) -> Parameter: ...
        def __lt__(self, other: Any) -> Parameter: ...
        def __le__(self, other: Any) -> Parameter: ...
        def __gt__(self, other: Any) -> Parameter: ...
        def __ge__(self, other: Any) -> Parameter: ...

    def __getitem__(self, index: Any) -> Parameter:
        return expression_of(operator.getitem, self, index)

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **options: Any) -> Any:
        if method != "__call__" or options:
            raise ModelError(f"Parameter: {ufunc.__name__}.{method} with options is no expression")
        return expression_of(ufunc, *inputs)

    def __array_function__(self, function: Any, _: Any, operands: Any, options: Any) -> Any:
        if options or any(map(_is_list_of, operands)):
            raise ModelError(
                f"Parameter: {function.__name__} with options, or of a list, is no expression; "
                f"compute it entry by entry"
            )
        return expression_of(function, *operands)

    def _no_number(self, *_: Any, **__: Any) -> NoReturn:
        raise ModelError(
            f"{self.name} (a Parameter) is used where a number is needed, which would not follow "
            f"it; take its .value if that is meant"
        )

    __float__ = __int__ = __bool__ = __index__ = __iter__ = __len__ = __array__ = _no_number


def expression_of(function: Callable[..., Any], *operands: Any) -> Parameter:
    """The expression function(*operands)."""
    made = Parameter.__new__(Parameter)
    made.name, made.function, made.operands = "an expression", function, operands
    return made


def value_of(one: Any, known: Mapping[int, Any]) -> Any:
    """The value of an operand. `known` has other values for some parameters, by their `id`."""
    values = dict(known)  # an expression that several others read is computed once

    def value(operand: Any) -> Any:
        if not isinstance(operand, Parameter):
            return operand
        if id(operand) not in values:
            values[id(operand)] = operand.function(*map(value, operand.operands))
        return values[id(operand)]

    return value(one)


def roots_of(one: Any, until: Mapping[int, Any]) -> set[int]:
    """The `id` of each parameter that an operand reads, but of none behind those in `until`."""
    found: set[int] = set()
    waiting = [one]
    while waiting:
        operand = waiting.pop()
        if not isinstance(operand, Parameter) or id(operand) in found:
            continue
        found.add(id(operand))
        if id(operand) not in until:
            waiting.extend(operand.operands)
    return found


def given(value: Any) -> Parameter | None:
    """The expression of an argument that is a `Parameter`, or a list with some; otherwise None."""
    if isinstance(value, Parameter):
        return value
    return expression_of(_vector, *value) if _is_list_of(value) else None


def _is_list_of(value: Any) -> bool:
    """Whether it is a list with a `Parameter` in it."""
    return isinstance(value, (list, tuple)) and any(isinstance(one, Parameter) for one in value)


def _vector(*entries: Any) -> Any:
    if all(isinstance(one, (int, float, np.number)) for one in entries):
        return np.array(entries, dtype=float)
    from saltus.tracing.numbers import array

    return array(list(entries))


def _same(value: Any) -> Any:
    return value


def _number(name: str, value: ArrayLike) -> Any:
    try:
        numbers = np.array(value, dtype=float)
    except (TypeError, ValueError) as error:
        raise ModelError(f"Parameter '{name}': expected numbers, found {value!r}") from error
    if numbers.ndim > 1 or not numbers.size or not np.isfinite(numbers).all():
        raise ModelError(
            f"Parameter '{name}': expected a finite number or a vector of them, found {value!r}"
        )
    return numbers if numbers.ndim else float(numbers)


def _forward(function: Callable[..., Any]) -> Callable[..., Parameter]:
    return lambda self, *others: expression_of(function, self, *others)


def _backward(function: Callable[..., Any]) -> Callable[..., Parameter]:
    return lambda self, other: expression_of(function, other, self)


for _name in ("add", "sub", "mul", "truediv", "floordiv", "mod", "pow"):
    setattr(Parameter, f"__{_name}__", _forward(getattr(operator, _name)))
    setattr(Parameter, f"__r{_name}__", _backward(getattr(operator, _name)))
for _name in ("neg", "pos", "abs", "eq", "ne", "lt", "le", "gt", "ge"):
    setattr(Parameter, f"__{_name}__", _forward(getattr(operator, _name)))
