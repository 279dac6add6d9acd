"""Compiles each public header alone, so that a user may include any one of them first.

python tools/headers.py BUILD [--jobs N]

The options are those by which BUILD compiles the library. Two things keep it short. A header that
includes a BASE is compiled after the precompiled form of that base, so it sees nothing that it does
not include. And the compiler stops where the header ends, before it instantiates once more what all
headers use; a last file, which includes all headers, is compiled to its end.
"""

import argparse
import json
import os
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path

INCLUDE = Path(__file__).parents[1] / "include"
LINE = re.compile(r'^\s*#\s*include\s+["<]([^">]+)[">]', re.M)
# Headers that many others include; each has those before it.
BASES = [
    "Eigen/Core",
    "saltus/model/leaf_system.hpp",
    "saltus/plan/plan.hpp",
    "saltus/simulation/options.hpp",
]
END = "the header ends here"


@cache
def included(name: str) -> frozenset[str]:
    """All headers that a header includes, directly or through others."""
    path = INCLUDE / name
    direct = LINE.findall(path.read_text()) if path.exists() else []
    return frozenset(direct).union(*map(included, direct))


def base_of(name: str) -> str | None:
    """The last of the bases that a header includes."""
    return next((base for base in reversed(BASES) if base in included(name)), None)


def options(build: Path) -> list[str]:
    """The compiler and its options for the library, without input and output."""
    entries = json.loads((build / "compile_commands.json").read_text())
    # A file that has neither a precompiled header nor SUNDIALS.
    entry = next(e for e in entries if e["file"].endswith("/src/solver/linear/unrolled.cpp"))
    words = shlex.split(entry["command"])
    words = words[next(i for i, word in enumerate(words) if "ccache" not in word) :]
    return [*words[: words.index("-o")], "-O0", "-Werror"]


def precompiled(compiler: list[str], base: str, folder: Path) -> Path:
    """A file that includes the base, beside its precompiled form."""
    file = folder / (base.replace("/", "_").removesuffix(".hpp") + ".hpp")
    file.write_text(f"#include <{base}>\n")
    subprocess.run([*compiler, "-x", "c++-header", file, "-o", f"{file}.gch"], check=True)
    return file


def messages(compiler: list[str], text: str) -> str:
    """What the compiler says of a text."""
    check = [*compiler, "-fsyntax-only", "-x", "c++", "-"]
    return subprocess.run(check, input=text, capture_output=True, text=True).stderr


def errors(compiler: list[str], name: str, first: Path | None) -> str:
    """What the compiler says of a header before its end; empty if nothing."""
    stop = ["-Wfatal-errors"] + (["-include", str(first), "-Winvalid-pch"] if first else [])
    said = messages([*compiler, *stop], f'#include <{name}>\nstatic_assert(false, "{END}");\n')
    return "" if END in said else said or "no message"


def check(build: Path, names: list[str], jobs: int) -> Iterator[tuple[str, str]]:
    """Each header, and what is wrong with it; at last all of them in one file."""
    compiler, folder = options(build), build / "headers"
    folder.mkdir(exist_ok=True)
    with ThreadPoolExecutor(jobs) as pool:
        files = {base: pool.submit(precompiled, compiler, base, folder) for base in BASES}
        first = {base: file.result() for base, file in files.items()}
        for name, said in [
            (name, pool.submit(errors, compiler, name, first.get(base_of(name) or "")))
            for name in names
        ]:
            yield name, said.result()
    for file in folder.glob("*.gch"):
        file.unlink()  # a hundred megabytes each
    yield "all of them", messages(compiler, "".join(f"#include <{name}>\n" for name in names))


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=Path)
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    given = parser.parse_args()
    headers = sorted(path.relative_to(INCLUDE).as_posix() for path in INCLUDE.rglob("*.hpp"))
    wrong = 0
    for number, (name, said) in enumerate(check(given.build, headers, given.jobs)):
        print(f"{number}/{len(headers)} {name}", said, sep="\n" if said else "", flush=True)
        wrong += bool(said)
    print(f"{wrong} of {len(headers)} headers do not compile alone")
    sys.exit(wrong > 0)
