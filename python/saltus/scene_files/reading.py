"""The text of a scene as a tree of tables, lists, text, numbers and truths."""

from __future__ import annotations

import json
import math
import re
from collections import Counter
from pathlib import Path
from typing import Any

from saltus.errors import SceneError
from saltus.scene_files.source import Source
from saltus.scene_files.wrong import Path as Keys
from saltus.scene_files.wrong import Wrong

__all__ = ["read_file", "tree_of"]

MOST_BYTES = 8_000_000  # a hundred thousand blocks; the parser of TOML reads 1 MB in a second
MOST_LEVELS = 64
PART = r"""(?:[A-Za-z0-9_-]+|"[^"\n]*"|'[^'\n]*')[ \t]*\.[ \t]*"""
DEEP_KEY = re.compile(rf"(?<![A-Za-z0-9_-])(?:{PART}){{{MOST_LEVELS}}}")
AT = re.compile(r" ?\(?at line (\d+),? column (\d+)\)?| ?\(at end of document\)")


def read_file(path: Path, shown: str) -> Source:
    """The text of a file. SceneError if it cannot be read, is too long, or is not UTF-8."""
    kind = {".toml": "toml", ".json": "json"}.get(path.suffix.lower())
    if kind is None:
        raise SceneError(f"{shown}: expected a name that ends in .toml or .json", file=shown)
    try:
        with open(path, "rb") as file:
            data = file.read(MOST_BYTES + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise SceneError(f"{shown}: cannot be read: {reason}", file=shown) from None
    return Source(shown, _decoded(data, shown), kind)


def _decoded(data: bytes, shown: str) -> str:
    if len(data) > MOST_BYTES:
        raise SceneError(
            f"{shown}: expected at most {MOST_BYTES // 10**6} MB; a scene of more than a hundred "
            "thousand blocks is better made in Python",
            file=shown,
        )
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data[: error.start].count(b"\n") + 1
        column = error.start - (data.rfind(b"\n", 0, error.start) + 1) + 1
        raise SceneError(
            f"{shown}:{line}:{column}: expected text in UTF-8, found the byte "
            f"0x{data[error.start]:02x}; save the file as UTF-8",
            file=shown, line=line, column=column,
        ) from None  # fmt: skip
    return text.replace("\r\n", "\n")


def tree_of(source: Source) -> dict[str, Any]:
    """The root table of a text. SceneError for a mistake of syntax; Wrong for a tree that no scene
    has.
    """
    read = _json if source.kind == "json" else _toml
    try:
        tree = read(source)
        return _checked(tree)
    except RecursionError:
        raise SceneError(
            f"{source.file}: nested too deeply; expected at most {MOST_LEVELS} levels of tables "
            "and lists",
            file=source.file,
        ) from None


def _toml(source: Source) -> Any:
    if DEEP_KEY.search(source.text):  # the parser's time grows as the square of its length
        raise RecursionError
    try:
        import tomllib  # type: ignore[import-not-found,unused-ignore]  # novm
    except ImportError:  # before Python 3.11
        import tomli as tomllib  # type: ignore[no-redef,import-not-found,unused-ignore]

    try:
        return tomllib.loads(source.text)
    except ValueError as error:  # TOMLDecodeError, and that of a number of 5000 digits
        raise _syntax(source, "TOML", str(error), AT.search(str(error))) from None


def _json(source: Source) -> Any:
    try:
        return json.loads(source.text, object_pairs_hook=_no_key_twice, parse_constant=_no_constant)
    except ValueError as error:
        at = re.search(r": line (\d+) column (\d+) \(char \d+\)", str(error))
        raise _syntax(source, "JSON", str(error), at) from None
    except _Refused as error:
        line, column = _place_of(source.text, error)
        raise SceneError(
            f"{source.file}:{line}:{column}: {error}", file=source.file, line=line, column=column
        ) from None


class _Refused(Exception):
    """A mistake that the parser of JSON does not place, and the pattern of its text."""

    def __init__(self, message: str, pattern: str, times: int):
        super().__init__(message)
        self.pattern, self.times = pattern, times


def _place_of(text: str, error: _Refused) -> tuple[int, int]:
    """Line and column of the place; of a key that stands often, of its second one in the file."""
    found = [match.start() for match in re.finditer(error.pattern, text)][: error.times]
    return _end(text[: found[-1]] if found else text)


def _no_key_twice(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    table = dict(pairs)
    if len(table) < len(pairs):
        twice = Counter(name for name, _ in pairs).most_common(1)[0][0]
        pattern = re.escape(json.dumps(twice, ensure_ascii=False)) + r"\s*:"
        raise _Refused(f"key '{twice}' stands twice in one table; keep one of them", pattern, 2)
    return table


def _no_constant(name: str) -> Any:
    message = f"expected a number, found {name}; an infinite one is written as text, 'inf'"
    raise _Refused(message, rf"(?<![\w\"]){name}(?![\w\"])", 1)


def _syntax(source: Source, what: str, said: str, at: re.Match[str] | None) -> SceneError:
    if at is not None:
        said = said.replace(at[0], "")
    line, column = (int(at[1]), int(at[2])) if at is not None and at[1] else _end(source.text)
    if said == "Cannot overwrite a value":  # the parser says where, and not which key
        key = source.text.split("\n")[line - 1].partition("=")[0].strip()
        said = f"key '{key}' stands twice in one table; keep one of them"
    return SceneError(
        f"{source.file}:{line}:{column}: no {what}: {said[:1].lower()}{said[1:]}",
        file=source.file, line=line, column=column,
    )  # fmt: skip


def _end(text: str) -> tuple[int, int]:
    return text.count("\n") + 1, len(text) - (text.rfind("\n") + 1) + 1


def _checked(tree: Any) -> dict[str, Any]:
    if not isinstance(tree, dict):
        raise Wrong((), f"expected a table with a key 'version', found {type(tree).__name__}")
    return {key: _value((key,), value) for key, value in tree.items()}


def _value(path: Keys, value: Any) -> Any:
    """A value that TOML and JSON share."""
    if len(path) > MOST_LEVELS:
        raise Wrong(path[:4], f"nested too deeply; expected at most {MOST_LEVELS} levels")
    if isinstance(value, dict):
        return {key: _value((*path, key), inner) for key, inner in value.items()}
    if isinstance(value, list):
        return [_value((*path, i), inner) for i, inner in enumerate(value)]
    if isinstance(value, float) and not math.isfinite(value):
        if math.isnan(value):
            raise Wrong(path, "expected a number, found nan")
        return "inf" if value > 0 else "-inf"  # JSON has no infinite number
    if isinstance(value, int) and abs(value) > 2**53:
        raise Wrong(
            path, f"expected a whole number up to 2**53, found one of {value.bit_length()} bits"
        )
    if isinstance(value, (str, int, float)):
        return value
    kind = "null; leave the key out" if value is None else f"a {type(value).__name__}"
    raise Wrong(path, f"expected text, a number, a truth, a list or a table, found {kind}")
