#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what the tests need, builds, and runs them all:
#   1. everything, optimised (preset dev): unit, property, integration, end-to-end, slow ones too;
#      then what opens maps (label engine) once more with SEMVIEW_ENGINE=embree
#   2. unit and integration tests under AddressSanitizer and UndefinedBehaviorSanitizer (asan)
#   3. core, cache, server and client under ThreadSanitizer (tsan)
# Asks nothing. Ends with one line that counts the tests of all: "N passed, N failed, N skipped".
#
#   ./test.sh          all of it
#   ./test.sh --quick  only the first, without the slow tests
set -uo pipefail
cd "$(dirname "$0")" || exit 1

quick=false
case "${1:-}" in
  "") ;;
  --quick) quick=true ;;
  *) sed -n '3,11p' "$0" | cut -c3-; exit 2 ;;
esac

say() { printf '\n== %s\n' "$*"; }
die() { printf 'test.sh: %s\n' "$*" >&2; exit 1; }

say "Packages"
tools/install_deps.sh --test || die "the packages above are missing"
# Sanitizers read /proc; a new chroot has none until it is mounted.
[[ -r /proc/self/maps ]] || die "/proc is not mounted; as root run: mount -t proc proc /proc"

passed=0 failed=0 skipped=0
# run PRESET CTEST_ARGUMENTS…: configures, builds, tests and adds to the counts.
run() {
  local preset=$1
  shift
  say "Building preset $preset (build/$preset)"
  cmake --preset "$preset" >"build/$preset.configure.log" 2>&1 ||
    { tail -n 30 "build/$preset.configure.log"; die "configuring $preset failed, see above"; }
  cmake --build --preset "$preset" || die "building $preset failed, see above"
  say "Testing preset $preset${SEMVIEW_ENGINE:+ with engine $SEMVIEW_ENGINE}"
  local results=$PWD/build/$preset/results.xml ctest_code=0 p f s
  rm -f "$results"
  ctest --preset "$preset" --jobs "$(nproc)" --output-junit "$results" --quiet "$@" || ctest_code=$?
  [[ -s "$results" ]] || die "ctest wrote no results for $preset (exit code $ctest_code)"
  read -r p f s < <(python3 tools/test_report.py "$results")
  printf '%s%s: %d passed, %d failed, %d skipped\n' \
    "$preset" "${SEMVIEW_ENGINE:+ with $SEMVIEW_ENGINE}" "$p" "$f" "$s"
  [[ "$ctest_code" -eq 0 || "$f" -gt 0 ]] || die "ctest failed for $preset (exit code $ctest_code)"
  passed=$((passed + p)) failed=$((failed + f)) skipped=$((skipped + s))
}

mkdir -p build
if $quick; then
  run dev --label-exclude slow
else
  run dev
  SEMVIEW_ENGINE=embree run dev --label-regex engine
  run asan
  run tsan
fi

say "All tests"
printf '%d passed, %d failed, %d skipped\n' "$passed" "$failed" "$skipped"
[[ "$failed" -eq 0 && "$passed" -gt 0 ]]
