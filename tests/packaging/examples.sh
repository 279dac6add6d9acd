#!/usr/bin/env bash
# Every example says --help and does its default run; every scene runs, as a file and as a script. Usage: examples.sh BIN_DIRECTORY PYTHON; one line per run, `ok` or `FAILED`.
set -u
shopt -s nullglob
root=$(cd "$(dirname "$0")/../.." && pwd)
bin=$(cd "$1" && pwd)
python=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch" || exit 1  # an example that writes files writes them here
failed=0

try() {  # NAME COMMAND...
  local name=$1
  shift
  if MPLBACKEND=Agg timeout 120 "$@" >"$scratch/output" 2>&1 </dev/null; then
    echo "ok $name"
  else
    echo "FAILED $name (exit $?)"
    cat "$scratch/output"
    failed=1
  fi
}

for source in "$root"/examples/*.cpp; do
  name=$(basename "$source" .cpp)
  try "$name --help" "$bin/$name" --help
  try "$name" "$bin/$name"
done
for source in "$root"/examples/*.py; do
  name=$(basename "$source")
  try "$name --help" "$python" "$source" --help
  try "$name" "$python" "$source"
done
for source in "$root"/examples/scenes/*.py; do
  try "scenes/$(basename "$source")" "$python" "$source"
done
for source in "$root"/examples/scenes/*.toml; do
  try "scenes/$(basename "$source")" "$python" -m saltus run "$source"
done
exit $failed
