#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The SP-SLAM authors
# SPDX-License-Identifier: Apache-2.0
# Installs a build into an empty prefix and builds a user's project (tests/consumer) against it.
#   scripts/check_consumer.sh BUILD_DIR
set -euo pipefail
[ $# = 1 ] || { echo "usage: $0 BUILD_DIR" >&2; exit 2; }
build=$(realpath "$1")
cd "$(dirname "$0")/.."

scratch=$build/consumer
rm -rf "$scratch"
cmake --install "$build" --prefix "$scratch/prefix" >/dev/null
# Nothing of this machine's source tree may be left in what was installed.
if grep -r -l -F "$PWD/" "$scratch/prefix" --include='*.cmake' --include='*.h'; then
  echo "the installed files above point back into the source tree" >&2
  exit 1
fi
cmake -S tests/consumer -B "$scratch/build" -G Ninja -DCMAKE_PREFIX_PATH="$scratch/prefix" -DCMAKE_BUILD_TYPE=Release >/dev/null
cmake --build "$scratch/build"
"$scratch/build/consumer"
if [ -x "$scratch/prefix/bin/spslam" ]; then
  "$scratch/prefix/bin/spslam" --version
fi
