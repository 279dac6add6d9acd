"""Every ```python and ```cpp fence of README.md and docs/*.md runs as it stands there.

In the line that opens a fence, after the language: `continue` puts the fence after the one before it in the same language.
A C++ fence without `main` is the body of one. Shell text that is not to be run says `no-run`; Python and C++ may not.
SALTUS_PREFIX names the installed library the C++ fences link with (./dev test snippets sets it).
"""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
DOCUMENTS = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
FENCE = re.compile(r"^```(python|cpp)\b([^\n]*)\n(.*?)^```\s*$", re.M | re.S)
CMAKE = """cmake_minimum_required(VERSION 3.23)
project(snippets LANGUAGES CXX)
find_package(saltus REQUIRED)
file(GLOB sources *.cpp)
foreach(source ${sources})
  cmake_path(GET source STEM name)
  add_executable(${name} ${source})
  target_link_libraries(${name} PRIVATE saltus::saltus)
endforeach()
"""


def fences(language):
    """(document:line, text) of each fence, with what it continues put before it."""
    for document in DOCUMENTS:
        text, before = document.read_text(), ""
        for match in FENCE.finditer(text):
            if match[1] != language:
                continue
            before = (before if "continue" in match[2].split() else "") + match[3]
            where = f"{document.relative_to(ROOT)}:{text.count(chr(10), 0, match.start()) + 1}"
            assert "no-run" not in match[2], f"{where}: Python and C++ shown to readers must run"
            yield pytest.param(where, before, id=where)


def program(text):
    """A fence without main becomes the body of one; its includes stay outside."""
    if re.search(r"\bint main\(", text):
        return text
    lines = text.splitlines()
    top = [line for line in lines if line.startswith("#include")]
    body = [line for line in lines if not line.startswith("#include")]
    return "\n".join([*top, "int main() {", *body, "}", ""])


def stem(where):
    return re.sub(r"\W", "_", where)


@pytest.fixture(scope="session")
def programs(tmp_path_factory):
    """All C++ fences, built at once; those that do not compile are missing."""
    prefix = os.environ.get("SALTUS_PREFIX")
    if not prefix:
        pytest.skip("SALTUS_PREFIX is not set")
    source = tmp_path_factory.mktemp("snippets")
    (source / "CMakeLists.txt").write_text(CMAKE)
    for where, text in (fence.values for fence in fences("cpp")):
        (source / f"{stem(where)}.cpp").write_text(program(text))
    build = source / "build"
    configure = ["cmake", "-G", "Ninja", "-S", source, "-B", build, f"-DCMAKE_PREFIX_PATH={prefix}"]
    subprocess.run(configure, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(
        ["cmake", "--build", build, "--", "-k", "0"], check=False
    )  # the log says what did not compile
    return build


def run(command, directory):
    environment = os.environ | {"MPLBACKEND": "Agg"}
    done = subprocess.run(
        command, cwd=directory, env=environment, capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 0, f"exit {done.returncode}\n{done.stdout}{done.stderr}"


@pytest.mark.parametrize(("where", "text"), list(fences("python")))
def test_python(where, text, tmp_path):
    script = tmp_path / f"{stem(where)}.py"
    script.write_text(text)
    run([sys.executable, "-W", "error", script], tmp_path)


@pytest.mark.parametrize(("where", "text"), list(fences("cpp")))
def test_cpp(where, text, tmp_path, programs):
    executable = programs / stem(where)
    assert executable.exists(), f"{where} did not compile:\n{program(text)}"
    run([executable], tmp_path)


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: path.name)
def test_links_point_somewhere(document):
    links = re.findall(
        r"\]\(([^)#\s]+)[^)]*\)", re.sub(r"```.*?```", "", document.read_text(), flags=re.S)
    )
    missing = [
        link for link in links if "://" not in link and not (document.parent / link).exists()
    ]
    assert not missing, f"{document.name} links to {', '.join(missing)}"
