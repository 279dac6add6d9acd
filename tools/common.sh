# Sourced by ./dev: saying what is done, and what must be there.

die() { echo "$*" >&2; exit 1; }

step() {  # NAME TEXT COMMAND...: one line on the screen, the rest in build/log/NAME.log
  local log=build/log/$1.log text=$2 start=$SECONDS
  shift 2
  mkdir -p build/log
  printf '  %s ... ' "$text"
  if "$@" >"$log" 2>&1 </dev/null; then
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

sources=(bindings cmake include python src CMakeLists.txt pyproject.toml)  # what the Python module is made of
is_new() { [ -e "$1" ] && [ -z "$(find "${sources[@]}" -newer "$1" -print -quit)" ]; }  # FILE: newer than these

install_module() {  # EXTRA: the wheel if one was just made, else compiled in build/python
  local wheel
  for wheel in build/wheel/repaired/saltus-*.whl; do
    is_new "$wheel" || continue
    "$python" -m pip uninstall --yes saltus && "$python" -m pip install "$wheel[$1]"
    return
  done
  "$python" -m pip install --no-build-isolation ".[$1]" \
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

configure_and_build() {  # PRESET [CMAKE OPTION...]
  cmake --preset "$1" -DPython_EXECUTABLE="$python" "${@:2}" && cmake --build --preset "$1" --parallel "$jobs"
}

build() { step "build-$1" "building build/$1" configure_and_build "$@"; }
