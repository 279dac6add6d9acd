"""A damaged file is a scene still, which is written and read again, or a ModelError; no other."""

import json
import random

import pytest
import saltus
from file_models import FILES
from saltus.scene_files import dumps, loads

PIECES = [
    '"', "{", "}", "[", "]", "=", "->", ".", "\n", "\0", "\\", "ä", "true", "nan", "inf", "-1", "0",
    "1e400", '""', '"t"', "[]", "{}", "[x]", "[[x]]", '"((("', '"u[0]"', '"x[9]"', "2020-01-01",
]  # fmt: skip
VALUES = [
    None, True, 0, -1, 2.5, 1e308, 1e-320, 10**20, "", "x", "t", "-g", "1/0", "falling", "Gain", [],
    [1, 2], [[1], [2, 3]], {}, {"a": 1},
]  # fmt: skip


def damaged_text(text, draw):
    begin = draw.randrange(len(text))
    end = begin + draw.choice([0, 1, 5])
    return text[:begin] + draw.choice(["", *PIECES]) + text[end:]


def places(tree):
    """Each (container, key) in a tree."""
    if isinstance(tree, (dict, list)):
        for key in tree if isinstance(tree, dict) else range(len(tree)):
            yield tree, key
            yield from places(tree[key])


def damaged_tree(text, draw):
    tree = json.loads(text)
    container, key = draw.choice(list(places(tree)))
    container[key] = draw.choice(VALUES)
    return json.dumps(tree)


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
@pytest.mark.parametrize("kind", ["toml", "json"])
def test_a_damaged_file_is_refused_or_is_a_scene(file, kind):
    draw = random.Random(f"{file.stem} {kind}")
    text = dumps(saltus.load_scene(file), kind)
    damaged = damaged_text if kind == "toml" else damaged_tree
    refused = 0
    for _ in range(10):
        try:
            scene = loads(damaged(text, draw), kind)
        except saltus.ModelError as error:
            assert str(error)
            refused += 1
        else:
            assert loads(dumps(scene)) == scene
    assert refused  # some damage is not in a title
