"""How a notebook shows a system: the picture that Graphviz' `dot` draws, or Mermaid text.

Imported when a picture is asked for, not before.
"""

from __future__ import annotations

import functools
import shutil
import subprocess
from collections.abc import Mapping, Sequence

from saltus import _core
from saltus._engine import ports_of
from saltus._signals import signals_in
from saltus.errors import ModelError
from saltus.library.state_machine import StateMachine
from saltus.system import OutputPort, System

__all__ = ["in_markdown", "in_svg", "to_dot", "to_mermaid"]

Recorded = Mapping[str, OutputPort | str] | Sequence[str] | None
TIME_LIMIT = 10.0  # [s] `dot` takes minutes for a thousand blocks; then the text is shown


def to_dot(system: System, signals: Recorded, max_depth: int | None) -> str:
    return _core.to_dot(system, _ports(system, signals), _depth(max_depth))


def to_mermaid(system: System, what: str, signals: Recorded, max_depth: int | None) -> str:
    if what == "modes":
        if signals is not None or max_depth is not None:
            raise ModelError('to_mermaid("modes") takes neither recorded_signals nor max_depth')
        if isinstance(system, StateMachine):
            return _machine(system)
        return _with_mode_names(_core.modes_to_mermaid(system), system)
    if what != "blocks":
        known = _core.known_names(what, ["blocks", "modes"])
        raise ModelError(f"to_mermaid: no picture of '{what}'{known}")
    return _core.to_mermaid(system, _ports(system, signals), _depth(max_depth))


def _with_mode_names(text: str, system: System) -> str:
    """The states of a picture under the names that the block gives its modes."""
    declared = getattr(system, "_declared_quantities", None)
    for mode, name in enumerate(declared.modes if declared else ()):
        text = text.replace(f'state "mode {mode}" as m{mode}\n', _state(mode, name))
    return text


def _machine(machine: StateMachine) -> str:
    """The states of a machine with its transitions, whose zero crossings choose their modes in
    their reset maps, so that the engine does not know where they lead.
    """
    lines = ["stateDiagram-v2\n"]
    lines += [f"  {_state(i, name)}" for i, name in enumerate(machine.states)]
    lines += [f"  [*] --> m{machine._first}\n"]
    lines += [f"  m{i} --> m{j} : {_plain(event)}\n" for event, i, j in machine._arrows]
    return "".join(lines)


def _state(mode: int, name: str) -> str:
    """The line that names a state of a picture, as the engine writes it."""
    return f'state "{_plain(name)}" as m{mode}\n'


def _plain(name: str) -> str:
    """A text for a label, by the rule of the engine."""
    return "".join(_sign(each) for each in name)


def _sign(sign: str) -> str:
    """A character of a label: those that Mermaid may read as something else are entities."""
    if sign.isalnum() or sign >= "\x80" or sign in " .,_-+*/=!?'":
        return sign
    return " " if sign < " " or sign == "\x7f" else f"#{ord(sign)};"


def in_svg(system: System) -> str | None:
    """The picture that `dot` draws; None if `dot` is missing or takes too long."""
    return _drawn(system.to_dot(), shutil.which("dot"))


# A notebook asks twice: for the picture, and for the text in its place.
@functools.lru_cache(maxsize=4)
def _drawn(text: str, dot: str | None) -> str | None:
    if dot is None:
        return None
    try:
        done = subprocess.run(
            [dot, "-Tsvg"],
            input=text.encode(),
            capture_output=True,
            timeout=TIME_LIMIT,
            check=True,
        )
    except (subprocess.SubprocessError, OSError):
        return None
    svg = done.stdout.decode()
    return svg[svg.index("<svg") :]


def in_markdown(system: System) -> str | None:
    """A fence of Mermaid, which JupyterLab draws; None if `dot` draws the picture."""
    if in_svg(system) is not None:
        return None
    text = system.to_mermaid()
    return f"```mermaid\n{text}```\n"  # it has no backtick: backticks of names are entities


def _ports(system: System, signals: Recorded) -> list[tuple[str, System, int]] | None:
    if signals is None:
        return None
    return ports_of(signals_in(system, signals))


def _depth(max_depth: int | None) -> int | None:
    if max_depth is None or (type(max_depth) is int and max_depth >= 0):
        return max_depth
    raise ModelError(f"max_depth: expected a number of levels >= 0, or None, found {max_depth!r}")
