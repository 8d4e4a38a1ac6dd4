#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Checks that every C++ file is formatted as .clang-format says, by the clang-format of Debian 12: other
# versions differ in details. To mend: git ls-files '*.cpp' '*.hpp' | xargs clang-format -i
#
# Exits 77 (skipped) where clang-format 14 or git's list of files is missing.
set -euo pipefail
cd "$(dirname "$0")/.."

skip() { printf 'skipped: %s\n' "$*"; exit 77; }

formatter=$(command -v clang-format-14 || command -v clang-format) ||
  skip "clang-format is not installed (apt-get install clang-format)"
"$formatter" --version | grep -q 'version 14\.' || skip "$formatter is not version 14"
git ls-files --error-unmatch .clang-format >/dev/null 2>&1 || skip "git lists no files here"

mapfile -t files < <(git ls-files '*.cpp' '*.hpp')
"$formatter" --dry-run --Werror "${files[@]}"
printf '%d files are formatted\n' "${#files[@]}"
