#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The SP-SLAM authors
# SPDX-License-Identifier: Apache-2.0
# Makes the tables of docs/RESULTS.md: runs the presets, or one changed switch after the other, on the sequences and prints Markdown.
#   scripts/results.sh              presets sp-slam, paper, baseline
#   scripts/results.sh --ablation   sp-slam with one thing changed a row
#   scripts/results.sh --threads    sp-slam with its threads side by side, RUNS (10) times, against the sequential run: as a recording is
#                                   run, and with tracking let run ahead of the map
# From the environment:
#   DATA       folder of the sequences (../shared/data); those that are not there are left out
#   SEQUENCES  their names; all known ones unless given
#   RUNS       runs of each (1); from two on, runs whose trajectories differ end it with an error, and the least times count
#   OUTPUT     folder for the runs (out/results)
#   SPSLAM     the program (build/release/bin/spslam)
set -euo pipefail
cd "$(dirname "$(realpath "$0")")/.."
. scripts/measuring.sh
data=${DATA:-../shared/data}
runs=${RUNS:-1}
output=${OUTPUT:-out/results}
program=${SPSLAM:-build/release/bin/spslam}
read -r -a known <<<"${SEQUENCES:-nearshore_bank nearshore_loop kitti_06 kitti_raw euroc_still}"
need_program "$program"
sequences=()
for name in "${known[@]}"; do [ ! -d "$data/$name" ] || sequences+=("$name"); done
[ ${#sequences[@]} -gt 0 ] || { echo "none of ${known[*]} is in $data; DATA=FOLDER names another" >&2; exit 1; }

# Runs a sequence RUNS times into $output/NAME.1, .2, ...
track() {  # SEQUENCE NAME [argument of `spslam run` ...]
  local sequence=$1 name=$2 run
  shift 2
  for ((run = 1; run <= runs; ++run)); do
    "$program" run "$data/$sequence" --output "$output/$name.$run" --overwrite --sequential --quiet "$@"
    cmp "$output/$name.1/trajectory_tum.txt" "$output/$name.$run/trajectory_tum.txt" >&2
  done
}

# "ATE scale t_rel path": m, factor, %, m; "-" for what there is not. Without truth (the vehicle stands still) the first is the
# farthest that the trajectory goes from its start.
accuracy() {  # SEQUENCE NAME
  local run=$output/$2.1 truth=$data/$1/poses.txt
  if [ ! -f "$truth" ]; then
    awk '/^#/ { next }
         !started++ { x = $2; y = $3; z = $4 }
         { d = sqrt(($2 - x)^2 + ($3 - y)^2 + ($4 - z)^2); if (d > far) far = d }
         END { printf "%.4f - - 0\n", far }' "$run/trajectory_tum.txt"
    return
  fi
  "$program" evaluate "$run/trajectory_tum.txt" "$truth" | awk '
    /^path length/ { for (i = 1; i < NF; ++i) if ($(i + 2) ~ /^true/) path = $i }
    /scale ratio/ { sub(/.*scale ratio /, ""); scale = $1 }
    /^ATE/ { ate = $5 }
    /^KITTI t_rel/ { t_rel = $3 }
    END { printf "%s %s %s %.1f\n", ate == "" ? "-" : sprintf("%.4f", ate), scale == "" ? "-" : sprintf("%.4f", scale), t_rel == "" ? "-" : sprintf("%.2f", t_rel), path }'
}

# "p50 p95 rss" of the run of least median: ms a tracked frame without decoding, MB.
cost() {  # NAME
  awk 'FNR == 1 { total = 0 }
       /"total":/ { total = 1 }
       { value = $2; sub(/,$/, "", value) }
       /"peak_rss_mb"/ { rss = value }
       total && /"p50"/ { p50 = value }
       total && /"p95"/ { if (best == "" || p50 < best) { best = p50; p95 = value; memory = rss } }
       END { printf "%.1f %.1f %.0f\n", best, p95, memory }' "$output/$1".*/timing.json
}

presets() {
  echo "| sequence | path m | preset | ATE RMSE m | s | t_rel % | tracking ms, median / p95 | peak RSS MB |"
  echo "|---|---|---|---|---|---|---|---|"
  local sequence preset ate scale t_rel path p50 p95 rss
  for sequence in "${sequences[@]}"; do
    for preset in sp-slam paper baseline; do
      track "$sequence" "$sequence.$preset" --preset "$preset"
      read -r ate scale t_rel path < <(accuracy "$sequence" "$sequence.$preset")
      read -r p50 p95 rss < <(cost "$sequence.$preset")
      echo "| $sequence | $path | $preset | $ate | $scale | $t_rel | $p50 / $p95 | $rss |"
    done
  done
}

# "median | least | most" of the ATE of RUNS runs into $output/NAME.1, each over the one before.
ates_of() {  # SEQUENCE NAME [argument of `spslam run` ...]
  local sequence=$1 name=$2 run ate
  shift 2
  for ((run = 1; run <= runs; ++run)); do
    "$program" run "$data/$sequence" --output "$output/$name.1" --overwrite --quiet "$@"
    read -r ate _ < <(accuracy "$sequence" "$name")
    echo "$ate"
  done | sort -g | awk '
      { v[NR] = $1 }
      END { m = NR % 2 ? v[(NR + 1) / 2] : (v[NR / 2] + v[NR / 2 + 1]) / 2
            printf "%.4f | %.4f | %.4f", m, v[1], v[NR] }'
}

threads() {
  local sequence ate mapping waiting ahead
  [ "$runs" -gt 1 ] || runs=10
  echo "| sequence | sequential ATE RMSE m | threads: median | least | most | \`--ahead\`: median | least | most | mapping ms a keyframe beside tracking, median / p95 |"
  echo "|---|---|---|---|---|---|---|---|---|"
  for sequence in "${sequences[@]}"; do
    [ -f "$data/$sequence/poses.txt" ] || continue
    "$program" run "$data/$sequence" --output "$output/$sequence.once.1" --overwrite --sequential --quiet
    waiting=$(ates_of "$sequence" "$sequence.threads")
    ahead=$(ates_of "$sequence" "$sequence.ahead" --ahead)
    mapping=$(awk -F, 'NR > 1 { print $2 }' "$output/$sequence.ahead.1/mapping.csv" | sort -g |
      awk '{ v[NR] = $1 } END { printf "%.1f / %.1f", v[int((NR + 1) / 2)], v[int(NR * 0.95 + 0.5)] }')
    read -r ate _ < <(accuracy "$sequence" "$sequence.once")
    echo "| $sequence | $ate | $waiting | $ahead | $mapping |"
  done
}

ablation_row() {  # TITLE [key=value ...]
  local title=$1 sequence setting name line ate scale
  local arguments=()
  shift
  for setting in "$@"; do arguments+=(--set "$setting"); done
  line="| $title |"
  for sequence in "${sequences[@]}"; do
    name=$sequence.$(tr -c 'a-z0-9\n' _ <<<"${*:-none}")
    track "$sequence" "$name" ${arguments[@]+"${arguments[@]}"}
    read -r ate scale _ < <(accuracy "$sequence" "$name")
    line+=" $ate ($scale) |"
  done
  echo "$line"
}

ablation() {
  printf '| changed |'
  printf ' %s |' "${sequences[@]}"
  printf '\n|---|'
  printf '%s' "${sequences[@]/*/---|}"
  echo
  ablation_row "nothing"
  local change
  for change in segment=false far.enabled=false trial.enabled=false movers.enabled=false alignment.noise_factor=0 rig.estimate=false \
    window_frames=1 window_frames=5 keyframe.entropy=false recall.enabled=false follow.soft_sigma=0.7 landmarks.levels=8 motion.loss=pseudo-huber motion.loss=huber window.loss=pseudo-huber stereo_by_descriptor=true; do
    ablation_row "\`tracker.$change\`" "tracker.$change"
  done
  for change in retriangulation.enabled=false adjustment.enabled=false adjustment.solver.loss=pseudo-huber \
    adjustment.uniform_weights=false culling.enabled=false triangulation.enabled=true duplicates.enabled=true; do
    ablation_row "\`mapper.$change\`" "mapper.$change"
  done
  ablation_row "\`tracker.follow.identity=descriptor\`" tracker.follow.identity=descriptor
  ablation_row "... and \`tracker.follow.align=false\`" tracker.follow.identity=descriptor tracker.follow.align=false
}

mkdir -p "$output"
case "${1:-}" in
  "") presets ;;
  --ablation) ablation ;;
  --threads) threads ;;
  *) echo "usage: scripts/results.sh [--ablation | --threads]" >&2; exit 2 ;;
esac
