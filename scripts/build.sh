#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The SP-SLAM authors
# SPDX-License-Identifier: Apache-2.0
# Configures and builds a preset of CMakePresets.json.
#   scripts/build.sh [PRESET [argument of `cmake --build` ...]]     PRESET is release unless given
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-release}
[ $# -eq 0 ] || shift
cmake --preset "$preset" >build.log 2>&1 || { cat build.log >&2; rm -f build.log; exit 1; }
rm -f build.log
cmake --build --preset "$preset" "$@"
