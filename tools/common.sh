# Sourced by ./dev: shows progress, and installs or checks the programs and packages that a step needs.

die() { echo "$*" >&2; exit 1; }

show_progress() {  # LOG TEXT: the count of Ninja, CTest or pytest; a terminal shows it in place, other outputs get a line every 30 s
  local seconds=0 period=30 count shown=
  [ -t 1 ] && period=1
  while sleep 1; do
    ((++seconds % period == 0)) || continue
    count=$(tail -c 4000 "$1" 2>/dev/null | grep -oE '^ *\[?[0-9]+/[0-9]+\]?|\[ *[0-9]+%\]' | tail -n 1 | tr -d '[ ]') || true
    [ "$count" != "$shown" ] || continue
    shown=$count
    if [ -t 1 ]; then printf '\r  %s ... %s ' "$2" "$count"; else printf '\n    %s ' "$count"; fi
  done
}

step() {  # NAME TEXT COMMAND...: one line on the screen, the rest in build/log/NAME.log
  local log=build/log/$1.log text=$2 start=$SECONDS status=0 progress
  shift 2
  mkdir -p build/log
  printf '  %s ... ' "$text"
  : >"$log"
  show_progress "$log" "$text" &
  progress=$!
  "$@" >"$log" 2>&1 </dev/null || status=$?
  kill $progress
  wait $progress 2>/dev/null || true
  if [ $status = 0 ]; then
    echo "done ($((SECONDS - start)) s)"
  else
    echo "FAILED ($((SECONDS - start)) s), the end of $log:"
    tail -n 25 "$log" | sed 's/^/    | /'
    return 1
  fi
}

need() {  # Debian packages; installs those that are missing
  command -v dpkg >/dev/null || return 0  # elsewhere CMake says what it does not find
  local package missing=()
  for package; do
    dpkg -s "$package" 2>/dev/null | grep -q '^Status: install ok installed' || missing+=("$package")
  done
  ((${#missing[@]})) || return 0
  local install="apt-get update && DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends ${missing[*]}"
  if [ "$(id -u)" = 0 ]; then
    step apt "installing ${missing[*]}" sh -c "$install" || exit 1
  elif sudo -n true 2>/dev/null; then
    step apt "installing ${missing[*]}" sudo -n sh -c "$install" || exit 1
  else
    die "Some packages are missing. Please run:"$'\n\n'"  sudo sh -c '$install'"
  fi
}

venv() {  # NAME PACKAGE...: Python packages in .venv, asked for again when what names them has changed
  local stamp=.venv/$1.stamp name=$1
  shift
  [ -e "$stamp" ] && [ -z "$(find pyproject.toml tools docs/site/requirements.txt -newer "$stamp" -print -quit)" ] && return
  [ -x "$python" ] || step venv "making .venv" "${PYTHON:-python3}" -m venv .venv || exit 1
  step "pip-$name" "installing $*" "$python" -m pip install "$@" || exit 1
  touch "$stamp"
}

sources=(bindings cmake include python src CMakeLists.txt pyproject.toml)  # the files of which the Python module is made
is_new() { [ -e "$1" ] && [ -z "$(find "${sources[@]}" -newer "$1" -print -quit)" ]; }  # FILE: newer than these

install_module() {  # EXTRA: the wheel if one was just made, else compiled in build/python
  local wheel
  for wheel in build/wheel/repaired/saltus-*.whl; do
    is_new "$wheel" || continue
    "$python" -m pip uninstall --yes saltus && "$python" -m pip install "$wheel[$1]"
    return
  done
  "$python" -m pip install -v --no-build-isolation ".[$1]" \
    --config-settings=build-dir=build/python --config-settings=cmake.define.SALTUS_SUNDIALS_CACHE="$root/build/sundials"
}

module() {  # EXTRA: the Python module with an extra of pyproject.toml, installed into .venv
  local stamp
  venv build "scikit-build-core>=0.10" "pybind11>=3"
  for stamp in .venv/module-all.stamp ".venv/module-$1.stamp"; do
    is_new "$stamp" && return
  done
  step module "installing the Python module" install_module "$1" || return 1
  touch "$stamp"
}

configure() { cmake --preset "$1" -DPython_EXECUTABLE="$python" "${@:2}"; }  # PRESET [CMAKE OPTION...]
configure_and_build() { configure "$@" && cmake --build --preset "$1" --parallel "$jobs"; }

build() { step "build-$1" "building build/$1" configure_and_build "$@"; }
