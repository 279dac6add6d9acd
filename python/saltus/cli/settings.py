"""`--set NAME=VALUE`, and the options that every run has."""

from __future__ import annotations

import argparse
import ast
from typing import Any

from saltus.errors import ModelError
from saltus.options import atol_beside

__all__ = ["add_options", "add_scene", "add_span", "options_of", "recorded_of", "settings_of"]


def add_scene(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "scene",
        metavar="SCENE",
        help="a name of `saltus list`; a file, scene.toml; or file.py:name or module:name of a "
        "system, or of a function that makes one",
    )
    parser.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="a parameter of the scene, an argument of the function, or an initial state: e=0.9, "
        "ball.g=1.62, 'x[0]=5', 'x=[5,0]'; as often as wanted",
    )


def add_span(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--t-begin", type=float, metavar="T", help="[s] 0 if not said")
    parser.add_argument(
        "--t-end", "--until", type=float, metavar="T", help="[s] that of the scene if not said"
    )


def add_options(parser: argparse.ArgumentParser) -> None:
    add_span(parser)
    parser.add_argument(
        "--method", metavar="NAME", help="auto, dopri5, dop853, adams, bdf, radau or taylor"
    )
    parser.add_argument(
        "--rtol",
        type=_tolerance,
        metavar="TOL",
        help="relative tolerance of a step: a number, or one for each state: 1e-6,1e-9",
    )
    parser.add_argument(
        "--atol",
        type=_tolerance,
        metavar="TOL",
        help="absolute tolerance, likewise; by default that of the scene file, or rtol/100",
    )
    parser.add_argument("--zeno-tolerance", type=float, metavar="T", help="[s] 0: no Zeno holds")
    parser.add_argument(
        "--option",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="any other option of saltus.SimulatorOptions, such as max_major_steps=1000",
    )


FLAGS = {
    "ode_solver_method": "--method",
    "rtol": "--rtol",
    "atol": "--atol",
    "zeno_tolerance": "--zeno-tolerance",
    "save_at": "--save-at",
    "recorded_signals": "--record",
}
"""options that have a flag of their own"""


def options_of(chosen: argparse.Namespace, writes_atol: bool = False) -> dict[str, Any]:
    """The options that the command line gives, by the names of SimulatorOptions. Without `--atol`
    it is rtol/100, unless the scene file `writes_atol`.
    """
    options: dict[str, Any] = {
        "ode_solver_method": chosen.method,
        "rtol": chosen.rtol,
        "atol": chosen.atol,
        "zeno_tolerance": chosen.zeno_tolerance,
    }
    said = {name: value for name, value in options.items() if value is not None}
    more = settings_of(chosen.option, "--option")
    for name, flag in FLAGS.items():
        if name in more and getattr(chosen, flag[2:].replace("-", "_"), None) is not None:
            raise ModelError(f"--option: '{name}' is set by {flag} too; leave out one of them")
    said |= more
    if isinstance(said.get("rtol"), (int, float, list)) and "atol" not in said and not writes_atol:
        said["atol"] = atol_beside(said["rtol"])
    return said


def recorded_of(names: list[str] | None) -> tuple[str, ...]:
    """The names of `--record`, each once."""
    names = names or []
    for name in names:
        if names.count(name) > 1:
            raise ModelError(f"--record: '{name}' is given twice; keep one of them")
    return tuple(names)


def _tolerance(text: str) -> float | list[float]:
    try:
        numbers = [float(part) for part in text.split(",")]
    except ValueError:
        raise argparse.ArgumentTypeError(
            f"expected a number, or one for each state, 1e-6,1e-9, found '{text}'"
        ) from None
    return numbers if len(numbers) > 1 else numbers[0]


def settings_of(settings: list[str], flag: str = "--set") -> dict[str, Any]:
    """NAME=VALUE as a dict. A value is a number, a list of numbers, True, False, None or text."""
    found: dict[str, Any] = {}
    for setting in settings:
        name, equals, text = setting.partition("=")
        name = name.strip()
        if not equals or not name:
            raise ModelError(f"{flag}: expected NAME=VALUE, found '{setting}'")
        if name in found:
            raise ModelError(f"{flag}: '{name}' is set twice")
        found[name] = _value(text.strip())
    return found


def _value(text: str) -> Any:
    try:
        return ast.literal_eval(text)
    except (ValueError, SyntaxError, MemoryError, RecursionError):
        pass
    try:
        return float(text)  # 1e-3 is a literal; inf and nan are not
    except ValueError:
        return text
