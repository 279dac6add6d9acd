"""Each block of the library has a picture of a run, and the reference shows it."""

import importlib.util
import re
import sys
from pathlib import Path

import numpy as np
import pytest
from saltus import library

pytest.importorskip("matplotlib")

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "docs" / "pictures"


@pytest.fixture(scope="module")
def drawing():
    """docs/pictures/each_block.py, whose neighbours have names that other folders have too."""
    names = ("make", "blocks", "scenes", "style")
    kept = {name: sys.modules.pop(name) for name in names if name in sys.modules}
    sys.path.insert(0, str(FOLDER))
    found = importlib.util.spec_from_file_location("each_block", FOLDER / "each_block.py")
    module = importlib.util.module_from_spec(found)
    found.loader.exec_module(module)
    sys.path.remove(str(FOLDER))
    for name in names:
        sys.modules.pop(name, None)
    sys.modules.update(kept)
    return module


def test_each_block_has_a_picture_and_each_picture_a_block(drawing):
    drawn = {path.stem for path in (FOLDER / "blocks").glob("*.svg")}
    assert drawn == set(drawing.names()) == set(library.__all__) - set(drawing.WITHOUT)


@pytest.mark.parametrize("name", ["Adder", "Relay", "MatrixInversion", "HitCrossing", "Stop"])
def test_a_picture_shows_a_run(drawing, name):
    (axis,) = drawing.figure_of(name).axes
    assert axis.get_title(loc="left").startswith(name)
    black = [line for line in axis.get_lines() if line.get_color() == drawing.INK]
    assert black
    if name == "Adder":  # 2 sin t - 2 sin(t + 2)
        t, y = black[0].get_data()
        np.testing.assert_allclose(y, 2 * np.sin(t) - 2 * np.sin(t + 2), atol=1e-12)
    drawing.plt.close("all")


def test_the_reference_shows_each_picture(site):
    text = (site / "api" / "blocks.html").read_text()
    shown = re.findall(r'src="\.\./pictures/blocks/(\w+)\.svg"', text)
    assert sorted(shown) == sorted(path.stem for path in (FOLDER / "blocks").glob("*.svg"))
    for name in shown:
        assert (site / "pictures" / "blocks" / f"{name}.svg").exists()
        before = text[: text.index(f"blocks/{name}.svg")]
        assert before.rfind(f'id="saltus.library.{name}"') == max(
            m.start() for m in re.finditer(r'id="saltus\.library\.\w+"', before)
        )
