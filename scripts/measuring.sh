# SPDX-FileCopyrightText: 2026 The SP-SLAM authors
# SPDX-License-Identifier: Apache-2.0
# What the measuring scripts share; to be sourced.

need_program() {  # PROGRAM
  [ -x "$1" ] || { echo "there is no $1; scripts/build.sh release --target spslam_cli makes it" >&2; exit 1; }
}

# ATE RMSE of a run, m.
ate_of() {  # RUN
  awk '/"ate_m"/ { inside = 1 } inside && /"rmse"/ { sub(/,$/, "", $2); print $2; exit }' "$1/metrics.json"
}
