#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The SP-SLAM authors
# SPDX-License-Identifier: Apache-2.0
# clang-tidy over our own sources, or over the files given.
#   scripts/lint.sh [FILE.cpp ...]
# The compile commands come from a clang configuration of their own, because clang cannot read gcc's precompiled header.
set -euo pipefail
cd "$(dirname "$0")/.."
cmake -S . -B build/lint -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DSPSLAM_PRECOMPILED_HEADERS=OFF -DSPSLAM_BUILD_TESTS=OFF \
  -DSPSLAM_BUILD_BENCH=OFF >/dev/null
if [ $# -eq 0 ]; then
  mapfile -t files < <(find src -name '*.cpp' | sort)
else
  files=("$@")
fi
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$(nproc)" clang-tidy -p build/lint --quiet 2> >(grep -v 'warnings generated' >&2)
echo "lint: ${#files[@]} files"
