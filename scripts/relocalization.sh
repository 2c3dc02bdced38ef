#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The SP-SLAM authors
# SPDX-License-Identifier: Apache-2.0
# Takes 30 pairs out of the middle of simulated runs while the boat goes on, and prints, in Markdown, how many usable frames pass until the
# boat is found in the map again, the ATE RMSE of the whole run, and the same without the gap.
#   scripts/relocalization.sh
# From the environment:
#   SCENES   their names; all eight unless given
#   SEED     of the scenes (1)
#   FRAMES   pairs of each run (150)
#   FIRST    first of the pairs that are taken out (60)
#   OUTPUT   folder for the data and the runs (out/localization, as scripts/localization.sh has); data that are there already are used again
#   SPSLAM   the program (build/release/bin/spslam)
set -euo pipefail
cd "$(dirname "$(realpath "$0")")/.."
. scripts/measuring.sh
read -r -a scenes <<<"${SCENES:-bank bridge_turn canal fog_traffic glare lake_loop open_water rain}"
seed=${SEED:-1}
frames=${FRAMES:-150}
first=${FIRST:-60}
output=${OUTPUT:-out/localization}
program=${SPSLAM:-build/release/bin/spslam}
need_program "$program"

# Usable frames after the gap until one is tracked, and its reason.
found_after() {  # RUN
  awk -F, -v last=$((first + 29)) '
    NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
    $(column["frame"]) > last {
      ++count
      if ($(column["state"]) == "tracking") { print count " | " $(column["reason"]); exit }
    }' "$1/frames.csv"
}

mkdir -p "$output"
echo '| scene | found after frames | how | ATE m | without the gap |'
echo '|---|---|---|---|---|'
for scene in "${scenes[@]}"; do
  data=$output/$scene
  [ -f "$data/poses.txt" ] ||
    "$program" simulate "$scene" --seed "$seed" --frames "$frames" --output "$data" --overwrite >&2
  rm -rf "$data.gap"
  mkdir "$data.gap"
  cp "$data"/*.txt "$data.gap"
  for eye in image_0 image_1; do
    mkdir "$data.gap/$eye"
    for image in "$data/$eye"/*.png; do
      index=$((10#$(basename "$image" .png)))
      if ((index < first || index >= first + 30)); then ln "$image" "$data.gap/$eye/"; fi
    done
  done
  for run in "$data" "$data.gap"; do
    "$program" run "$run" --sequential --quiet --samples 0 --output "$run.run" --overwrite
  done
  printf '| %s | %s | %.3f | %.3f |\n' "$scene" "$(found_after "$data.gap.run")" "$(ate_of "$data.gap.run")" "$(ate_of "$data.run")"
done
