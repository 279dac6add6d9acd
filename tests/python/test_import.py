"""What `import saltus` brings, and what it does not."""

import subprocess
import sys

import pytest
import saltus

UNWANTED = {
    "matplotlib", "pandas", "xarray", "scipy", "tqdm", "rich", "hypothesis", "pytest",
    "dask", "distributed", "joblib", "libsbml", "numba", "llvmlite", "jax", "torch", "cffi",
    "IPython", "plotly", "PIL",
}  # fmt: skip
# what people do that needs no extra
USES = {
    "simulate": """
scene = saltus.scene("bouncing-ball")
print(scene.simulate(), file=sys.stderr)
""",
    "solve": """
saltus.solve(lambda t, x: -x, (0, 1), [1.0], dense_output=True)(0.5)
""",
    "sweep": """
ball = saltus.scene("bouncing-ball").system
saltus.sweep(ball, {"e": [0.5, 0.6]}, (0, 1), executor="serial", as_dict=True)
""",
    "drawings": """
saltus.drawings.of_scene("two-walls", {"length": 1.0})
""",
    "pictures": """
scene = saltus.scene("bouncing-ball-blocks").system
scene.to_dot(), scene.to_mermaid(), scene._repr_svg_(), scene._repr_markdown_()
""",
    "command line": """
from saltus.cli import main
sys.stdout = sys.stderr
main(["run", "bouncing-ball"])
sys.stdout = sys.__stdout__
""",
}


PACKAGES = ("drawings", "library", "sbml", "scene_files", "simulation")
"""documented packages, which a script uses by their names after `import saltus`"""
LOADED = "print(*{name.split('.')[0] for name in sys.modules})"


def python(code):
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=60
    )
    return done.stdout


def test_nothing_but_numpy_is_imported():
    loaded = set(python(f"import sys, saltus; {LOADED}").split())
    assert "numpy" in loaded
    assert not loaded & UNWANTED


@pytest.mark.parametrize("use", USES)
def test_no_extra_is_imported_before_it_is_used(use):
    loaded = set(python(f"import sys, saltus\n{USES[use]}\n{LOADED}").split())
    assert not loaded & UNWANTED


def test_the_machinery_for_pictures_and_the_command_line_waits_too():
    loaded = python("import sys, saltus; print(*sys.modules)").split()
    for module in ("saltus._picture", "saltus.cli", "saltus.report.chart", "subprocess", "saltus.viewing",
                   "saltus.drawings", "saltus.results.animation", "saltus.results.charts"):  # fmt: skip
        assert module not in loaded, module


@pytest.mark.parametrize("package", PACKAGES)
def test_a_documented_package_needs_no_import_of_its_own(package):
    assert package in saltus.__all__
    assert python(f"import saltus; print(saltus.{package}.__name__)").strip() == f"saltus.{package}"


def test_import_reads_few_files():
    """Reading modules takes most of the time: some 110 of the package, and some of the language."""
    code = (
        "import numpy, sys; before = len(sys.modules); import saltus;"
        "print(len(sys.modules) - before)"
    )
    assert int(python(code)) <= 123


def test_all_names_are_there():
    for name in saltus.__all__:
        assert hasattr(saltus, name)


def test_version():
    assert saltus.__version__.count(".") == 2
