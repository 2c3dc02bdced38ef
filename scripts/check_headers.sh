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
for file in "${files[@]}"; do
  if [ "$(head -n 3 "$file" | grep -c -E 'SPDX-(FileCopyrightText: 2026 The SP-SLAM authors|License-Identifier: Apache-2.0)$')" != 2 ]; then
    echo "$file: the two SPDX lines are missing at the top"; failed=1
  fi
done
for file in "${files[@]}"; do
  case "$file" in *.h) grep -q '^#pragma once$' "$file" || { echo "$file: no #pragma once"; failed=1; } ;; esac
done

# The brackets keep the patterns from matching this very file.
if grep -n -w -i -E 'TO[D]O|FIX[M]E|XX[X]|not[ ]implemented|place[h]older|du[m]my' "${files[@]}"; then
  echo "unfinished work is marked above: finish it or file an issue"; failed=1
fi
if grep -n -E '(^|[^.[:alnum:]_$}])/([w]ork|[r]oot|[h]ome)/' "${files[@]}"; then
  echo "paths of one machine above: make them relative or arguments"; failed=1
fi
[ $failed = 1 ] || echo "headers: ${#files[@]} files"
exit $failed
