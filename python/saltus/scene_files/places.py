"""Line and column of each key and value of a TOML or JSON text.

The parsers of the standard library give no positions, and no well-kept library does. So after a
mistake was found, this module reads the text that they have accepted once more. It only has to know
where keys, strings, tables and lists begin.
"""

from __future__ import annotations

import json
import re

from saltus.scene_files.wrong import Path

__all__ = ["places_of", "start_of_text"]

SPACE = re.compile(r"(?:[ \t\r\n]|#[^\n]*)*")
BARE_KEY = re.compile(r"[A-Za-z0-9_-]+")
SCALAR = re.compile(r"[^,\]}\n#]*")
QUOTES = ('"""', "'''", '"', "'")


def places_of(text: str, kind: str) -> dict[Path, tuple[int, int]]:
    """Where each key (its position) and its value (that with the path (..., "=")) begins, as
    offsets: {path: (key, value)}. Empty for a text that is nested too deeply.
    """
    reader = _Reader(text)
    try:
        if kind == "json":
            reader.value((), 0)
        else:
            reader.document()
    except (RecursionError, IndexError, ValueError):
        pass  # the places found up to there are right
    return reader.places


def start_of_text(text: str, at: int) -> int:
    """The offset of the first character inside of a string that begins at `at`."""
    for quote in QUOTES:
        if text.startswith(quote, at):
            inside = at + len(quote)
            return inside + 1 if len(quote) == 3 and text.startswith("\n", inside) else inside
    return at


class _Reader:
    def __init__(self, text: str):
        self.text = text
        self.at = 0
        self.places: dict[Path, tuple[int, int]] = {}
        self.counts: dict[Path, int] = {}  # of the tables in each [[list]]

    def document(self) -> None:
        """Headers, and keys with values below them."""
        prefix: Path = ()
        while self.space() < len(self.text):
            if self.text[self.at] == "[":
                prefix = self.header()
            else:
                self.pair(prefix)

    def header(self) -> Path:
        begin = self.at
        many = self.text.startswith("[[", begin)
        self.at += 2 if many else 1
        path: Path = ()
        keys = self.keys()
        for i, (key, at) in enumerate(keys):
            path = (*path, key)
            if many and i == len(keys) - 1:
                self.counts[path] = self.counts.get(path, -1) + 1
                self.places.setdefault(path, (at, begin))
            if path in self.counts:
                path = (*path, self.counts[path])
            self.places.setdefault(path, (at, begin))
        self.at = self.text.index("]", self.at) + (2 if many else 1)
        return path

    def pair(self, prefix: Path) -> None:
        path = prefix
        for key, at in self.keys():
            path = (*path, key)
            self.places.setdefault(path, (at, at))
        self.at += 1  # the = or :
        self.value(path, at)

    def keys(self) -> list[tuple[str, int]]:
        """A dotted key: its parts, and where each begins."""
        found = []
        while True:
            begin = self.space()
            quoted = self.text[begin] in "\"'"
            found.append((self.string() if quoted else self.bare(), begin))
            self.space()
            if self.text[self.at] != ".":
                return found
            self.at += 1

    def bare(self) -> str:
        match = BARE_KEY.match(self.text, self.at)
        if match is None:
            raise ValueError
        self.at = match.end()
        return match[0]

    def value(self, path: Path, key: int) -> None:
        begin = self.space()
        self.places[path] = (key, begin)
        first = self.text[begin]
        if first == "[":
            self.members("]", lambda i: self.value((*path, i), self.space()))
        elif first == "{":
            self.members("}", lambda i: self.pair(path))
        elif first in "\"'":
            self.string()
        else:
            match = SCALAR.match(self.text, begin)
            self.at = match.end() if match else begin + 1

    def members(self, end: str, read: object) -> None:
        assert callable(read)
        self.at += 1
        i = 0
        while self.text[self.space()] != end:
            read(i)
            i += 1
            if self.text[self.space()] == ",":
                self.at += 1
        self.at += 1

    def string(self) -> str:
        begin = self.at
        quote = next(q for q in QUOTES if self.text.startswith(q, begin))
        if len(quote) == 3 and self.text.startswith(quote[0] * 2 + ":", begin):
            quote = quote[0]
        self.at += len(quote)
        while not self.text.startswith(quote, self.at):
            self.at += 2 if self.text[self.at] == "\\" and quote[0] == '"' else 1
        inside = self.text[begin + len(quote) : self.at]
        self.at += len(quote)
        while len(quote) == 3 and self.text.startswith(quote[0], self.at):
            self.at += 1  # quotes at the end that belong to the text
        return str(json.loads(f'"{inside}"')) if quote == '"' and "\\" in inside else inside

    def space(self) -> int:
        match = SPACE.match(self.text, self.at)
        assert match is not None
        self.at = match.end()
        return self.at
