#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The SP-SLAM authors
# SPDX-License-Identifier: Apache-2.0
# Maps a simulated scene, then localizes another passage in that map, with other waves, other motion and other light, and prints, in Markdown: the map's
# ATE RMSE, and of the passage the share of all frames placed within 0.3 m of the truth and RMSE of those that were placed, three times: in the map
# (against the nearest pose of the run that made it, without the map's own error; with the maximum), in the world with the map laid on it as a whole
# by that run (SE(3)), and in the world with nothing aligned at all, the map beginning where the first camera truly was. A last column looks for
# the passage in the map of the next scene of the list, where no frame may be placed.
#   scripts/localization.sh
# From the environment:
#   SCENES   their names; all eight unless given
#   SEED     of the scenes (1)
#   FRAMES   pairs of each run (150)
#   LIGHT    what differs in the other passage, as `key=value` of the scene
#   CHANGES  options of all runs that differ from the preset's, as `key=value`
#   OUTPUT   folder for the data and the runs (out/localization); data that are there already are used again
#   SPSLAM   the program (build/release/bin/spslam)
set -euo pipefail
cd "$(dirname "$(realpath "$0")")/.."
. scripts/measuring.sh
read -r -a scenes <<<"${SCENES:-bank bridge_turn canal fog_traffic glare lake_loop open_water rain}"
read -r -a light <<<"${LIGHT:-passage=1 sky.sun_azimuth=200 sky.sun_elevation=55 sky.sun=0.5 motion.wave_height=0.2}"
read -r -a changes <<<"${CHANGES:-}"
changes=(${changes[@]+"${changes[@]/#/--set=}"})
seed=${SEED:-1}
frames=${FRAMES:-150}
output=${OUTPUT:-out/localization}
program=${SPSLAM:-build/release/bin/spslam}
need_program "$program"

simulate() {  # SCENE FOLDER [--set KEY=VALUE ...]
  local scene=$1 folder=$2
  shift 2
  [ -f "$folder/poses.txt" ] ||
    "$program" simulate "$scene" --seed "$seed" --frames "$frames" --output "$folder" --overwrite "$@" >&2
}

# "share rmse max" of what a run says, in the world of the map.
errors() {  # RUN MAP_DATA DATA [OPTION ...]
  local run=$1 map=$2 data=$3
  shift 3
  "$program" evaluate "$run/trajectory_tum.txt" "$data/poses.txt" --align none --within 0.3 --json \
    --origin-estimate "$map/world_from_first_camera.txt" --origin-truth "$data/world_from_first_camera.txt" "$@" 2>/dev/null |
    awk '{ value = $2; sub(/,$/, "", value) }
         /"share_within"/ { share = value }
         /"ate_m"/ { inside = 1 }
         inside && /"max"/ { most = value }
         inside && /"rmse"/ { rmse = value; inside = 0 }
         END { if (rmse == "") print "0 - -"; else printf "%.1f %.3f %.3f\n", 100 * share, rmse, most }'
}

mkdir -p "$output"
for scene in "${scenes[@]}"; do
  data=$output/$scene
  simulate "$scene" "$data"
  simulate "$scene" "$data.other" "${light[@]/#/--set=}"
  "$program" run "$data" --sequential --quiet --samples 0 ${changes[@]+"${changes[@]}"} --output "$data.run" --overwrite --save-map "$data.map"
done
echo '| scene | map: ATE RMSE m | in the map: frames within 0.3 m, % | RMSE m | max m | map laid on the world: frames within 0.3 m, % | RMSE m | nothing aligned: frames within 0.3 m, % | RMSE m | frames placed in the wrong map |'
echo '|---|---|---|---|---|---|---|---|---|---|'
# A run that is placed nowhere fails, and is a result here.
for i in "${!scenes[@]}"; do
  data=$output/${scenes[i]} wrong=$output/${scenes[(i + 1) % ${#scenes[@]}]}
  "$program" run "$data.other" --sequential --quiet --samples 0 ${changes[@]+"${changes[@]}"} --output "$data.found" --overwrite --load-map "$data.map" --localize || [ -f "$data.found/frames.csv" ]
  placed=-
  if [ "$data" != "$wrong" ]; then
    "$program" run "$data.other" --sequential --quiet --samples 0 ${changes[@]+"${changes[@]}"} --output "$data.lost" --overwrite --load-map "$wrong.map" --localize || [ -f "$data.lost/frames.csv" ]
    placed=$(awk '!/^#/ { ++count } END { print count + 0 }' "$data.lost/trajectory_tum.txt")
  fi
  by_map=(--map-estimate "$data.run/trajectory_tum.txt" --map-truth "$data/poses.txt")
  read -r _ map_rmse _ <<<"$(errors "$data.run" "$data" "$data" "${by_map[@]}")"
  read -r share rmse most <<<"$(errors "$data.found" "$data" "$data.other" "${by_map[@]}" --map-nearest)"
  read -r share_laid rmse_laid _ <<<"$(errors "$data.found" "$data" "$data.other" "${by_map[@]}")"
  read -r share_none rmse_none _ <<<"$(errors "$data.found" "$data" "$data.other")"
  echo "| ${scenes[i]} | $map_rmse | $share | $rmse | $most | $share_laid | $rmse_laid | $share_none | $rmse_none | $placed |"
done
