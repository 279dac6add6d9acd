"""Each scene of the shelf has a page that begins with how to run it, and a picture of what happens."""

import importlib.util
import re
import sys
from pathlib import Path

import pytest
import saltus

pytest.importorskip("matplotlib")

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "docs" / "models"
sys.path.insert(0, str(ROOT / "docs" / "site"))

FIRST = """```python
import saltus

results = saltus.scene("{name}").simulate()
print(results.status, f"at t = {{results.time[-1]:.6g}}, {{len(results.events)}} events")
```

```text output about
"""
SHELL = """From the shell:

```sh no-run
saltus run {name} --plot {name}.svg
```

![Recorded signals of the scene]({name}.svg)
"""


@pytest.mark.parametrize("name", saltus.shelf())
def test_a_page_begins_with_the_lines_that_run_its_scene(name):
    text = (FOLDER / f"{name}.md").read_text()
    _, lead, rest = text.split("\n\n", 2)
    assert "```" not in lead and rest.startswith(FIRST.format(name=name))
    assert SHELL.format(name=name) in text
    assert (FOLDER / f"{name}.svg").exists()


def films():
    return sorted([*FOLDER.glob("*.gif"), *FOLDER.glob("course/*.gif")])


def test_what_can_be_drawn_has_a_film():
    moving = {
        name
        for name in saltus.shelf()
        if saltus.drawings.of_scene(name, saltus.scene(name).parameters) is not None
    }
    assert moving == {path.stem for path in FOLDER.glob("*.gif")}
    assert len(films()) > 12


@pytest.mark.parametrize("path", films(), ids=lambda path: path.stem)
def test_a_film_moves_is_small_and_is_on_its_page(path):
    with pytest.importorskip("PIL.Image").open(path) as image:
        first = image.convert("RGB").tobytes()
        image.seek(image.n_frames // 3)
        assert image.n_frames > 40 and image.convert("RGB").tobytes() != first
    assert path.stat().st_size < 150_000  # the gallery shows them all
    assert f"]({path.name})" in path.with_suffix(".md").read_text()


def test_the_gallery_shows_films_where_there_are_some():
    pytest.importorskip("mkdocs")
    import hooks

    cards = hooks.gallery((FOLDER / "README.md").read_text())
    shown = re.findall(r"!\[\]\(([\w/-]+)\.(gif|svg)\)", cards)
    assert {path for path, kind in shown if kind == "gif"} == {
        str(path.relative_to(FOLDER).with_suffix("")) for path in films()
    }
    assert len(shown) > 50
    assert all((FOLDER / f"{path}.{kind}").exists() for path, kind in shown)


def test_a_window_of_a_picture_is_a_few_periods():
    """Of the thermostat four: 1800 s (ln(21/19) + ln(11/9)) = 541 s each."""
    found = importlib.util.spec_from_file_location("shelf_pictures", FOLDER / "make.py")
    make = importlib.util.module_from_spec(found)  # other pages have a make.py too
    found.loader.exec_module(make)
    assert set(make.WINDOW) <= set(saltus.shelf())
    assert 3.5 < make.WINDOW["thermostat"] / 541.4 < 4.5
