"""The fences of the documents as programs: what the tests run and the pictures are drawn from.

In the line that opens a fence, after the language:

- `continue` puts the fence after the one before it in the same language;
- `picture=FILE` says that the last figure it makes is that picture, `drawing=FILE` that Graphviz's
  of its `system` is, `animation=FILE` that a GIF of its `animation` is;
- `beside=FOLDER` runs it beside the scene files of that folder of the checkout;
- `needs=PACKAGE` says what it imports beyond what `./dev test` installs; without it the test skips;
- `no-run` is for shell text only: Python and C++ shown to readers must run.

A fence ```text output holds what the fence before it prints, with `...` for what may differ; with
```text output about numbers may differ by a tenth, as counts of steps do from version to version.
"""

import re
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).parents[2]
DOCUMENTS = [ROOT / "README.md", *sorted((ROOT / "docs").glob("**/*.md"))]
NUMBER = re.compile(r"\b\d+(?:\\?\.\d+)?\b")
FENCE = re.compile(r"^```(\w+)\b([^\n]*)\n(.*?)^```\s*$", re.M | re.S)


@dataclass
class Fence:
    """One fence: where it stands, and the whole program it is the end of."""

    document: Path
    line: int
    language: str
    flags: list[str]
    program: str
    output: list[str] = field(default_factory=list)
    about: bool = False

    @property
    def where(self):
        return f"{self.document.relative_to(ROOT)}:{self.line}"

    @property
    def needs(self):
        """The packages that it needs beyond those of the tests."""
        return [f.removeprefix("needs=") for f in self.flags if f.startswith("needs=")]

    @property
    def beside(self):
        """The scene files that it reads."""
        folders = [f.removeprefix("beside=") for f in self.flags if f.startswith("beside=")]
        return [path for folder in folders for path in (ROOT / folder).glob("*.toml")]

    def file(self, flag):
        """What `picture` or `drawing` says, as a path."""
        names = [f.removeprefix(f"{flag}=") for f in self.flags if f.startswith(f"{flag}=")]
        return self.document.parent / names[0] if names else None


def fences(language):
    """All fences of a language, with what they continue put before them."""
    for document in DOCUMENTS:
        text, before, last = document.read_text(), {}, None
        found = []
        for match in FENCE.finditer(text):
            flags = match[2].split()
            if flags[:1] == ["output"]:
                last.output.append(match[3])
                last.about = "about" in flags
                continue
            program = before.get(match[1], "") * ("continue" in flags) + match[3]
            before[match[1]] = program
            line = text.count("\n", 0, match.start()) + 1
            last = Fence(document, line, match[1], flags, program)
            found.append(last)
        yield from (fence for fence in found if fence.language == language)


def prints(fence, printed):
    """Whether a program printed what its document says: all of it, or the end if it continues."""
    said = "\n".join(fence.output).strip()
    pattern = re.escape(said).replace(re.escape("..."), ".*")
    if fence.about:
        # A whole number: what was printed before it must not take its first digits.
        pattern = NUMBER.sub(r"(?<![\\d.])(\\d+(?:\\.\\d+)?)", pattern)
    beginning = ".*" if "continue" in fence.flags else ""
    match = re.fullmatch(beginning + pattern, printed.strip(), re.S)
    if match is None or not fence.about:
        return match is not None
    expected = [float(number) for number in NUMBER.findall(said.replace("...", ""))]
    found = [float(number) for number in match.groups()]
    return all(abs(e - f) <= 0.1 * abs(e) for e, f in zip(expected, found, strict=True))
