"""A header includes its own layer and the layers above it; the engine knows no block and no scene."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[2] / "include" / "saltus"
LAYERS = [
    "base",
    "tape",
    "model",
    "library",
    "plan",
    "solver",
    "simulation",
    "report",
    "models",
]
ENGINE = {"plan", "solver", "simulation"}
INCLUDE = re.compile(r'^\s*#\s*include\s+["<]saltus/([^">]+)[">]', re.M)


def allowed(layer):
    upwards = set(LAYERS[: LAYERS.index(layer) + 1])
    return upwards - {"library", "models"} if layer in ENGINE else upwards


def test_headers_include_upwards_only():
    wrong = [
        f"{header.relative_to(ROOT)} includes {name}"
        for header in ROOT.glob("*/**/*.hpp")
        for name in INCLUDE.findall(header.read_text())
        if name.split("/")[0] not in allowed(header.relative_to(ROOT).parts[0])
    ]
    assert not wrong, "\n".join(sorted(wrong))
