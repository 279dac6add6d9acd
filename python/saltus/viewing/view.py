"""`view`: a run of a scene, or of a system, as a page."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable
from os import PathLike
from pathlib import Path
from typing import Any

from saltus._core import Context
from saltus.errors import ModelError
from saltus.results import Results
from saltus.results.tables import extra
from saltus.scenes import Scene, load_scene, scene, shelf
from saltus.simulation import simulate
from saltus.system import System
from saltus.viewing.page import page_of

__all__ = ["made_page", "view", "view_results", "written"]

LENGTH = 10.0  # [s] of the film, if it is not as long as the run
SHORTEST = 4.0  # [s] of the film; a shorter run is slowed down
FPS = 20.0
SUFFIXES = (".html", ".htm")
FILES = (".toml", ".json")


def view(
    what: Any,
    t_span: tuple[float, float] | None = None,
    path: str | PathLike[str] | None = None,
    *,
    context: Context | None = None,
    draw: Callable[..., Any] | None = None,
    speed: float | None = None,
    title: str = "",
    browse: bool | None = None,
    **options: Any,
) -> Path:
    """Runs a scene, writes one page of HTML about it, and opens it in the browser.

    The page has the film if there is a drawing, the plots, the diagram, the events and the counts.
    It is one file: no network, and no script from elsewhere. Needs matplotlib.

    Parameters
    ----------
    what : str, Scene, FileScene, System or Results
        The name of a scene of the shelf, or of a scene file; or the scene, the system, or the
        results of a run.
    t_span : (float, float), optional
        Begin and end [s]; a system needs it.
    path : str or path, optional
        The file, '.html'; by default one in a temporary folder.
    context : Context, optional
        The values at the begin.
    draw : callable, optional
        As in `Results.animate`; mechanical scenes of the shelf have one of their own.
    speed : float, optional
        [s of the run per s of the film] by default such that the film takes 4 to 10 s.
    title : str
        By default the name of the scene.
    browse : bool, optional
        Whether to open the page; by default if there is no `path`.
    **options
        Options of the run, such as ``rtol=1e-9``.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    ModelError
        If a name is unknown, or a system has no span.
    ImportError
        If matplotlib is not installed.

    Examples
    --------
    >>> import pathlib, tempfile, saltus
    >>> file = pathlib.Path(tempfile.mkdtemp(), "cradle.html")
    >>> saltus.view("newtons-cradle", path=file).exists()
    True
    """
    if isinstance(what, Results):
        given = {"t_span": t_span, "context": context, **options}
        for name, value in given.items():
            if value is not None:
                raise ModelError(f"view: {name}: these results come from a run that is over")
        text = made_page(what, _system_of(what), title, "", draw, speed)
        return written(text, path, browse)
    target = _target(path)  # refuses a wrong name before a run
    chosen = _scene_of(what)
    system = chosen if isinstance(chosen, System) else chosen.system
    results = _run(chosen, t_span, context, options)
    if draw is None and isinstance(chosen, Scene):
        from saltus.drawings import of_scene

        draw = of_scene(chosen.name, chosen.parameters)
    subtitle = "" if isinstance(chosen, System) else chosen.title
    text = made_page(results, system, title or chosen.name, subtitle, draw, speed)
    return written(text, target, browse if browse is not None else path is None)


def view_results(
    results: Results,
    path: str | PathLike[str] | None,
    draw: Callable[..., Any] | None,
    system: System | None,
    title: str,
    browse: bool | None,
) -> Path:
    """Writes the page for `Results.view`."""
    target = _target(path)
    text = made_page(results, system or _system_of(results), title, "", draw, None)
    return written(text, target, browse if browse is not None else path is None)


def _system_of(results: Results) -> System | None:
    """The system of a run, where the results know it."""
    known = getattr(results, "system", None) or results._asks
    return known if isinstance(known, System) else None


def _scene_of(what: Any) -> Any:
    """A scene or a system."""
    if isinstance(what, (str, os.PathLike)):
        name = os.fspath(what)
        if str(name).lower().endswith(FILES) or (name not in shelf() and os.path.exists(name)):
            return load_scene(name)
        return scene(str(name))
    if isinstance(what, System) or all(hasattr(what, n) for n in ("system", "context", "t_span")):
        return what
    raise ModelError(
        "view: expected the name of a scene, a scene file, a system or results, found "
        f"{type(what).__name__}"
    )


def _run(
    chosen: Any, t_span: tuple[float, float] | None, context: Context | None, options: Any
) -> Results:
    """The run that is shown, also if it ends badly: its page says so."""
    usual = {"dense_output": True, "throw": False}
    if isinstance(chosen, System):
        if t_span is None:
            raise ModelError("view: a system has no end of its run: give t_span=(0.0, 10.0), in s")
        start = context if context is not None else chosen.create_context(t_span[0])
        return simulate(chosen, start, t_span, **usual | options)
    span = t_span if t_span is not None else chosen.t_span
    if span is None:
        raise ModelError(f"view: scene '{chosen.name}' says no end of the run: give t_span")
    start = context if context is not None else chosen.context
    return simulate(chosen.system, start, span, chosen.options, **usual | options)


def made_page(
    results: Results,
    system: System | None,
    title: str,
    subtitle: str,
    draw: Callable[..., Any] | None,
    speed: float | None,
) -> str:
    """The page about a run."""
    film = None if draw is None else _film(results, draw, speed)
    name = title or (system.name if system is not None else "") or "run"
    return page_of(name, subtitle, results, system, film)


def _film(results: Results, draw: Callable[..., Any], speed: float | None) -> str:
    """The player of the film, with the length that suits a page."""
    begin, end = results.span if results.dense else (results.time[0], results.time[-1])
    length = min(max(end - begin, SHORTEST), LENGTH)
    usual = (end - begin) / length if end > begin else 1.0
    animation = results.animate(draw, speed=usual if speed is None else speed, fps=FPS)
    shown = (end - begin) / ((len(animation.film) - 1) / FPS) if len(animation.film) > 1 else 1.0
    text = animation.to_jshtml()
    extra("matplotlib.pyplot", "view").close(animation.figure)
    return f'{text}<p class="quiet">One second of the film is {shown:.3g} s of the run.</p>'


def _target(path: str | PathLike[str] | None) -> Path | None:
    if path is None:
        return None
    if Path(path).suffix.lower() not in SUFFIXES:
        raise ModelError(f"view: expected a name that ends in .html, found '{os.fspath(path)}'")
    return Path(path)


def written(text: str, path: str | PathLike[str] | None, browse: bool | None) -> Path:
    """Writes a page, and opens it; by default only one without a `path`."""
    target = _target(path) or Path(tempfile.mkdtemp(prefix="saltus-"), "run.html")
    target.write_text(text, encoding="utf-8")
    if browse or (browse is None and path is None):
        import webbrowser

        webbrowser.open(target.resolve().as_uri())
    return target
