"""One run of a random scene, under a clock."""

from __future__ import annotations

import contextlib
import faulthandler
import signal
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import saltus
from scene import Scene, build, signals

LIMIT = 5.0  # [s] of this process; a scene takes 10 ms
LAST = Path(__file__).parents[3] / "build" / "fuzz_last.txt"


class Hang(Exception):
    """A run has had its time."""


def stop(number: int, frame: Any) -> None:
    raise Hang


@contextlib.contextmanager
def watched(scene: Scene, limit: float) -> Iterator[None]:
    """Raises Hang in the next callback, or where the engine asks for signals. A crash, or a hang
    that does neither, leaves the scene in a file.
    """
    LAST.parent.mkdir(exist_ok=True)
    LAST.write_text(f"{scene!r}\n")
    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, limit)
    faulthandler.dump_traceback_later(20 * limit, exit=True)
    try:
        with np.errstate(all="ignore"):
            yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)
        faulthandler.cancel_dump_traceback_later()


def run(
    scene: Scene,
    record: bool = True,
    nested: bool = False,
    limit: float = LIMIT,
    **overrides: Any,
) -> saltus.Results:
    diagram = build(scene)
    recorded = signals(diagram) if record else {}
    if nested:
        outside = saltus.DiagramBuilder()
        outside.add(diagram)
        diagram = outside.build()
    options = scene.options | {"throw": False} | overrides
    with watched(scene, limit):
        return saltus.simulate(
            diagram, diagram.create_context(), scene.span, recorded_signals=recorded, **options
        )


def run_in_pieces(
    scene: Scene, times: list[float], limit: float = LIMIT, **overrides: Any
) -> saltus.Results:
    diagram = build(scene)
    options = scene.options | {"throw": False} | overrides
    simulator = saltus.Simulator(diagram, recorded_signals=signals(diagram), **options)
    with watched(scene, limit):
        simulator.initialize(diagram.create_context(scene.span[0]))
        for t in [*times, scene.span[1]]:
            if simulator.advance_to(t) != "reached_end":
                break
    return simulator.results
