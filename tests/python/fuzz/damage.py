"""Damages what the loaders read: results files, reports, contexts as pickles, dicts and JSON.

A loader answers with a ModelError, or with something that is used as an undamaged one is: rows and
events are read, and a short run goes on from the context. Any other exception is a failure; a crash
and a hang end the process, and the sanitizers see what reads memory of others.

``python tests/python/fuzz/damage.py COUNT [SEED]`` tries COUNT damages and prints how many of each
kind were refused.
"""

from __future__ import annotations

import copy
import io
import json
import random
import sys
import tempfile
import zipfile
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import saltus
from saltus import _core

NASTY: list[Any] = [
    None, True, False, -1, 0, 1, 2, 7, 77, 2**31 - 1, 2**31, -(2**31) - 1, 2**53, 2**62, 2**63 - 1,
    2**63, 2**64, -(2**63), 10**400, 0.5, -0.0, 5e-324, 1e308, -1e308, float("nan"), float("inf"),
    "", "x", "bounce", "\x00", [], [1], [0.0] * 5, [[]], {}, {"x": 1}, "9" * 5000,
]  # fmt: skip
"""values that take the place of one in a record"""


class Ball(saltus.LeafSystem):
    """Bounces, counts, ticks, and has modes: everything that a context may hold."""

    def __init__(self) -> None:
        super().__init__(name="ball")
        self.declare_dynamic_parameter("g", 10.0)
        self.declare_dynamic_parameter("wind", [0.0, 1.0])
        self.declare_continuous_state(
            [1.0, 0.0], ode=lambda t, s, **p: [s.continuous_state[1], -10.0]
        )
        self.declare_discrete_state(default_value=[0.0])
        self.declare_default_mode(1)
        self.declare_continuous_state_output("state")
        self.declare_periodic_update(lambda t, s, **p: s.discrete_state + 1.0, period=0.25)
        self.declare_zero_crossing(
            lambda t, s, **p: s.continuous_state[0],
            lambda t, s, **p: s.with_continuous_state([0.0, -0.5 * s.continuous_state[1]]),
            name="bounce",
            direction="falling",
        )
        self.declare_zero_crossing(lambda t, s, **p: s.continuous_state[1], name="top")


def blocks() -> saltus.System:
    return saltus.scene("bouncing-ball-blocks").system


def delayed_loop() -> saltus.System:
    """x' = -x(t - 0.3): its context holds the past of a signal, with counts and times in it."""
    builder = saltus.DiagramBuilder()
    x = builder.add(saltus.library.Integrator(1.0, name="x"))
    delay = builder.add(
        saltus.library.TransportDelay(0.3, initial_output=1.0, capacity=8, name="delay")
    )
    minus = builder.add(saltus.library.Gain(-1.0, name="minus"))
    for source, sink in ((x, delay), (delay, minus), (minus, x)):
        builder.connect(source.output_ports[0], sink.input_ports[0])
    return builder.build()


class Seed:
    """A system, and what was saved of a run of it."""

    def __init__(self, system: saltus.System, results: saltus.Results, folder: Path):
        self.system = system
        path = folder / "seed.npz"
        results.save(path)
        self.file = path.read_bytes()
        with np.load(path) as parts:
            self.arrays = {name: parts[name] for name in parts.files}
        self.header = json.loads(self.arrays.pop("header").tobytes())
        self.context = results.context
        self.state = as_lists(results.context.__getstate__())
        self.json = results.context.to_json()
        report = saltus.work_precision(
            saltus.scene("bouncing-ball"), methods=["dopri5"], rtols=[1e-4], least_time=0.0
        )
        report.to_json(path)
        self.report = json.loads(path.read_text())


def as_lists(tree: Any) -> Any:
    return json.loads(json.dumps(tree))


def seeds(folder: Path) -> list[Seed]:
    ball = Ball()
    scene = saltus.scene("bouncing-ball-blocks")
    recorded = {"state": ball.output("state")}
    runs = [saltus.simulate(ball, ball.create_context(), (0, 1.2), recorded_signals=recorded)]
    floor = saltus.Guard(
        lambda t, x: x[0], lambda t, x: [0.0, -0.5 * x[1]], "falling", name="floor"
    )
    solution = saltus.solve(lambda t, x: [x[1], -10.0], (0, 1.5), [1.0, 0.0], events=[floor])
    loop = delayed_loop()
    runs += [scene.simulate(), solution, saltus.simulate(loop, (0, 1.0))]
    systems = [ball, scene.system, solution.system, loop]
    return [Seed(system, run, folder) for system, run in zip(systems, runs, strict=True)]


# --- the damages


def damage_bytes(data: bytes, draw: random.Random) -> bytes:
    """A few bytes changed, dropped, doubled, or the rest cut off."""
    damaged = bytearray(data)
    for _ in range(draw.choice([1, 1, 2, 5])):
        at = draw.randrange(len(damaged) + 1)
        kind = draw.randrange(5)
        if kind == 0 and at < len(damaged):
            damaged[at] ^= 1 << draw.randrange(8)
        elif kind == 1 and at < len(damaged):
            damaged[at] = draw.randrange(256)
        elif kind == 2:
            del damaged[at : at + draw.choice([1, 4, 64])]
        elif kind == 3:
            damaged[at:at] = damaged[at : at + draw.choice([1, 8])]
        elif draw.random() < 0.3:
            del damaged[at:]
    return bytes(damaged)


def places(tree: Any) -> list[tuple[Any, Any]]:
    """Every (container, key) in a tree of dicts and lists."""
    found = []
    pending = [tree]
    while pending:
        one = pending.pop()
        items = one.items() if isinstance(one, dict) else enumerate(one)
        for key, value in items:
            found.append((one, key))
            if isinstance(value, (dict, list)):
                pending.append(value)
    return found


def damage_fields(tree: Any, draw: random.Random) -> Any:
    """One or two fields forged, dropped, doubled or swapped."""
    damaged = copy.deepcopy(tree)
    for _ in range(draw.choice([1, 1, 1, 2])):
        container, key = draw.choice(places(damaged))
        kind = draw.randrange(8)
        if kind == 0:
            del container[key]
        elif kind == 1 and isinstance(container, list):
            container.insert(key, copy.deepcopy(container[key]))
        elif kind == 2:
            other, place = draw.choice(places(damaged))
            container[key] = copy.deepcopy(other[place])
        elif kind == 3 and isinstance(container[key], (int, float)):
            container[key] += draw.choice([-1, 1, 0.5])
        else:
            container[key] = copy.deepcopy(draw.choice(NASTY))
    return damaged


def damage_array(array: np.ndarray, draw: random.Random) -> np.ndarray:
    kind = draw.randrange(6)
    if kind == 0:
        return array[: draw.randrange(len(array) + 1)]
    if kind == 1:
        with np.errstate(invalid="ignore", over="ignore"):  # the damage is wanted
            return array.astype(draw.choice([np.int32, np.float32, np.complex128, "U4", bool]))
    if kind == 2:
        return array.reshape(draw.choice([(1, -1), (-1, 1)]))
    if kind == 3:
        return np.asarray(draw.choice(NASTY[:16]), dtype=float if draw.random() < 0.5 else None)
    if kind == 4:
        return array[::-1]
    damaged = np.frombuffer(damage_bytes(array.tobytes(), draw), dtype=np.uint8)
    return damaged[: len(damaged) // 8 * 8].view(float)


def zipped(arrays: dict[str, np.ndarray], header: bytes) -> bytes:
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as archive:
        for name, array in [*arrays.items(), ("header", np.frombuffer(header, dtype=np.uint8))]:
            entry = io.BytesIO()
            np.lib.format.write_array(entry, np.asanyarray(array), allow_pickle=True)
            archive.writestr(f"{name}.npy", entry.getvalue())
    return out.getvalue()


# --- the loaders


def use_results(results: saltus.Results) -> None:
    repr(results), results._repr_html_(), list(results.events), results.statistics
    for name in results.outputs:
        results.outputs[name].sum()
    repr(results.context), results.context.parameters, results.context.to_dict()


def use_context(system: saltus.System, context: _core.Context) -> None:
    repr(context), context.parameters, context.modes
    simulator = saltus.Simulator(system, throw=False, max_major_steps=20, max_passes=20)
    simulator.initialize(context)
    simulator.advance_to(simulator.time + 0.01)
    simulator.context.to_dict()


def load_file(seed: Seed, data: bytes, folder: Path) -> None:
    path = folder / "damaged.npz"
    path.write_bytes(data)
    results = saltus.load_results(path)
    use_results(results)
    use_context(seed.system, results.context)


def tuples(state: Any) -> Any:
    """The tuples of a pickled context where JSON has lists, as far as the damage allows."""
    try:
        (leaves, systems), values = state
        leaves = [(*leaf[:-1], [tuple(p) for p in leaf[-1]]) for leaf in leaves]
        return ((leaves, [tuple(system) for system in systems]), values)
    except (TypeError, ValueError, KeyError, IndexError):
        return tuple(state) if isinstance(state, list) else state


def load_state(seed: Seed, state: Any, folder: Path) -> None:
    context = _core.Context.__new__(_core.Context)
    context.__setstate__(tuples(state))  # type: ignore[attr-defined]
    use_context(seed.system, context)


def load_json(seed: Seed, text: str, folder: Path) -> None:
    use_context(seed.system, seed.system.context_from_json(text))


def load_dict(seed: Seed, data: Any, folder: Path) -> None:
    if isinstance(data, dict):
        use_context(seed.system, _core.context_from_dict(seed.system, data))


def load_report(text: str) -> None:
    report = saltus.WorkPrecision.from_json(text)
    repr(report), report._repr_html_(), report.methods


def some_array_damaged(seed: Seed, draw: random.Random) -> bytes:
    arrays = dict(seed.arrays)
    name = draw.choice(list(arrays))
    arrays[name] = damage_array(arrays[name], draw)
    return zipped(arrays, json.dumps(seed.header).encode())


KINDS: dict[str, Callable[[Seed, random.Random, Path], None]] = {
    "file, bytes": lambda s, d, f: load_file(s, damage_bytes(s.file, d), f),
    "file, array": lambda s, d, f: load_file(s, some_array_damaged(s, d), f),
    "file, field": lambda s, d, f: load_file(
        s, zipped(s.arrays, json.dumps(damage_fields(s.header, d)).encode()), f
    ),
    "file, header": lambda s, d, f: load_file(
        s, zipped(s.arrays, damage_bytes(json.dumps(s.header).encode(), d)), f
    ),
    "pickle": lambda s, d, f: load_state(s, damage_fields(s.state, d), f),
    "dict": lambda s, d, f: load_dict(s, damage_fields(json.loads(s.json), d), f),
    "json": lambda s, d, f: load_json(
        s, damage_bytes(s.json.encode(), d).decode("utf-8", "surrogateescape"), f
    ),
    "report": lambda s, d, f: load_report(json.dumps(damage_fields(s.report, d))),
}


def try_loaders(count: int, seed: int = 0) -> Counter[str]:
    """Tries `count` damages; the same for one seed. Returns how many of each kind were refused."""
    refused: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        saved = seeds(folder)
        for i in range(count):
            kind = list(KINDS)[i % len(KINDS)]
            draw = random.Random(f"{seed} {i}")
            try:
                KINDS[kind](draw.choice(saved), draw, folder)
            except saltus.ModelError:
                refused[kind] += 1
            except Exception as error:
                error.args = (*error.args, f"damage {i} of seed {seed}: {kind}")
                raise
    return refused


if __name__ == "__main__":
    number = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000
    print(dict(try_loaders(number, int(sys.argv[2]) if len(sys.argv) > 2 else 0)))
