#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The SP-SLAM authors
# SPDX-License-Identifier: Apache-2.0
# Builds the tests with AddressSanitizer and UndefinedBehaviorSanitizer (or with ThreadSanitizer) and runs them.
#   scripts/sanitize.sh [asan|tsan] [gtest filter]     without the long runs unless given
# Those of the command line are left out: they start a process each, and what is behind it is tested without it. Each
# program runs as a whole, or rather in two halves: much quicker than a process a case when a process takes long to start.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-asan}
filter=${2:--RealData.*:System.TheMapGrows*}
export ASAN_OPTIONS=strict_string_checks=1:detect_stack_use_after_return=1
export UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1
export TSAN_OPTIONS=suppressions=$PWD/tests/tsan.supp
export GTEST_FILTER=$filter GTEST_BRIEF=1

cmake --preset "$preset" -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O2 -g1" >/dev/null
# Debian's TBB is not instrumented: ThreadSanitizer does not see how it orders its tasks. On one core it has no workers, and what is left are
# our own threads (tracking, mapping, loops, localization, reading ahead).
export pin=
[ "$preset" != tsan ] || pin="taskset -c 0"
mapfile -t names < <(ninja -C "build/$preset" -t targets all | sed -n 's/^\(test_[a-z0-9_]*\): phony$/\1/p' | grep -v '^test_cli$' | sort)
[ ${#names[@]} -gt 0 ] || { echo "no target is called test_*" >&2; exit 1; }
cmake --build --preset "$preset" --target "${names[@]}"
# The largest first, in two halves, so that no core is left with the longest at the end.
printf '%s\n' "${names[@]}" | while read -r name; do find "build/$preset" -type f -name "$name" -perm -u+x -printf '%s %p\n'; done | sort -rn |
  awk '{ print $2, 0; print $2, 1 }' |
  xargs -P "$(nproc)" -n 2 bash -c '
    start=$SECONDS program=$2 log=$2.$3.log
    if GTEST_TOTAL_SHARDS=2 GTEST_SHARD_INDEX=$3 $pin "$program" </dev/null >"$log" 2>&1; then
      echo "$1: ${program##*/}, half $3, passed in $((SECONDS - start)) s"
    else cat "$log"; echo "$1: ${program##*/}, half $3, FAILED"; exit 1; fi' run "$preset"
