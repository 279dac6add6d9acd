"""A file includes its own layer and the layers above it, and names no class of a lower one; the
engine knows no block and no scene; a public header needs no header of another layer's detail/
unless it is listed here.
"""

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
HEADERS = ROOT / "include" / "saltus"
SOURCES = ROOT / "src"
LAYERS = [
    "base",
    "tape",
    "model",
    "library",
    "plan",
    "solver",
    "simulation",
    "analysis",
    "report",
    "models",
]
ENGINE = {"plan", "solver", "simulation"}
INCLUDE = re.compile(r'^\s*#\s*include\s+["<]saltus/([^">]+)[">]', re.M)
FORWARD = re.compile(r"^(?:class|struct)\s+(\w+);", re.M)
DEFINED = re.compile(r"^(?:class|struct)\s+(\w+)(?:\s+final)?\s*(?::[^;{]*)?\{", re.M)
# Results are read through a machine of their own: the one place where a public header has to
# include headers that no user includes.
READ_THROUGH = {"simulation/dense_output.hpp"}
# Names that a higher layer only passes on, and never looks into: an error carries the partial
# results of its run, and a callback is called with the block that it belongs to.
PASSED_ON = {"Results", "LeafSystem"}


def layer_of(path):
    root = HEADERS if path.is_relative_to(HEADERS) else SOURCES
    return path.relative_to(root).parts[0]


def files():
    found = [*HEADERS.glob("*/**/*.hpp"), *SOURCES.glob("*/**/*.hpp"), *SOURCES.glob("*/**/*.cpp")]
    return [path for path in found if path.parent != HEADERS]


def allowed(layer):
    upwards = set(LAYERS[: LAYERS.index(layer) + 1])
    return upwards - {"library", "models"} if layer in ENGINE else upwards


def test_files_include_upwards_only():
    wrong = [
        f"{path.relative_to(ROOT)} includes {name}"
        for path in files()
        for name in INCLUDE.findall(path.read_text())
        if name.split("/")[0] not in allowed(layer_of(path))
    ]
    assert not wrong, "\n".join(sorted(wrong))


def test_no_class_of_a_lower_layer_is_named():
    home = {name: layer_of(path) for path in files() for name in DEFINED.findall(path.read_text())}
    wrong = [
        f"{path.relative_to(ROOT)} declares {name} of {home[name]}"
        for path in files()
        for name in FORWARD.findall(path.read_text())
        if name in home.keys() - PASSED_ON and home[name] not in allowed(layer_of(path))
    ]
    assert not wrong, "\n".join(sorted(wrong))


def test_public_headers_include_no_detail_of_another_layer():
    wrong = [
        f"{path.relative_to(HEADERS)} includes {name}"
        for path in HEADERS.glob("*/*.hpp")
        if str(path.relative_to(HEADERS)) not in READ_THROUGH
        for name in INCLUDE.findall(path.read_text())
        if "/detail/" in name and name.split("/")[0] != layer_of(path)
    ]
    assert not wrong, "\n".join(sorted(wrong))
