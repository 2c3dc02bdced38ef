#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The SP-SLAM authors
# SPDX-License-Identifier: Apache-2.0
# Builds the libFuzzer targets (tests/fuzz), with the sanitizers as scripts/sanitize.sh does, and lets each look for crashes for a while.
#   scripts/fuzz.sh [SECONDS in total, 60 unless given]
# A crash leaves its input in build/asan/found and its seed corpus, if it has one, is tests/fuzz/corpus/<target>.
set -euo pipefail
cd "$(dirname "$0")/.."
total=${1:-60}
cmake --preset asan -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O2 -g1" >/dev/null
mapfile -t names < <(ninja -C build/asan -t targets all | sed -n 's/^\(fuzz_[a-z0-9_]*\): phony$/\1/p' | sort -u)
[ ${#names[@]} -gt 0 ] || { echo "no target is called fuzz_*" >&2; exit 1; }
cmake --build --preset asan --target "${names[@]}"

jobs=$(nproc)
export each=$((total * jobs / ${#names[@]} > 0 ? total * jobs / ${#names[@]} : 1))
export UBSAN_OPTIONS=halt_on_error=1
mkdir -p build/asan/found
printf '%s\n' "${names[@]}" | xargs -P "$jobs" -I{} bash -c '
  program=$(find build/asan -type f -name "$1" -perm -u+x)
  grown=build/asan/corpus/$1; seeds=tests/fuzz/corpus/${1#fuzz_}; mkdir -p "$grown"
  corpus=("$grown"); [ ! -d "$seeds" ] || corpus+=("$seeds")
  if "$program" -max_total_time="$each" -timeout=10 -rss_limit_mb=2048 -artifact_prefix=build/asan/found/"$1"- \
      "${corpus[@]}" </dev/null >"$program.log" 2>&1; then
    echo "$1: $(grep -o "Done [0-9]* runs in [0-9]* second(s)" "$program.log")"
  else
    tail -n 60 "$program.log"; echo "$1: FAILED"; exit 1
  fi' run {}
