"""Writes python/saltus/_core.pyi: the stub that pybind11-stubgen makes of the module, refined.

python tools/stubs.py [--check]

pybind11 knows no type of an argument that the module takes as a plain Python object, and nothing of
the members of `State`, which are no properties of pybind11. `REFINED` and `ADDED` have these types;
an entry that no longer fits the module is an error. With --check nothing is written, and the exit
code is 1 if the file differs.
"""

import argparse
import ast
import difflib
import re
import subprocess
import sys
import tempfile
from pathlib import Path

STUB = Path(__file__).parents[1] / "python" / "saltus" / "_core.pyi"
HEADER = """\
# The compiled module as the package uses it. Import saltus, not this. Made by ./dev stubs.
from collections.abc import Callable, Mapping, Sequence
from typing import Any, ClassVar, NoReturn, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from saltus.system import System as AnySystem

"""
NUMBERS = "NDArray[np.float64]"
DROPPED = re.compile(r"__(copy|deepcopy|getstate|setstate|eq|ne|hash|repr|str|index|int|all)__")

REFUSED = {"Context.__setattr__"}
"""methods that only refuse what a type checker refuses without them"""

REFINED: dict[str, dict[str, str]] = {
    "Context.__getitem__": {"system": "int | AnySystem"},
    "Context.with_subcontext": {"system": "int | AnySystem"},
    "Context.with_continuous_state": {"continuous_state": "ArrayLike"},
    "Context.with_discrete_state": {"discrete_state": "ArrayLike"},
    "Context.with_parameter": {"value": "ArrayLike"},
    "Context.with_parameters": {"values": "Mapping[str, ArrayLike]"},
    "Context.parameters": {"return": f"dict[str, float | {NUMBERS}]"},
    "Context.to_dict": {"return": "dict[str, Any]"},
    "Context.to_json": {"return": "str"},
    "State.__getitem__": {"arg0": "NoReturn", "return": "NoReturn"},  # no key is of this type
    "State.__iter__": {"return": "NoReturn"},
    "State.with_continuous_state": {"continuous_state": "ArrayLike"},
    "State.with_discrete_state": {"discrete_state": "ArrayLike"},
    "Results.at": {"return": f"tuple[{NUMBERS}, dict[str, {NUMBERS}]]"},
    "Results.jump": {"return": "NDArray[np.int32]"},
    "Results.outputs": {"return": f"dict[str, {NUMBERS}]"},
    "Simulator.results": {"return": "tuple[Results, BaseException | None]"},
    "Simulator.last_results": {"return": "tuple[Results, BaseException | None]"},
    "Ensemble.run": {"return": "tuple[dict[str, Any], BaseException | None]"},
    "set_event_times": {"arg1": "Sequence[tuple[str, ArrayLike]]"},
    "Graph.apply": {"args": "int"},
    "Graph.operation": {"return": "tuple[str, list[int]]"},
    "Tape.jacobian": {"return": "tuple[list[int], list[int], Tape]"},
    "SimulatorOptions.interrupt": {"return": "Callable[[], bool] | None"},
}
"""function or property -> annotations: of the arguments by name, of the result as 'return'"""

ADDED = {
    "State": {
        "continuous_state": NUMBERS,
        "discrete_state": NUMBERS,
        "relations": f"tuple[bool | {NUMBERS}, ...]",
        "mode": "int",
        "entry": "int",
    }
}
"""class -> its members that pybind11-stubgen does not find"""

WORDS = {  # in the text of an annotation
    r"\b(typing|collections\.abc|numpy\.typing)\.": "",
    r"\bSupportsInt \| SupportsIndex\b": "int",
    r"\bSupportsFloat \| SupportsIndex\b": "float",
    r"\bnumpy\.ndarray\[Any, numpy\.dtype\[Any\]\]": NUMBERS,
    r"\bnumpy\.": "np.",
    r"\b(list|Sequence)\b(?!\[)": r"\1[Any]",
    r"\bdict\b(?!\[)": "dict[str, Any]",
    r"\btuple\b(?!\[)": "tuple[Any, ...]",
}


def generated() -> str:
    """The stub as pybind11-stubgen makes it; the module must be importable."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "pybind11_stubgen", "saltus._core", "--output-dir", folder]
        subprocess.run([*command, "--exit-code"], check=True, stdout=subprocess.DEVNULL)
        return (Path(folder) / "saltus" / "_core.pyi").read_text()


class Refinement(ast.NodeTransformer):
    """Changes the annotations of a generated stub, and drops what type checkers need not see."""

    def __init__(self) -> None:
        self.owner = ""
        self.unused = {(name, part) for name, parts in REFINED.items() for part in parts}

    def visit_ClassDef(self, node: ast.ClassDef) -> ast.ClassDef:
        self.owner = node.name
        self.generic_visit(node)
        self.owner = ""
        added = [
            f"@property\ndef {name}(self) -> {kind}: ..."
            for name, kind in ADDED.get(node.name, {}).items()
        ]
        node.body += ast.parse("\n".join(added)).body
        node.body = node.body or [ast.Expr(ast.Constant(...))]
        return node

    def visit_AnnAssign(self, node: ast.AnnAssign) -> ast.AnnAssign | None:
        name = ast.unparse(node.target)
        if DROPPED.fullmatch(name):
            return None
        node.annotation = self.annotation(node.annotation, name, "return")
        node.value = None
        return node

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.FunctionDef | None:
        if DROPPED.fullmatch(node.name) or f"{self.owner}.{node.name}" in REFUSED:
            return None
        if self.owner == "LeafSystem" and node.name.startswith("declare_"):
            node.args = ast.parse("def f(self, *arguments: Any, **none: Any): ...").body[0].args  # type: ignore[attr-defined]
        else:
            self.arguments(node)
        node.returns = self.annotation(node.returns, node.name, "return")
        return node

    def arguments(self, node: ast.FunctionDef) -> None:
        """Annotates the arguments; those that pybind11 has no name for go by position."""
        args = node.args
        for argument in [*args.args, *([args.vararg] if args.vararg else [])]:
            argument.annotation = self.annotation(argument.annotation, node.name, argument.arg)
            if argument.annotation and ast.unparse(argument.annotation) == "System":
                argument.annotation = ast.Name("AnySystem")
        setter = any(isinstance(d, ast.Attribute) for d in node.decorator_list)
        if any(re.fullmatch(r"arg\d", a.arg) for a in args.args) and not setter:
            args.posonlyargs, args.args = args.args, []
        if self.owner == "System" and not node.decorator_list[:1] == [ast.Name("property")]:
            self.of_any_system(node)

    def of_any_system(self, node: ast.FunctionDef) -> None:
        """`saltus.System` calls the methods of `_core.System` for the blocks that are both."""
        first = (node.args.posonlyargs or node.args.args)[0]
        if not any(ast.unparse(d) == "property" for d in node.decorator_list):
            first.annotation = ast.Name("Any")

    def annotation(self, node: ast.expr | None, name: str, part: str) -> ast.expr | None:
        key = (f"{self.owner}.{name}" if self.owner else name, part)
        if key[0] in REFINED and part in REFINED[key[0]]:
            self.unused.discard(key)
            return ast.parse(REFINED[key[0]][part], mode="eval").body
        if node is None:
            return None
        text = ast.unparse(node)
        for pattern, word in WORDS.items():
            text = re.sub(pattern, word, text)
        text = re.sub(r"\btuple\[str, System, int\]", "tuple[str, AnySystem, int]", text)
        return ast.parse(text, mode="eval").body


def refined(stub: str) -> str:
    tree = ast.parse(stub)
    tree.body = [
        node
        for node in tree.body
        if not isinstance(node, ast.Import | ast.ImportFrom)
        and not (isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant))
    ]
    refinement = Refinement()
    tree = ast.fix_missing_locations(refinement.visit(tree))
    if refinement.unused:
        sys.exit(f"tools/stubs.py refines what is not in the module: {sorted(refinement.unused)}")
    text = ast.unparse(tree).replace("@typing.overload", "@overload")
    return formatted(HEADER + re.sub(r"\btyping\.", "", text) + "\n")


def formatted(text: str) -> str:
    command = [sys.executable, "-m", "ruff"]
    name = ["--stdin-filename", str(STUB)]
    for step in (["check", "--fix-only", "--quiet", "--select", "F401,I"], ["format"]):
        text = subprocess.run(
            [*command, *step, *name, "-"], input=text, capture_output=True, text=True, check=True
        ).stdout
    return text


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument(
        "--check", action="store_true", help="write nothing, exit 1 on a difference"
    )
    text = refined(generated())
    if not parser.parse_args().check:
        STUB.write_text(text)
    elif (committed := STUB.read_text()) != text:
        lines = committed.splitlines(keepends=True), text.splitlines(keepends=True)
        sys.stdout.writelines(difflib.unified_diff(*lines, "committed", "generated"))
        sys.exit("python/saltus/_core.pyi is not the stub of the module: run ./dev stubs")
