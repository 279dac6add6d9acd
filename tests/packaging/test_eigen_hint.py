"""Without Eigen `find_package(saltus)` and our own build say how to get it."""

import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
HINT = "apt-get install libeigen3-dev"
USER = """cmake_minimum_required(VERSION 3.23)
project(user CXX)
include(CMakePackageConfigHelpers)
set(SALTUS_NEEDS_SUNDIALS 0)
configure_package_config_file({template} ${{CMAKE_BINARY_DIR}}/saltusConfig.cmake INSTALL_DESTINATION .)
file(WRITE ${{CMAKE_BINARY_DIR}}/saltusTargets.cmake "")
find_package(saltus REQUIRED CONFIG PATHS ${{CMAKE_BINARY_DIR}} NO_DEFAULT_PATH)
message(STATUS "saltus was found")
"""

pytestmark = pytest.mark.skipif(shutil.which("cmake") is None, reason="there is no CMake")


def configured(source, build, *options):
    done = subprocess.run(
        ["cmake", "-S", source, "-B", build, *options], capture_output=True, text=True
    )
    return done.returncode, " ".join((done.stdout + done.stderr).split())


@pytest.fixture
def user(tmp_path):
    """A project that uses the installed library."""
    source = tmp_path / "user"
    source.mkdir()
    template = ROOT / "cmake" / "saltusConfig.cmake.in"
    (source / "CMakeLists.txt").write_text(USER.format(template=template))
    return source


def test_a_user_without_eigen_is_told_how_to_get_it(user, tmp_path):
    code, said = configured(user, tmp_path / "build", "-DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON")
    assert code != 0 and HINT in said and "Eigen3_DIR" in said and "was found" not in said


def test_a_user_with_eigen_finds_the_library(user, tmp_path):
    eigen = tmp_path / "eigen"
    eigen.mkdir()
    (eigen / "Eigen3Config.cmake").write_text("set(Eigen3_FOUND TRUE)\n")
    code, said = configured(user, tmp_path / "build", f"-DEigen3_DIR={eigen}")
    assert code == 0 and "saltus was found" in said, said


def test_our_own_build_without_eigen_says_so_too(tmp_path):
    code, said = configured(ROOT, tmp_path / "build", "-DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON")
    assert code != 0 and HINT in said
