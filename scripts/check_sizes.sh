#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The SP-SLAM authors
# SPDX-License-Identifier: Apache-2.0
# Fails for files over 400 lines and functions over 80; says which share of the functions keeps within 30. Needs universal-ctags.
set -euo pipefail
cd "$(dirname "$0")/.."
command -v ctags >/dev/null || { echo "ctags is missing: scripts/install_dependencies.sh --ci" >&2; exit 1; }

mapfile -t folders < <(ls -d src include tests bench scripts .ci 2>/dev/null)
mapfile -t files < <(find "${folders[@]}" \( -name '*.h' -o -name '*.cpp' -o -name '*.sh' -o -name '*.py' \
  -o -name CMakeLists.txt -o -path .ci/run \) -type f | sort)
failed=0
wc -l "${files[@]}" | awk '$2 != "total" && $1 > 400 {print $2 ": " $1 " lines, the limit is 400"; bad = 1} END {exit bad}' || failed=1

printf '%s\n' "${files[@]}" | grep -E '\.(h|cpp)$' |
  ctags -L - --languages=C++ --kinds-C++=f --fields=+ne -x --_xformat='%{end} %{line} %{name} %{input}' |
  awk '$1 ~ /^[0-9]+$/ && $2 ~ /^[0-9]+$/ {
         lines = $1 - $2 + 1; ++all; if (lines <= 30) ++short
         if (lines > 80) { print $4 ":" $2 ": " $3 " has " lines " lines, the limit is 80"; bad = 1 }
       }
       END { if (all) printf "sizes: %d functions, %.1f %% of them within 30 lines\n", all, 100 * short / all; exit bad }' || failed=1
exit $failed
