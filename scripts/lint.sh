#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The SP-SLAM authors
# SPDX-License-Identifier: Apache-2.0
# clang-tidy over our own sources, or over the files given.
#   scripts/lint.sh [FILE.cpp ...]
# The compile commands come from a clang configuration of their own, because clang cannot read gcc's precompiled header. All sources are
# read a dozen at once, as CMake's unity build has them: most of the time goes into the headers of the libraries.
set -euo pipefail
cd "$(dirname "$0")/.."
unity=OFF
[ $# -gt 0 ] || unity=ON
cmake -S . -B build/lint -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DSPSLAM_PRECOMPILED_HEADERS=OFF -DSPSLAM_BUILD_TESTS=OFF \
  -DSPSLAM_BUILD_BENCH=OFF -DCMAKE_UNITY_BUILD=$unity -DCMAKE_UNITY_BUILD_BATCH_SIZE=12 >/dev/null
if [ $# -eq 0 ]; then
  mapfile -t files < <(sed -n 's/^ *"file": "\(.*\)".*/\1/p' build/lint/compile_commands.json | sort -u)
else
  files=("$@")
fi
[ ${#files[@]} -gt 0 ] || { echo "lint: there is nothing to read" >&2; exit 1; }
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$(nproc)" clang-tidy -p build/lint --quiet --checks=-bugprone-suspicious-include \
  2> >(grep -v 'warnings generated' >&2)
echo "lint: ${#files[@]} translation units"
