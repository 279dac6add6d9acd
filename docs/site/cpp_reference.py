"""The C++ reference: a page for each layer, what users need of its headers.

What stays of a header: its first comment, and each public or protected declaration with its `///`
comment. What goes: bodies, private parts, `detail`, definitions that stand outside their class.
"""

import re

LAYERS = {  # of those in include/saltus: what a user calls or derives from; headers, * for all
    "base": ("Errors, indices, and what a callback sees", "*"),
    "model": ("What a user declares", "*"),
    "library": ("Blocks", "*"),
    "simulation": (
        "Runs and their results",
        "simulate simulator options results event_log dense_output ensemble outcomes",
    ),
    "analysis": ("Operating points, orbits, exponents, fits", "*"),
    "solver": ("Methods", "choose statistics"),
    "tape": ("Expressions and their derivatives", "*"),
    "report": ("Error against run time", "exact scene observed work_precision table written"),
    "models": ("Ready scenes", "*"),
}
HIDDEN = {
    "callable",
    "elementwise",
    "schedule",
    "pieces",
    "heat_rod_modes",
    "subcontext",
    "declare",
}
TOKEN = re.compile(
    r'///[^\n]*|//[^\n]*|"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])*\'|[{}();]|[^{}();/"\']+|.', re.S
)
ACCESS = re.compile(r"\s*\b(public|private|protected):\s*")
DETAIL = re.compile(r"^namespace detail \{.*?^\}  // namespace detail$", re.M | re.S)
CLOSED = re.compile(r"(template\s*<.*>\s*)?class\b", re.S)  # private until it says otherwise
SCOPE = re.compile(r"(template\s*<.*>\s*)?(class|struct|namespace)\b[^(=]*$", re.S)
ENUM = re.compile(r"enum\b[^(]*$")
INITIALISED = re.compile(r"(^|[^=!<>])=$|^[^()]*\w$|[,:]\s*\w+_$")  # before a brace
OUTSIDE = re.compile(r"\w+::(~?\w+|operator\W+)\s*\(")  # void Block::reset(


def pages(root):
    """(path, markdown) of the reference, from root/include/saltus."""
    include = root / "include" / "saltus"
    for layer, (title, names) in LAYERS.items():
        headers = [h for name in names.split() for h in sorted(include.glob(f"{layer}/{name}.hpp"))]
        shown = [header for header in headers if header.stem not in HIDDEN]
        parts = [f"# {title}\n", *filter(None, map(section, shown))]
        yield f"cpp_reference/{layer}.md", "\n".join(parts)


def section(header):
    text = header.read_text()
    intro = re.match(r"((?://[^\n]*\n)*)", text)[1]
    code = digest(text)
    if not code:
        return ""
    words = prose(re.sub(r"^// ?", "", intro, flags=re.M).strip())
    return f"## {header.parent.name}/{header.name}\n\n{words}\n\n```cpp\n{code}\n```\n"


def prose(words):
    """Text as Markdown: equations, which are indented, become code."""
    equations = re.compile(r"((?:^  .*\n?)+)", re.M)
    parts = equations.split(words)
    parts[::2] = [re.sub(r"([>*_\[\]])", r"\\\1", part.replace("<", "&lt;")) for part in parts[::2]]
    parts[1::2] = [f"\n```text\n{part.rstrip()}\n```\n\n" for part in parts[1::2]]
    return "".join(parts)


def digest(text):
    """The public declarations of a header with their comments."""
    text = re.sub(r"^#[^\n]*\n", "", DETAIL.sub("", text), flags=re.M)
    text = re.sub(r"\A(?://[^\n]*\n)*", "", text)
    tokens = TOKEN.findall(re.sub(r"(///[^\n]*)|//[^\n]*", r"\1", text))
    out = Reader(tokens).scope(depth=-1, public=True).lines
    return re.sub(r"\n{3,}", "\n\n", "\n".join(out)).strip()


class Scope:
    """What was read between one pair of braces: finished lines, and the declaration begun."""

    def __init__(self, depth, public):
        self.depth, self.public = depth, public
        self.lines, self.notes, self.said = [], [], ""

    def note(self, token):
        if not token.startswith("///<"):
            self.notes.append(token)
        elif self.public and self.lines:
            self.lines[-1] += "  " + token

    def words(self, token):
        for access in ACCESS.findall(token):
            self.public = access != "private"
            if access == "protected":
                self.lines.append("  " * (self.depth - 1) + " protected:")
        if "\n\n" in token and not self.said.strip() and self.lines and self.lines[-1]:
            self.lines.append("")
        self.said += ACCESS.sub("", token)

    def end(self, said):
        """The declaration is complete; it is shown unless users do not need it."""
        said = re.sub(r"\binline\s+", "", said.strip())
        outside = self.depth <= 0 and OUTSIDE.search(said.split("= default")[0])
        if self.public and said != ";" and not said.startswith("friend") and not outside:
            self.show(said)
        self.notes, self.said = [], ""

    def show(self, said):
        space = "  " * max(self.depth, 0)
        text = re.sub(r"\n\s*", "\n" + space + "    ", said)  # what is continued is indented
        text = re.sub(r"^(template <.*>\n\s*)    ", r"\1", text)
        text = re.sub(r"\n\s*(?=\}+;$)", "\n" + space, text)
        self.lines += [space + note for note in self.notes] + (space + text).split("\n")


class Reader:
    """Reads tokens from left to right."""

    def __init__(self, tokens):
        self.tokens, self.at = tokens, 0

    def take(self):
        self.at += 1
        return self.tokens[self.at - 1]

    def body(self):
        """What stands between here and the brace that closes; the opening one has been taken."""
        depth, start = 1, self.at
        while depth:
            depth += {"{": 1, "}": -1}.get(self.take(), 0)
        return "".join(self.tokens[start : self.at - 1])

    def scope(self, depth, public):
        scope = Scope(depth, public)
        while self.at < len(self.tokens) and (token := self.take()) != "}":
            if token.startswith("///"):
                scope.note(token)
            elif token == ";":
                scope.end(scope.said + ";")
            elif token == "{":
                self.braces(scope, scope.said.strip())
            else:
                scope.words(token)
        return scope

    def braces(self, scope, said):
        if SCOPE.match(said):
            self.inner(scope, said)
        elif ENUM.match(said):
            body = self.body()
            scope.end(f"{said} {{{body.rstrip()}\n}};" if "\n" in body else f"{said} {{{body}}};")
        elif said.count("(") != said.count(")") or INITIALISED.search(said):
            scope.said += "{" + self.body() + "}"  # the declaration goes on
        else:
            self.body()
            head = re.split(r"\)\s*:\s*[^:]", said)  # before the initialisers of a constructor
            scope.end(head[0] + (");" if len(head) > 1 else ";"))

    def inner(self, scope, said):
        """A class or a namespace."""
        closed = CLOSED.match(said) is not None
        inner = self.scope(scope.depth + 1, not closed).lines
        if said.startswith("namespace"):
            scope.lines += inner
            scope.notes, scope.said = [], ""
            return
        while inner and not inner[-1].strip():
            inner.pop()
        space = "  " * max(scope.depth, 0)
        before = len(scope.lines)
        scope.end(said + " {")
        if len(scope.lines) > before:
            scope.lines += [space + " public:"] * closed + inner + [space + "};"]
