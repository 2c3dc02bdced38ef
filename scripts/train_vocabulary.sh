#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The SP-SLAM authors
# SPDX-License-Identifier: Apache-2.0
# Makes config/vocabulary.spv, the vocabulary that is linked into the library: renders all scenes of the simulator with few frames, far
# apart, and trains on their left images. Nothing that is not ours goes in.
#   scripts/train_vocabulary.sh [FILE]
# From the environment:
#   SEEDS   of the scenes (101 102: none that tests or evaluations use)
#   RATE    Hz, frames of a second of the boat's way (0.25)
#   OUTPUT  folder of the sequences (out/vocabulary); those that are there already are used as they are
#   SPSLAM  the program (build/release/bin/spslam)
#   TREE    shape of the tree (--branching 9 --levels 5)
set -euo pipefail
file=${1:+$(realpath -m "$1")}
cd "$(dirname "$(realpath "$0")")/.."
file=${file:-config/vocabulary.spv}
program=${SPSLAM:-build/release/bin/spslam}
output=${OUTPUT:-out/vocabulary}
read -r -a seeds <<<"${SEEDS:-101 102}"
read -r -a tree <<<"${TREE:---branching 9 --levels 5}"
[ -x "$program" ] || { echo "there is no $program; scripts/build.sh release --target spslam_cli makes it" >&2; exit 1; }

sequences=()
for seed in "${seeds[@]}"; do
  for scene in config/scenes/*.yaml; do
    folder=$output/$(basename "$scene" .yaml)_$seed
    sequences+=("$folder")
    [ ! -f "$folder/times.txt" ] || [ -e "$folder/INCOMPLETE" ] || continue
    "$program" simulate "$scene" --seed "$seed" --output "$folder" --overwrite --set rig.rate="${RATE:-0.25}" \
      --set truth.depth_every=0 --set truth.mask_every=0 --set imu.rate=0 --set gnss.rate=0
  done
done
"$program" vocabulary train "${sequences[@]}" --output "$file" "${tree[@]}"
"$program" vocabulary info "$file"
