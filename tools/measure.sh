# Sourced by ./dev: the demonstration, random scenes, benchmarks.

run_demo() {  # the scenes of the tutorial: error against run time, pictures
  build/release/bin/tutorial
  "$python" examples/demo.py --out build/demo
}

demo() {
  need "${basics[@]}"
  module plot
  build release
  mkdir -p build/demo
  run_demo
}

fuzz() {  # [N]
  module all && mkdir -p build/log || return 1
  SALTUS_FUZZ_EXAMPLES=${1:-2000} PYTHONPYCACHEPREFIX=$root/build/pycache "$python" -m pytest -q tests/python/fuzz/test_fuzz.py tests/python/fuzz/test_side_effects.py \
    | tee build/log/fuzz.log
}

questions=(ball_floor stiff_floor stiff_targets absent diagram many auto_or_best shelf_report)

bench() {  # [PROGRAM...]: only these; else all questions, and the page
  local program results=build/bench/results start
  need "${basics[@]}"
  module plot || return 1
  build bench || return 1
  (($#)) || rm -rf "$results"
  start=$SECONDS
  for program in "${@:-${questions[@]}}"; do
    [ -x "build/bench/bin/$program" ] || die "No benchmark '$program'; there are $(cd build/bench/bin && echo *)"
    "build/bench/bin/$program" | tee "build/log/bench-$program.txt"
  done
  (($#)) && return
  "$python" bench/instructions.py build/bench/bin/absent "$results"
  "$python" bench/page.py "$results" docs/error_against_run_time.md
  echo "measured in $((SECONDS - start)) s"
}

build_extremes() {
  cmake --preset bench -DPython_EXECUTABLE="$python" && cmake --build build/bench --target bench_extremes --parallel "$jobs"
}

stability() {
  need "${basics[@]}"
  venv build "scikit-build-core>=0.10" "pybind11>=3"
  step build-extremes "building build/bench/bin/extremes" build_extremes
  step stability "running the extreme scenes, writing docs/stability.md" build/bench/bin/extremes --out docs/stability.md
  tail -n 10 build/log/stability.log
}
