"""The fingerprint of 2000 fixed random scenes: `fingerprint.py FILE`, see `./dev fingerprint`.

Each line has the scene, the method, a hash for each part of what the run gave, and the status. The
scene is its number and a hash of its text, so that other scenes are not taken for other results.
"""

from __future__ import annotations

import dataclasses
import hashlib
import json
import math
import sys
from collections.abc import Iterator
from typing import Any

import hypothesis
import numpy as np
import saltus
from draw_scene import scenes
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis.internal.conjecture import providers
from running import Hang, run
from scene import Scene

SCENES = 2000
BY_EACH_METHOD = 400  # of them
METHODS = ("dopri5", "dop853", "adams", "bdf", "radau", "auto")
LIMIT = 60.0  # [s]; a run that meets it gives a line that differs each time


def draw(number: int) -> list[Scene]:
    """The same scenes wherever the package is."""
    # Hypothesis also draws numbers that it finds in the source of modules outside site-packages.
    providers.is_local_module_file = lambda path: False
    drawn: list[Scene] = []

    @hypothesis.seed(20261122)
    @settings(
        max_examples=number,
        database=None,
        deadline=None,
        phases=[Phase.generate],
        suppress_health_check=list(HealthCheck),
    )
    @given(scenes())
    def keep(scene: Scene) -> None:
        drawn.append(scene)

    keep()
    return drawn


def hash_of(*values: Any) -> str:
    """Of lists, texts and numbers: repr gives the digits that make the same bits again."""
    return hashlib.sha256(repr(values).encode()).hexdigest()[:12]


def rows(results: saltus.Results) -> str:
    digest = hashlib.sha256(results.time.tobytes() + results.jump.tobytes())
    for name, column in results.outputs.items():
        digest.update(f"{name} {column.shape} {column.dtype}".encode())
        digest.update(np.ascontiguousarray(column).tobytes())
    return digest.hexdigest()[:12]


def plain(value: Any) -> Any:
    """An array as a list, one NaN for all of them."""
    if isinstance(value, np.ndarray):
        return [plain(entry) for entry in value.tolist()]
    return "nan" if isinstance(value, float) and math.isnan(value) else value


def parts(results: saltus.Results) -> Iterator[str]:
    yield rows(results)
    yield hash_of([tuple(plain(entry) for entry in event) for event in results.events])
    statistics = dataclasses.asdict(results.statistics)
    del statistics["wall_time"]
    yield hash_of(sorted(statistics.items()))
    context = results.context.to_dict()
    continuation = context.pop("continuation", None)
    yield hash_of(json.dumps(context))
    yield hash_of(json.dumps(continuation))
    yield hash_of(results.status, results.message, results.block, repr(results.cause))
    yield results.status


def line(name: str, scene: Scene, method: str) -> str:
    try:
        results = run(scene, limit=LIMIT, ode_solver_method=method)
        found = ["hang"] * 7 if isinstance(results.cause, Hang) else list(parts(results))
    except saltus.ModelError as error:
        found = ["-"] * 5 + [hash_of(str(error)), "refused"]
    return "\t".join([name, method, *found])


def lines(drawn: list[Scene]) -> Iterator[str]:
    for number, scene in enumerate(drawn):
        name = f"fuzz/{number:04} {hash_of(scene)}"
        own = scene.options.get("ode_solver_method", "auto")
        others = METHODS if number < BY_EACH_METHOD else ()
        for method in (own, *(other for other in others if other != own)):
            yield line(name, scene, method)


def main(path: str) -> None:
    with open(path, "w") as file:
        file.writelines(f"{text}\n" for text in lines(draw(SCENES)))


if __name__ == "__main__":
    main(sys.argv[1])
