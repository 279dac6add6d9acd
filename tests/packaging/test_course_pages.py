"""Each model of examples/scenes has a page with a picture, which says what the model does now."""

import sys
from pathlib import Path

import pytest

pytest.importorskip("tomllib")
pytest.importorskip("matplotlib")

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "docs" / "models" / "course"
MODELS = sorted(path.stem for path in (ROOT / "examples" / "scenes").glob("*.py"))
sys.path.insert(0, str(FOLDER))

import make  # noqa: E402


def test_each_model_has_its_texts_and_each_text_a_model():
    assert sorted(make.TEXTS) == MODELS


@pytest.mark.parametrize("name", MODELS)
def test_a_page_is_what_its_model_gives(name):
    """`python docs/models/course/make.py NAME` writes it again."""
    assert (FOLDER / f"{name}.md").read_text() == make.page(name)


@pytest.mark.parametrize("name", MODELS)
def test_a_picture_shows_each_panel(name):
    text = (FOLDER / f"{name}.svg").read_text()
    for panel in make.TEXTS[name]["panels"]:
        for word in [panel["x"], panel["y"]] if "x" in panel else [panel["label"]]:
            assert word in text


@pytest.mark.parametrize("name", MODELS)
def test_a_model_is_in_the_gallery(name):
    assert f"(course/{name}.md)" in (FOLDER.parent / "README.md").read_text()


def test_parameters_have_the_units_of_their_comments():
    text = "[systems.a.parameters]\ng = 9.81  # [m/s^2] gravity\nk = [1, 2]\n[states]\nx = 1\n"
    assert list(make.parameters(text)) == [
        "| `g` | 9.81 | m/s^2 | gravity |",
        "| `k` | [1, 2] |  |  |",
    ]
