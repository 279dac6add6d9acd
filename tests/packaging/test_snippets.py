"""Every fence of Python, C++ and shell in README.md and docs/ runs as it stands there.

docs/site/snippets.py says what the line that opens a fence may say. A C++ fence without `main` is
the body of one. SALTUS_PREFIX names the installed library the C++ fences link with (./dev test
snippets sets it).
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "docs" / "site"))

from snippets import DOCUMENTS, fences, prints  # noqa: E402

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


def cases(language):
    return [pytest.param(fence, id=fence.where) for fence in fences(language)]


def shell_cases():
    return [case for case in cases("sh") if "no-run" not in case.values[0].flags]


def program(text):
    """A fence without main becomes the body of one; its includes stay outside."""
    if re.search(r"\bint main\(", text):
        return text
    lines = text.splitlines()
    top = [line for line in lines if line.startswith("#include")]
    body = [line for line in lines if not line.startswith("#include")]
    return "\n".join([*top, "int main() {", *body, "}", ""])


def stem(fence):
    return re.sub(r"\W", "_", fence.where)


@pytest.fixture(scope="session")
def programs(once):
    """All C++ fences, built at once; those that do not compile are missing."""
    prefix = os.environ.get("SALTUS_PREFIX")
    if not prefix:
        pytest.skip("SALTUS_PREFIX is not set")
    return once("snippets", lambda source: build(prefix, source)) / "build"


def build(prefix, source):
    (source / "CMakeLists.txt").write_text(CMAKE)
    for fence in fences("cpp"):
        (source / f"{stem(fence)}.cpp").write_text(program(fence.program))
    out = source / "build"
    configure = ["cmake", "-G", "Ninja", "-S", source, "-B", out, f"-DCMAKE_PREFIX_PATH={prefix}"]
    subprocess.run(configure, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(
        ["cmake", "--build", out, "--", "-k", "0"], check=False
    )  # the log says what did not compile


def run(fence, command, directory):
    for file in fence.beside:
        shutil.copy(file, directory)
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    done = subprocess.run(
        command,
        cwd=directory,
        env=os.environ | {"MPLBACKEND": "Agg", "PATH": path},
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.returncode == 0, f"exit {done.returncode}\n{done.stdout}{done.stderr}"
    if fence.output:
        assert prints(fence, done.stdout), (
            f"{fence.where} says it prints\n{''.join(fence.output)}\nand prints\n{done.stdout}"
        )


@pytest.mark.parametrize("fence", cases("python"))
def test_python(fence, tmp_path):
    assert "no-run" not in fence.flags, f"{fence.where}: Python shown to readers must run"
    for package in fence.needs:
        pytest.importorskip(package)
    script = tmp_path / f"{stem(fence)}.py"
    script.write_text(fence.program)
    run(fence, [sys.executable, "-W", "error", script], tmp_path)


@pytest.mark.parametrize("fence", cases("cpp"))
def test_cpp(fence, tmp_path, programs):
    assert "no-run" not in fence.flags, f"{fence.where}: C++ shown to readers must run"
    executable = programs / stem(fence)
    assert executable.exists(), f"{fence.where} did not compile:\n{program(fence.program)}"
    run(fence, [executable], tmp_path)


@pytest.mark.parametrize("fence", shell_cases())
def test_shell(fence, tmp_path):
    run(fence, ["bash", "-euo", "pipefail", "-c", fence.program], tmp_path)


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: str(path.relative_to(ROOT)))
def test_links_point_somewhere(document):
    text = re.sub(r"```.*?```|`[^`\n]*`", "", document.read_text(), flags=re.S)
    links = re.findall(r"\]\(([^)#\s]+)[^)]*\)", text)
    missing = [
        link for link in links if "://" not in link and not (document.parent / link).exists()
    ]
    assert not missing, f"{document.name} links to {', '.join(missing)}"


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: str(path.relative_to(ROOT)))
def test_pictures_are_described(document):
    bare = re.findall(r"!\[\s*\]\(([^)]+)\)", document.read_text())
    assert not bare, f"{document.name}: no words for {', '.join(bare)}"
