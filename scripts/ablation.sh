#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The SP-SLAM authors
# SPDX-License-Identifier: Apache-2.0
# Simulates every scene with several seeds, runs the presets on each and prints, in Markdown, the median and the worst of the seeds:
# ATE RMSE in m, s (the factor by which the trajectory would have to be scaled; the worst is the one farthest from 1), and the least
# share of frames tracked. `lost`: too few poses to compare.
#   scripts/ablation.sh
# From the environment:
#   SCENES   their names; all eight unless given
#   SEEDS    seeds 1 to so many (5)
#   FRAMES   pairs of each run (150); 0 for the whole way
#   PRESETS  their names (baseline sp-slam)
#   ALTER    options of all scenes that differ from their files', as `key=value` (air.visibility=80); data in OUTPUT from before are taken
#            as they are, so each ALTER needs an OUTPUT of its own
#   CHANGES  options of all runs that differ from the presets', as `key=value`
#   OUTPUT   folder for the runs (out/ablation); ablation.tsv in it has a line a run; data that are there already are used again
#   KEEP     1 keeps what is rendered, which is removed after its use else
#   SPSLAM   the program (build/release/bin/spslam)
set -euo pipefail
cd "$(dirname "$(realpath "$0")")/.."
. scripts/measuring.sh
read -r -a scenes <<<"${SCENES:-bank bridge_turn canal fog_traffic glare lake_loop open_water rain}"
read -r -a presets <<<"${PRESETS:-baseline sp-slam}"
read -r -a alter <<<"${ALTER:-}"
read -r -a changes <<<"${CHANGES:-}"
seeds=${SEEDS:-5}
frames=${FRAMES:-150}
output=${OUTPUT:-out/ablation}
program=${SPSLAM:-build/release/bin/spslam}
need_program "$program"
length=()
[ "$frames" -eq 0 ] || length=(--frames "$frames")

# "path ATE s": m, m, factor; 1e9 for a run whose errors could not be computed.
errors() {  # FOLDER
  [ -f "$1/metrics.json" ] || { echo "0 1e9 1e9"; return; }
  awk '{ value = $2; sub(/,$/, "", value) }
       /"truth_length_m"/ { path = value }
       /"scale_ratio"/ { scale = value }
       /"ate_m"/ { inside = 1 }
       inside && /"rmse"/ { ate = value; inside = 0 }
       END { print path, ate, scale == "null" ? 1e9 : scale }' "$1/metrics.json"
}

# The share of frames tracked, in %.
tracked() {  # FOLDER
  awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "state") state = i; next }
           { good += $state == "tracking" }
           END { printf "%.0f\n", (NR > 1 ? 100 * good / (NR - 1) : 0) }' "$1/frames.csv"
}

run_scene() {  # SCENE
  local scene=$1 seed preset data run rendered
  for ((seed = 1; seed <= seeds; ++seed)); do
    data=$output/$scene.$seed.data
    rendered=0
    [ -f "$data/poses.txt" ] || {
      rendered=1
      "$program" simulate "$scene" --seed "$seed" ${length[@]+"${length[@]}"} ${alter[@]+"${alter[@]/#/--set=}"} --output "$data" --overwrite >&2
    }
    for preset in "${presets[@]}"; do
      run=$output/$scene.$seed.$preset
      "$program" run "$data" --preset "$preset" --sequential --quiet --output "$run" --overwrite ${changes[@]+"${changes[@]/#/--set=}"} ||
        [ -f "$run/frames.csv" ] # no frame tracked is a result too
      echo "$scene $seed $preset $(errors "$run") $(tracked "$run")" >>"$output/ablation.tsv"
    done
    [ "$rendered" = 0 ] || [ "${KEEP:-0}" = 1 ] || rm -r "$data"
  done
}

# The row of a scene from the lines of its runs: scene seed preset path ATE s tracked.
row() {  # SCENE
  awk -v scene="$1" -v presets="${presets[*]}" '
    function text(value, digits) { return value >= 1e8 ? "lost" : sprintf("%." digits "f", value) }
    function distance(s) { return s >= 1 ? s - 1 : 1 - s }
    function summary(values, n, centre, digits,    i, j, held, worst) {
      worst = values[1]
      for (i = 1; i <= n; ++i) {
        if (centre ? distance(values[i]) > distance(worst) : values[i] > worst) worst = values[i]
        held = values[i]
        for (j = i - 1; j > 0 && values[j] > held; --j) values[j + 1] = values[j]
        values[j + 1] = held
      }
      held = n % 2 ? values[(n + 1) / 2] : (values[n / 2] + values[n / 2 + 1]) / 2
      return text(held, digits) " / " text(worst, digits)
    }
    $1 == scene {
      n = ++count[$3]; ates[$3, n] = $5; scales[$3, n] = $6
      if (n == 1 || $7 < least[$3]) least[$3] = $7
      if ($4 > path) path = $4
    }
    END {
      line = sprintf("| %s | %.1f |", scene, path)
      split(presets, names, " ")
      for (p = 1; p in names; ++p) {
        name = names[p]
        for (i = 1; i <= count[name]; ++i) { ate[i] = ates[name, i]; s[i] = scales[name, i] }
        line = line " " summary(ate, count[name], 0, 3) " | " summary(s, count[name], 1, 4) " | " least[name] " |"
      }
      print line
    }' "$output/ablation.tsv"
}

mkdir -p "$output"
: >"$output/ablation.tsv"
printf '| scene | path m |'
printf ' %s: ATE m, median / worst | s | tracked %% |' "${presets[@]}"
printf '\n|---|---|'
printf '%s' "${presets[@]/*/---|---|---|}"
echo
for scene in "${scenes[@]}"; do
  run_scene "$scene"
  row "$scene"
done
