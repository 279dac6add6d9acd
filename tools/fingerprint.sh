# Sourced by ./dev: what every scene gives, as hashes, for whoever changes the engine and not its results.

fingerprint_folders=(laws errors semantics)  # of tests/, each run of a test in them is a line

# The extreme cases are run by name. The others depend on the order of threads, or on a clock.
fingerprint_not=(extremes_test results_threads_test ensemble_test island_threads_test report_test) fingerprint_clock='~"an interrupt that throws*"'

fingerprint_job() {  # NAME: one part of the fingerprint, to build/fingerprint/NAME.tsv
  local out=build/fingerprint/$1.tsv program=build/dev/bin/saltus_fingerprint
  : >"$out"
  # A run that failed may end with a state that nobody has written (KNOWN_GAPS.md): let that be the same each time.
  export GLIBC_TUNABLES=glibc.malloc.tcache_count=0:glibc.malloc.perturb=90
  case $1 in
    fuzz)
      PYTHONPATH=$fingerprint_path PYTHONDONTWRITEBYTECODE=1 "$fingerprint_python" tests/python/fuzz/fingerprint.py "$out" ;;
    shelf | extremes)
      SALTUS_FINGERPRINT=$out "$program" "fingerprint: $1" ;;
    *)  # a test that fails has written its lines
      SALTUS_FINGERPRINT=$out "$program" --rng-seed 1 --filenames-as-tags "[#$1]~[.]$fingerprint_clock" || [ $? -lt 126 ] ;;
  esac >"build/fingerprint/$1.log" 2>&1 || { echo "$1 failed, see build/fingerprint/$1.log" >&2; return 1; }
}

fingerprint_jobs() {  # their names, long ones first
  local folder file
  printf '%s\n' fuzz extremes shelf
  for folder in "${fingerprint_folders[@]}"; do
    for file in tests/"$folder"/*_test.cpp; do
      file=$(basename "$file" .cpp)
      [[ " ${fingerprint_not[*]} " == *" $file "* ]] || echo "$file"
    done
  done
}

fingerprint_runs() {  # FILE
  local name names
  names=$(fingerprint_jobs)
  rm -rf build/fingerprint/*.tsv build/fingerprint/*.log
  export -f fingerprint_job
  export fingerprint_path fingerprint_python fingerprint_clock
  xargs -P "$jobs" -I{} bash -c 'fingerprint_job "$1"' job {} <<<"$names" || return 1
  for name in $names; do cat "build/fingerprint/$name.tsv"; done >"$1"
}

fingerprint_build() {  # the module installed; or, with --built, all from build/dev as it is configured
  fingerprint_path='' fingerprint_python=$python
  if [ "$1" = no ]; then
    module all || return 1
    step fingerprint-configure "configuring build/dev" cmake --preset dev -DPython_EXECUTABLE="$python" -DSALTUS_SUNDIALS=$sundials || return 1
    step fingerprint-build "building build/dev/bin/saltus_fingerprint" cmake --build build/dev --target saltus_fingerprint -j "$jobs"
    return
  fi
  grep -q '^SALTUS_BUILD_PYTHON:BOOL=ON' build/dev/CMakeCache.txt || die "--built: configure build/dev with -DSALTUS_BUILD_PYTHON=ON"
  fingerprint_python=$(sed -n 's/^Python_EXECUTABLE:[A-Z]*=//p' build/dev/CMakeCache.txt)
  fingerprint_path=$root/build/fingerprint/python
  step fingerprint-build "building build/dev" cmake --build build/dev --target saltus_fingerprint _core -j "$jobs" || return 1
  rm -rf "$fingerprint_path"
  mkdir -p "$fingerprint_path/saltus"  # the package as it would be installed
  ln -s "$root"/python/saltus/* "$root"/build/dev/bindings/_core*.so "$fingerprint_path/saltus"
}

fingerprint() {  # [--built] [--compare FILE | FILE]
  local built=no before='' out=$root/build/fingerprint.txt
  while (($#)); do
    case $1 in
      --built) built=yes ;;
      --compare) before=${2:?--compare FILE} out=$root/build/fingerprint-now.txt; shift ;;
      -*) die "fingerprint: no option $1" ;;
      *) out=$1 ;;
    esac
    shift
  done
  [ -z "$before" ] || [ -r "$before" ] || die "No fingerprint in '$before'"
  [ $built = yes ] || need "${basics[@]}" "${for_tests[@]}"
  mkdir -p build/fingerprint
  fingerprint_build $built || return 1
  step fingerprint "running the scenes" fingerprint_runs "$out" || return 1
  echo "  $(wc -l <"$out") runs in $out"
  [ -z "$before" ] || "$fingerprint_python" tools/fingerprint.py "$before" "$out"
}
