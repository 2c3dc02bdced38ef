#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The SP-SLAM authors
# SPDX-License-Identifier: Apache-2.0
# Fails when clang-format would change a file. With --fix it changes them.
set -euo pipefail
cd "$(dirname "$0")/.."
mapfile -t folders < <(ls -d src include tests bench 2>/dev/null)
sources() { find "${folders[@]}" \( -name '*.h' -o -name '*.cpp' \) -print0; }

if [ "${1-}" = --fix ]; then
  sources | xargs -0 -r -n 16 -P "$(nproc)" clang-format -i
  exit
fi
if ! report=$(sources | xargs -0 -r -n 16 -P "$(nproc)" clang-format --dry-run -Werror 2>&1); then
  echo "places that clang-format would change (scripts/check_format.sh --fix changes them):"
  sed -n 's/^\([^ :]*\):[0-9]*:.*clang-format-violations\]$/\1/p' <<<"$report" | sort | uniq -c
  exit 1
fi
echo "format: as .clang-format says"
