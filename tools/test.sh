# Sourced by ./dev: the parts of the tests, and their sum.

# The parts of ./dev test, in their order. The wheel comes before the tests in Python, so that these test the module that a user gets.
parts=(cpp system asan wheel python doctest typing examples snippets docs packaging)
for_tests=(catch2 libsundials-dev graphviz)
for_jax=("jax>=0.5" "torch>=2.2")
for_typing=(mypy==2.4.1 vermin==1.9.2 pybind11-stubgen==3.0.0 ruff==0.17.5)

passed=0 failed=0
junits=() durations=()  # files with the duration of each test; "seconds part"
count() { passed=$((passed + $1)) failed=$((failed + $2)); }
count_run() {  # STATUS PASSED FAILED: a bad end without a failed test counts as one
  if [ "$1" != 0 ] && [ "$3" = 0 ]; then count "$2" 1; else count "$2" "$3"; fi
}
check() { if step "$@"; then count 1 0; else count 0 1; fi; }  # one thing that holds or does not

count_junit() {  # STATUS FILE: the tests in a JUnit file
  local sums
  sums=$("$python" tools/count.py "$2" 2>/dev/null) || sums="0 0"
  count_run "$1" $sums
  junits+=("$2")
}

show_slowest() {  # of the parts and the tests that were run
  ((${#junits[@]})) || return 0
  echo "the slowest parts"
  printf '%s\n' "${durations[@]}" | sort -rn | head -n 10 | while read -r seconds part; do
    printf '%8d s    %s\n' "$seconds" "$part"
  done
  echo "the slowest tests"
  "$python" tools/slowest.py "${junits[@]}"
}

catch_tests() {  # PRESET [CMAKE OPTION...]
  local status=0 junit=$root/build/log/$1.xml
  build "$@" || { count 0 1; return; }
  rm -f "$junit"
  step "ctest-$1" "running the tests" ctest --preset "$1" --parallel "$jobs" --no-tests=error \
    --test-output-size-passed 100000 --output-junit "$junit" || status=$?
  count_junit $status "$junit"
}

pytest_tests() {  # NAME PYTEST-ARGUMENT...
  local status=0 junit=build/log/$1.xml
  module all || { count 0 1; return; }
  rm -f "$junit"
  step "pytest-$1" "running pytest" env PYTHONPYCACHEPREFIX="$root/build/pycache" "$python" -m pytest -q \
    --numprocesses="$jobs" --dist=worksteal --junitxml="$junit" "${@:2}" || status=$?
  count_junit $status "$junit"
}

build_one_test() {  # NAME: its object, the library, and an executable of these
  configure dev -DSALTUS_SUNDIALS=$sundials && cmake --build --preset dev --target "$1" --parallel "$jobs"
}

test_file() {  # tests/FOLDER/NAME.cpp
  local status=0 name junit
  name=$(basename "$1" .cpp) junit=$root/build/log/$name.xml
  step "build-$name" "building $name" build_one_test "$name" || { count 0 1; return; }
  step "$name" "running it" "build/dev/bin/$name" -r junit -o "$junit" || status=$?
  count_junit $status "$junit"
  [ $status = 0 ] || "build/dev/bin/$name" || true  # says on the screen what failed
}

test_cpp() { catch_tests dev -DSALTUS_SUNDIALS=$sundials; }
test_system() { catch_tests system; }
test_asan() { catch_tests asan; }
test_python() { pytest_tests python tests/python; }

test_examples() {
  local status=0
  module all && build dev -DSALTUS_SUNDIALS=$sundials || { count 0 1; return; }
  step examples "running each example" tests/packaging/examples.sh build/dev/bin "$python" || status=$?
  count_run $status "$(grep -c '^ok ' build/log/examples.log)" "$(grep -c '^FAILED ' build/log/examples.log)"
}

test_snippets() {
  build dev -DSALTUS_SUNDIALS=$sundials && step install-dev "installing build/dev" cmake --install build/dev --prefix build/prefix/dev \
    || { count 0 1; return; }
  SALTUS_PREFIX=$root/build/prefix/dev pytest_tests snippets tests/packaging/test_snippets.py
}

test_jax() {  # only when it is named, because of the size of the packages
  venv jax "${for_jax[@]}" && pytest_tests jax tests/python/differentiable tests/packaging/test_docstrings.py \
    "tests/packaging/test_snippets.py::test_python" -k "differentiable or jax or torch"
}
test_doctest() { pytest_tests doctest tests/packaging/test_docstrings.py; }

test_docs() {
  venv docs -r docs/site/requirements.txt \
    && pytest_tests site tests/packaging/test_site.py tests/packaging/test_{course_pages,mathematics,site_seen}.py
}

test_typing() {
  module all || { count 0 1; return; }
  venv typing "${for_typing[@]}"
  check mypy-package "mypy --strict on the package" "$python" -m mypy
  check mypy-examples "mypy --strict on the examples, with the installed package" "$python" -m mypy examples
  check stubs "the stubs are those that ./dev stubs makes" "$python" tools/stubs.py --check
  check stubtest "the stubs say what is in the module" "$python" -m mypy.stubtest saltus._core --mypy-config-file pyproject.toml \
    --allowlist tests/packaging/stubtest.txt
  check vermin "nothing newer than Python 3.10 is used" "$root/.venv/bin/vermin" --target=3.10- --no-tips --violations python/saltus
}

run_tests() {
  local part start before_passed before_failed
  (($#)) || set -- "${parts[@]}"
  for part; do
    [[ $part == tests/*_test.cpp && -e $part ]] || declare -F "test_$part" >/dev/null || die "No part '$part' of the tests. $(usage | grep PART)"
  done
  need "${basics[@]}" "${for_tests[@]}"
  venv build "scikit-build-core>=0.10" "pybind11>=3"
  for part; do
    start=$SECONDS before_passed=$passed before_failed=$failed
    echo "$part"
    if [[ $part == *.cpp ]]; then test_file "$part"; else "test_$part"; fi
    echo "  $((passed - before_passed)) passed, $((failed - before_failed)) failed in $part ($((SECONDS - start)) s)"
    durations+=("$((SECONDS - start)) $part")
  done
  show_slowest
  echo "$passed passed, $failed failed"
  ((failed == 0))
}
