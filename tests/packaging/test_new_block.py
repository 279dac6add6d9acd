"""`./dev new-block` writes every place that a block of the library has."""

import ast
import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
COPIED = [
    "dev",
    "tools",
    "bindings",
    "docs/blocks.md",
    "include/saltus/library",
    "src/library",
    "python/saltus",
]


@pytest.fixture
def tree(tmp_path):
    """A copy of what the command reads and writes."""
    for name in COPIED:
        source, copy = ROOT / name, tmp_path / name
        copy.parent.mkdir(parents=True, exist_ok=True)
        if source.is_dir():
            shutil.copytree(source, copy, ignore=shutil.ignore_patterns("*.so", "__pycache__"))
        else:
            shutil.copy(source, copy)
    (tmp_path / "tests" / "unit").mkdir(parents=True)
    return tmp_path


def new_block(tree, *arguments):
    return subprocess.run(
        ["bash", "dev", "new-block", *arguments], cwd=tree, capture_output=True, text=True
    )


GROUPS = sorted(  # the library in C++ has a file of bindings and one in Python for each
    path.stem.removeprefix("bind_")
    for path in (ROOT / "bindings").glob("bind_*.cpp")
    if (ROOT / "python/saltus/library" / f"{path.stem.removeprefix('bind_')}.py").exists()
)


@pytest.mark.parametrize("group", GROUPS)
@pytest.mark.parametrize(("name", "file"), [("HalfWave", "half_wave"), ("Zap", "zap")])
def test_every_place_is_written(tree, name, file, group):
    done = new_block(tree, name, group)
    assert done.returncode == 0, done.stderr
    library = (tree / "include/saltus/library/library.hpp").read_text()
    includes = re.findall(r"library/(\w+)\.hpp", library)
    assert file in includes and includes == sorted(includes)
    assert f"class {name} final" in (tree / f"include/saltus/library/{file}.hpp").read_text()
    assert f"{name}::{name}(" in (tree / f"src/library/{file}.cpp").read_text()
    bindings = (tree / f"bindings/bind_{group}.cpp").read_text()
    assert f'#include "saltus/library/{file}.hpp"' in bindings
    assert bindings.index(f'(module, "{name}")') > bindings.index(f"void bind_{group}")
    package = "python/saltus/library/__init__.py"
    kept = (ROOT / package).read_text().split("]\n")[-1]  # what follows __all__
    assert kept.strip() and (tree / package).read_text().endswith(kept)
    python = ast.parse((tree / f"python/saltus/library/{group}.py").read_text())
    assert name in {node.name for node in python.body if isinstance(node, ast.ClassDef)}
    assert f"Bench<{name}>" in (tree / f"tests/unit/library_{file}_test.cpp").read_text()
    sections = (tree / "docs/blocks.md").read_text().split("\n## ")
    tables = [text.split("\n\n")[1] for text in sections]  # the first of each section
    (table,) = [each for each in tables if f"\n| `{name}` |" in each]
    others = set(re.findall(r"py::class_<(\w+), System>", bindings)) - {name}
    assert any(f"\n| `{other}`" in table for other in others)


def test_the_package_and_its_stub_name_the_block_in_order(tree):
    assert new_block(tree, "HalfWave").returncode == 0
    init = ast.parse((tree / "python/saltus/library/__init__.py").read_text())
    names = {
        alias.name for node in init.body if isinstance(node, ast.ImportFrom) for alias in node.names
    }
    (listed,) = (ast.literal_eval(node.value) for node in init.body if isinstance(node, ast.Assign))
    assert listed == sorted(names, key=lambda name: (not name.isupper(), name))
    assert "HalfWave" in listed
    stub = ast.parse((tree / "python/saltus/_core.pyi").read_text())
    assert "HalfWave" in {node.name for node in stub.body if isinstance(node, ast.ClassDef)}


@pytest.mark.parametrize("name", ["Gain", "half_wave", "Half-Wave", ""])
def test_a_name_that_is_taken_or_is_none_changes_nothing(tree, name):
    before = {path: path.read_text() for path in tree.rglob("*.*pp")}
    done = new_block(tree, name)
    assert done.returncode != 0
    assert "Gain" in done.stderr or "DeadZone" in done.stderr
    assert {path: path.read_text() for path in tree.rglob("*.*pp")} == before
