"""What `import saltus` brings, and what it does not."""

import subprocess
import sys

import saltus

UNWANTED = {"matplotlib", "pandas", "xarray", "scipy", "tqdm", "rich", "hypothesis", "pytest"}


def python(code):
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=60
    )
    return done.stdout


def test_nothing_but_numpy_is_imported():
    loaded = set(
        python("import sys, saltus; print(*{name.split('.')[0] for name in sys.modules})").split()
    )
    assert "numpy" in loaded
    assert not loaded & UNWANTED


def test_import_is_quick():
    """Under 0.15 s on top of numpy; the best of five, for other programs run here too."""
    code = (
        "import numpy, time; start = time.perf_counter(); import saltus;"
        "print(time.perf_counter() - start)"
    )
    assert min(float(python(code)) for _ in range(5)) < 0.15


def test_all_names_are_there():
    for name in saltus.__all__:
        assert hasattr(saltus, name)


def test_version():
    assert saltus.__version__.count(".") == 2
