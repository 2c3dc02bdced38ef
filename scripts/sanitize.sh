#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The SP-SLAM authors
# SPDX-License-Identifier: Apache-2.0
# Builds the tests with AddressSanitizer and UndefinedBehaviorSanitizer (or with ThreadSanitizer) and runs them.
#   scripts/sanitize.sh [asan|tsan] [gtest filter]     without the runs over real sequences unless given
# Each test program runs once as a whole: much quicker than a process a case when a process takes long to start.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-asan}
filter=${2:--RealData.*}
export ASAN_OPTIONS=strict_string_checks=1:detect_stack_use_after_return=1
export UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1
export TSAN_OPTIONS=suppressions=$PWD/tests/tsan.supp
export GTEST_FILTER=$filter GTEST_BRIEF=1

cmake --preset "$preset" -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O2 -g1" >/dev/null
cmake --build --preset "$preset"
find "build/$preset" -type f -name 'test_*' -perm -u+x | sort |
  xargs -P "$(nproc)" -I{} bash -c '
    start=$SECONDS
    if "$1" </dev/null >"$1.log" 2>&1; then echo "$2: $(basename "$1") passed in $((SECONDS - start)) s"
    else cat "$1.log"; echo "$2: $(basename "$1") FAILED"; exit 1; fi' run {} "$preset"
