#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The SP-SLAM authors
# SPDX-License-Identifier: Apache-2.0
# Fails for a source file without its two SPDX lines, a header without #pragma once, a word that marks unfinished work, and a path
# of one machine.
set -euo pipefail
cd "$(dirname "$0")/.."
failed=0

mapfile -t files < <(find . \( -name .git -o -name build -o -name out -o -name node_modules \) -prune -o -type f \
  \( -name '*.h' -o -name '*.cpp' -o -name '*.cmake' -o -name CMakeLists.txt -o -name '*.sh' -o -name '*.py' -o -path ./.ci/run \) -print | sort)
awk 'FNR <= 3 && /SPDX-(FileCopyrightText: 2026 The SP-SLAM authors|License-Identifier: Apache-2.0)$/ { ++spdx[FILENAME] }
     /^#pragma once$/ { once[FILENAME] = 1 }
     END { for (i = 1; i < ARGC; ++i) {
             if (spdx[ARGV[i]] != 2) { print ARGV[i] ": the two SPDX lines are missing at the top"; bad = 1 }
             if (ARGV[i] ~ /[.]h$/ && !once[ARGV[i]]) { print ARGV[i] ": no #pragma once"; bad = 1 }
           }
           exit bad }' "${files[@]}" || failed=1

# The brackets keep the patterns from matching this very file.
if grep -n -w -i -E 'TO[D]O|FIX[M]E|XX[X]|not[ ]implemented|place[h]older|du[m]my' "${files[@]}"; then
  echo "unfinished work is marked above: finish it or file an issue"; failed=1
fi
if grep -n -E '(^|[^.[:alnum:]_$}])/([w]ork|[r]oot|[h]ome)/' "${files[@]}"; then
  echo "paths of one machine above: make them relative or arguments"; failed=1
fi
[ $failed = 1 ] || echo "headers: ${#files[@]} files"
exit $failed
