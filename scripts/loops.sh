#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The SP-SLAM authors
# SPDX-License-Identifier: Apache-2.0
# Closes loops in simulated scenes and prints, in Markdown, for each scene and seed: ATE RMSE in m without and with loop closing, how many
# loops were closed, and how many of them were false: the motion they claim is farther from the true one than 0.5 m.
#   scripts/loops.sh
# From the environment:
#   SCENES   their names (bridge_turn lake_loop)
#   SEEDS    seeds 1 to so many (5)
#   FRAMES   pairs of each run; the whole way unless given
#   OUTPUT   folder for the data and the runs (out/loops); data that are there already are used again
#   SPSLAM   the program (build/release/bin/spslam)
set -euo pipefail
cd "$(dirname "$(realpath "$0")")/.."
. scripts/measuring.sh
read -r -a scenes <<<"${SCENES:-bridge_turn lake_loop}"
seeds=${SEEDS:-5}
output=${OUTPUT:-out/loops}
program=${SPSLAM:-build/release/bin/spslam}
need_program "$program"
length=()
[ -z "${FRAMES:-}" ] || length=(--frames "$FRAMES")

# "closed false" of a run: the newer camera's place in the older one's axes, against the true poses (KITTI rows and their times).
judge() {  # DATA RUN
  awk -F'[ ,]' '
    FILENAME == ARGV[1] { time[FNR] = $1; rows = FNR; next }
    FILENAME == ARGV[2] { for (i = 1; i <= 12; ++i) pose[FNR, i] = $i; next }
    FNR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
    $(column["closed"]) == 1 {
      ++closed
      a = row_at($(column["older_timestamp"])); b = row_at($(column["timestamp"]))
      for (i = 0; i < 3; ++i) way[i] = pose[b, 4 * i + 4] - pose[a, 4 * i + 4]
      off = 0
      for (j = 0; j < 3; ++j) {
        true_place = 0
        for (i = 0; i < 3; ++i) true_place += pose[a, 4 * i + j + 1] * way[i]
        off += ($(column["x"] + j) - true_place) ^ 2
      }
      wrong += sqrt(off) > 0.5
    }
    function row_at(t,    i, best) {
      best = 1
      for (i = 1; i <= rows; ++i) if ((time[i] - t) ^ 2 < (time[best] - t) ^ 2) best = i
      return best
    }
    END { print closed + 0, wrong + 0 }' "$1/times.txt" "$1/poses.txt" "$2/loops.csv"
}

mkdir -p "$output"
echo '| scene | seed | ATE m without loops | with | loops closed | false |'
echo '|---|---|---|---|---|---|'
for scene in "${scenes[@]}"; do
  for ((seed = 1; seed <= seeds; ++seed)); do
    data=$output/$scene.$seed
    [ -f "$data/poses.txt" ] || "$program" simulate "$scene" --seed "$seed" ${length[@]+"${length[@]}"} --output "$data" --overwrite >&2
    for enabled in false true; do
      "$program" run "$data" --sequential --quiet --samples 0 --set loop.enabled=$enabled --output "$data.$enabled" --overwrite
    done
    read -r closed wrong <<<"$(judge "$data" "$data.true")"
    printf '| %s | %d | %.3f | %.3f | %d | %d |\n' "$scene" "$seed" "$(ate_of "$data.false")" "$(ate_of "$data.true")" "$closed" "$wrong"
  done
done
