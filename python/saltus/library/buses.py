"""Buses: signals with names that go together through one wire, a vector."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from saltus import _core
from saltus.errors import ModelError
from saltus.library.block import Block

__all__ = ["BusCreator", "BusSelector"]


def _layout(block: str, signals: Any) -> list[tuple[str, int | None]]:
    """The names of the signals of a bus and their widths, None for a scalar; those of a bus within
    it go on with a dot.
    """
    if isinstance(signals, BusCreator):
        return signals.layout
    if isinstance(signals, str) or not isinstance(signals, (Mapping, Sequence)):
        raise ModelError(
            f"block '{block}': expected a list of names, names with widths, or a BusCreator, found "
            f"{signals!r}"
        )
    if not isinstance(signals, Mapping):
        return [(str(name), None) for name in signals]
    found: list[tuple[str, int | None]] = []
    for name, width in signals.items():
        if width is None or (isinstance(width, int) and not isinstance(width, bool)):
            found.append((str(name), width))
        else:
            found += [(f"{name}.{part}", n) for part, n in _layout(block, width)]
    return found


class BusCreator(Block, _core.BusCreator):
    """bus = (u_0, u_1, ...): the inputs, one after the other, as one vector whose parts have names.

    The inputs have the names of the signals. `BusSelector` takes signals out of it again.

    Parameters
    ----------
    signals
        A list of names, each of a number; or name -> width, None for a number, n for a vector of n,
        or another `BusCreator`, a list or names with widths for a bus within the bus, which is one
        input.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If there is no signal, or a name is there twice.

    Examples
    --------
    >>> from saltus.library import BusCreator
    >>> bus = BusCreator({"speed": None, "rates": 3})
    >>> saltus.response(bus, 1.0, [2.0, 3.0, 4.0])
    array([1., 2., 3., 4.])
    """

    def __init__(self, signals: Sequence[str] | Mapping[str, Any], *, name: str | None = None):
        called = self._named(name)
        layout = _layout(called, signals)
        super().__init__(called, layout)
        self._layout = layout

    @property
    def layout(self) -> list[tuple[str, int | None]]:
        """The names of all signals and their widths, None for a number."""
        return list(self._layout)


class BusSelector(Block, _core.BusSelector):
    """y_k = the signal of a bus that has the k-th of some names.

    The outputs have these names, with `_` for a dot. Each reads the entries of its signal only.

    Parameters
    ----------
    bus
        The `BusCreator` of the bus, or what that was made with.
    names
        The chosen signals; "imu.rates" is the signal `rates` of the bus `imu` within the bus, and
        "imu" all of that bus.
    name
        The name in messages, in contexts and for `diagram[...]`; by default its class and number.

    Raises
    ------
    ModelError
        If the bus has no signal of a name, with the nearest one.

    Examples
    --------
    >>> from saltus.library import BusCreator, BusSelector
    >>> bus = BusCreator({"speed": None, "imu": {"rates": 3, "heat": None}})
    >>> saltus.response(BusSelector(bus, ["imu.heat", "speed"]), [1.0, 2.0, 3.0, 4.0, 5.0])
    (5.0, 1.0)
    """

    def __init__(
        self,
        bus: BusCreator | Sequence[str] | Mapping[str, Any],
        names: Sequence[str],
        *,
        name: str | None = None,
    ):
        called = self._named(name)
        chosen = [names] if isinstance(names, str) else [str(each) for each in names]
        super().__init__(called, _layout(called, bus), chosen)
