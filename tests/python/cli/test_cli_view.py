"""`saltus view`."""

from pathlib import Path

import pytest
from saltus.cli import main

ROOT = Path(__file__).parents[3]

pytest.importorskip("matplotlib")
CART = "examples/scenes/inverted_pendulum.toml"


@pytest.fixture
def browser(monkeypatch):
    import webbrowser

    opened = []
    monkeypatch.setattr(webbrowser, "open", lambda address: opened.append(address) or True)
    return opened


def test_it_writes_a_page_and_opens_none(tmp_path, capsys, browser):
    page = tmp_path / "ball.html"
    assert main(["view", "bouncing-ball", "--t-end", "3", "--set", "e=0.5", "-o", str(page)]) == 0
    assert capsys.readouterr().out == f"{page}\n"
    text = page.read_text(encoding="utf-8")
    assert "<h2>Film</h2>" in text and "0 to 3 s" in text
    assert browser == []


def test_without_a_file_it_opens_the_page(capsys, browser):
    assert main(["view", "thermostat", "--draw", "none"]) == 0
    (address,) = browser
    assert address.endswith(capsys.readouterr().out.strip())


def test_a_drawing_by_name_with_arguments(tmp_path):
    page, scene = tmp_path / "cart.html", str(ROOT / CART)
    drawing = "pendulum_on_cart:place=0,angle=state[2],length=0.4"
    words = ["view", scene, "--until", "0.5", "--draw", drawing, "-o", str(page)]
    assert main(words) == 0
    assert "<h2>Film</h2>" in page.read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["bouncing-ball", "-o", "x.png"], "--output: expected a name that ends in .html"),
        (["bouncing-ball", "--draw", "bal"], "no drawing 'bal'; did you mean 'ball'"),
        (["bouncing-ball", "--draw", "ball:sise=3"], "unexpected keyword argument 'sise'"),
        (["bouncing-ball", "--draw", "ball:3"], "--draw: expected NAME=VALUE, found '3'"),
        (["bouncing-ball", "--speed", "0"], "speed: expected a number above 0"),
        (["bouncing-ball", "--option", "throw=True"], "--option throw: leave it out"),
        (["no-such-scene"], "no scene 'no-such-scene' on the shelf"),
    ],
)
def test_wrong_use_is_one_line_and_code_2(tmp_path, capsys, words, says):
    place = [] if "-o" in words else ["-o", str(tmp_path / "x.html")]
    assert main(["view", *words, *place]) == 2
    error = capsys.readouterr().err
    assert says in error and error.count("\n") == 1
