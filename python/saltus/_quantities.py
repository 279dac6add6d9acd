"""What the numbers of a signal are: their units, and the names of modes.

A block says it where it declares its values; the outputs that show these values have it too, and so
have the outputs of diagrams around it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from saltus._core import known_names
from saltus._whole import is_whole
from saltus.errors import ModelError

if TYPE_CHECKING:
    from saltus.ports import OutputPort

__all__ = [
    "NOTHING",
    "Declared",
    "Quantity",
    "mode_names",
    "mode_of",
    "named_states",
    "on_zeno_of",
    "quantity_of",
    "says",
    "shown_twice",
    "units_of",
]


@dataclass(frozen=True)
class Quantity:
    """What a signal shows."""

    units: tuple[str, ...] = ()
    """of each entry, '' of a plain number; none if no unit is known"""
    modes: tuple[str, ...] = ()
    """the names of the modes 0, 1, ..., if it shows a mode"""

    def __bool__(self) -> bool:
        return any(self.units) or bool(self.modes)


NOTHING = Quantity()


@dataclass
class Declared:
    """What a block has said about its states and modes, and which outputs show them."""

    units: tuple[str, ...] = ()
    modes: tuple[str, ...] = ()
    states: tuple[int, ...] = ()
    """positions of the outputs that show a state by its name"""
    whole: tuple[int, ...] = ()
    """positions of the outputs that show all states"""
    mode: tuple[int, ...] = ()
    """positions of the outputs that show the mode"""

    def of(self, output: int) -> Quantity:
        if output in self.states and self.units:
            return Quantity((self.units[self.states.index(output)],))
        if output in self.whole:
            return Quantity(self.units)
        return Quantity(modes=self.modes) if output in self.mode else NOTHING


def quantity_of(port: OutputPort) -> Quantity:
    """What an output shows, as the block declares it that is behind it."""
    system: Any = port.system
    declared: Declared | None = getattr(system, "_declared_quantities", None)
    if declared is not None:
        return declared.of(port.index)
    exported = getattr(system, "_exported", ())  # of a diagram that was made in Python
    return quantity_of(exported[port.index]) if port.index < len(exported) else NOTHING


def says(system: Any) -> bool:
    """Whether a block says units or names of modes, or a block inside a diagram does."""
    declared = getattr(system, "_declared_quantities", None)
    if declared is None:
        return bool(getattr(system, "_says", False))
    return any(declared.units) or bool(declared.modes)


def units_of(what: str, units: Any, size: int) -> tuple[str, ...]:
    """Checked units, one for each state; ModelError."""
    found = _texts(what, "units", units, '["m", "m/s"]')
    if found and len(found) != size:
        raise ModelError(
            f"{what}: units: expected {size}, one for each state, found {len(found)}: "
            f"{', '.join(map(repr, found))}"
        )
    return found


def mode_names(what: str, names: Any) -> tuple[str, ...]:
    """Checked names of modes; ModelError."""
    found = _texts(what, "names", names, '["off", "on"]')
    for i, name in enumerate(found):
        if not name or name in found[:i]:
            how = f"{name!r} is given twice" if name else "a mode has an empty name"
            raise ModelError(f"{what}: names: {how}; each mode has a name of its own")
    return found


def mode_of(what: str, mode: Any, names: tuple[str, ...]) -> Any:
    """The number of a mode that is given by its name; anything else unchanged. ModelError."""
    if not isinstance(mode, str):
        if names and is_whole(mode) and not 0 <= mode < len(names):
            raise ModelError(
                f"{what}: expected a mode from 0 to {len(names) - 1}, which have names, found {mode}"
            )
        return mode
    if mode not in names:
        remedy = "; name the modes first: declare_default_mode(0, names=['off', 'on'])"
        hint = known_names(mode, list(names)) if names else remedy
        raise ModelError(f"{what}: unknown mode {mode!r}{hint}")
    return names.index(mode)


ON_ZENO = ("hold", "stop", "error")


def on_zeno_of(what: str, given: Any, names: tuple[str, ...]) -> Any:
    """`on_zeno` with the number of a mode that is given by its name. ModelError."""
    if isinstance(given, str) and given in ON_ZENO:
        if given in names:
            raise ModelError(
                f"{what}: on_zeno: {given!r} is a choice and the name of a mode; for the mode give "
                f"its number, {names.index(given)}, for the choice rename the mode"
            )
        return given
    if isinstance(given, str) and given not in names:
        known = known_names(given, [*ON_ZENO, *names])
        raise ModelError(f"{what}: unknown on_zeno {given!r}{known}")
    return mode_of(f"{what}: on_zeno", given, names)


def _texts(what: str, key: str, values: Any, example: str) -> tuple[str, ...]:
    if not isinstance(values, (list, tuple)) or not all(isinstance(v, str) for v in values):
        raise ModelError(f"{what}: {key}: expected {example}, found {values!r}")
    return tuple(values)


def named_states(system: Any) -> tuple[int, ...]:
    """The outputs of a block that show states by name."""
    declared: Declared | None = getattr(system, "_declared_quantities", None)
    return () if declared is None else declared.states


def shown_twice(system: Any) -> tuple[int, ...]:
    """The outputs of a block that show all states, where each state has an output of its own."""
    declared: Declared | None = getattr(system, "_declared_quantities", None)
    return declared.whole if declared is not None and declared.states else ()
