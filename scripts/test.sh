#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The SP-SLAM authors
# SPDX-License-Identifier: Apache-2.0
# From a bare Debian 12 to the result of all tests: installs what is missing, builds, runs every test.
#   scripts/test.sh [argument of ctest ...]      for example: scripts/test.sh -R '^camera'
# Tests that need the sequences beside the repository (../shared/data) skip without them and say so.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/install_dependencies.sh
scripts/build.sh release
ctest --preset release --parallel "$(nproc)" "$@"
