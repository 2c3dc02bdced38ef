#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The SP-SLAM authors
# SPDX-License-Identifier: Apache-2.0
# From a bare Debian 12 to a trajectory, its error and a report: installs what is missing, builds, simulates a run along a bank,
# tracks it, evaluates it.
#   scripts/demo.sh [FOLDER]      FOLDER (out/demo unless given) gets data/, run/ and the report
# SPSLAM_DEMO_FRAMES sets the length, 120 pairs unless given.
set -euo pipefail
here=$PWD
cd "$(dirname "$(realpath "$0")")/.."
out=$(cd "$here" && realpath -m "${1:-$PWD/out/demo}")
frames=${SPSLAM_DEMO_FRAMES:-120}
program=build/release/bin/spslam

scripts/install_dependencies.sh
scripts/build.sh release --target spslam_cli

rm -rf "$out/data" "$out/run"
mkdir -p "$out"
data=$out/data
"$program" simulate bank --frames "$frames" --output "$data"
"$program" run "$data" --output "$out/run" --sequential
"$program" evaluate "$out/run/trajectory_kitti.txt" "$data/poses.txt"
"$program" report "$out/run" --truth "$data/poses.txt" --output "$out/report.html"
echo
echo "Trajectory, times and log: $out/run"
echo "Report to look at:         $out/report.html"
