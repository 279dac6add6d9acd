# Sourced by ./dev: what is written into the checkout: format, pictures and the site.

docs() {
  module all && venv docs -r docs/site/requirements.txt || return 1
  step pictures "drawing docs/pictures" "$python" docs/pictures/make.py || return 1
  step blocks "drawing docs/pictures/blocks.svg" "$python" docs/pictures/blocks.py || return 1
  step each "drawing docs/pictures/blocks" "$python" docs/pictures/each_block.py || return 1
  step models "drawing docs/models" "$python" docs/models/make.py || return 1
  step films "filming docs/models" "$python" docs/models/films.py || return 1
  step drawings "drawing what the code in docs/ draws" "$python" docs/site/pictures.py || return 1
  run_tests snippets || return 1
  step site "building build/site" env NO_MKDOCS_2_WARNING=1 "$python" -m mkdocs build --strict
}

stubs() {
  module all && venv typing "${for_typing[@]}" || return 1
  step stubs "writing python/saltus/_core.pyi" "$python" tools/stubs.py
}

format() {  # [--check]: which names the files that are not formatted, and says nothing else
  need python3-venv
  venv format clang-format==18.1.8 ruff==0.17.5
  local check=()
  [ "${1:-}" = --check ] && check=(--check)
  find include src bindings tests examples bench -name '*.[ch]pp' -print0 \
    | xargs -0 .venv/bin/clang-format ${check:+--dry-run --Werror} -i
  if ((${#check[@]})); then
    .venv/bin/ruff format --check . | { grep -v 'already formatted' || true; }  # pipefail: ruff's own status
  else
    .venv/bin/ruff format --quiet .
  fi
}
