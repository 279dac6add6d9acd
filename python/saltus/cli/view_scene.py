"""saltus view: one page with the film, plots, diagram and events of a run, opened in the browser.

saltus view newtons-cradle
saltus view bouncing-ball --set e=0.7 -o ball.html
saltus view cart.toml --draw pendulum_on_cart:place=0,angle=2
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from saltus._status import WELL
from saltus.cli.files import require_suffix
from saltus.cli.scene_of import Chosen, chosen_scene
from saltus.cli.settings import add_options, add_scene, options_of, settings_of
from saltus.errors import ModelError
from saltus.scenes import scene as shelf_scene
from saltus.scenes import shelf

__all__ = ["act", "add_arguments"]

NAME = "view"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_scene(parser)
    add_options(parser)
    parser.add_argument(
        "-o", "--output", type=Path, metavar="FILE", help="writes the page, .html, and opens none"
    )
    parser.add_argument(
        "--draw",
        metavar="NAME[:ARG=VALUE,...]",
        help="a drawing of saltus.drawings, or 'none'; mechanical scenes of `saltus list` have one",
    )
    parser.add_argument("--speed", type=float, metavar="S", help="[s of the run per s of the film]")


def act(chosen: argparse.Namespace) -> int:
    require_suffix("--output", chosen.output, ".html", ".htm")
    scene = chosen_scene(chosen.scene, settings_of(chosen.set))
    scene = scene.with_span(chosen.t_begin, chosen.t_end)
    span, overrides = scene.required_span(), options_of(chosen, scene.writes_atol)
    for name in ("throw", "dense_output"):
        if name in overrides:
            raise ModelError(f"--option {name}: leave it out; a page has its own")
    _without_a_window()
    page, well = _written(chosen, scene, span, overrides)
    print(page)
    return 0 if well else 1


def _without_a_window() -> None:
    from saltus.results.tables import extra

    extra("matplotlib", "view", ", or install Saltus with the extra [plot]").use("Agg")


def _written(
    chosen: argparse.Namespace, scene: Chosen, span: tuple[float, float], overrides: dict[str, Any]
) -> tuple[Path, bool]:
    """The page, and whether the run ended well."""
    from saltus.simulation import simulate
    from saltus.viewing.view import made_page, written

    results = simulate(
        scene.system, scene.context, span, scene.options,
        **{"dense_output": True, "throw": False} | overrides,
    )  # fmt: skip
    if results.status == "interrupted":
        raise KeyboardInterrupt
    if results.status not in WELL:
        print(f"saltus view: {results.status}: {results.message}", file=sys.stderr)
    draw = _drawing(chosen.draw, scene, settings_of(chosen.set))
    text = made_page(results, scene.system, scene.name, scene.title, draw, chosen.speed)
    return written(text, chosen.output, chosen.output is None), results.status in WELL


def _drawing(
    said: str | None, scene: Chosen, settings: dict[str, Any]
) -> Callable[..., Any] | None:
    from saltus.drawings.of_scene import by_name

    if said == "none":
        return None
    if said is None:
        return _usual(scene, settings)
    name, _, rest = said.partition(":")
    return by_name(name, settings_of([part for part in rest.split(",") if part], "--draw"))


def _usual(scene: Chosen, settings: dict[str, Any]) -> Callable[..., Any] | None:
    """The drawing of a scene of the shelf, with the parameters that were set."""
    from saltus.drawings.of_scene import of_scene

    if scene.file is not None or scene.name not in shelf():
        return None
    usual = shelf_scene(scene.name).parameters
    return of_scene(scene.name, usual | {n: v for n, v in settings.items() if n in usual})
