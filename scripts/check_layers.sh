#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The SP-SLAM authors
# SPDX-License-Identifier: Apache-2.0
# Fails when a folder of src/spslam includes a header of a folder that comes later in the pipeline. The order is the one in
# which CMakeLists.txt adds the folders.
set -euo pipefail
cd "$(dirname "$0")/.."

order=$(sed -n '/^foreach(folder/,/)/p' CMakeLists.txt | tr -d '()' | tr '\n' ' ' | sed 's/^foreachfolder//')
[ -n "$order" ] || { echo "no foreach(folder ...) in CMakeLists.txt" >&2; exit 1; }

# include/spslam/*.h are for users: they stand on the floor of `system`.
mapfile -t folders < <(ls -d src/spslam include 2>/dev/null)
find "${folders[@]}" -name '*.h' -o -name '*.cpp' | sort | xargs awk -v order="$order" '
  BEGIN { count = split(order, names, " "); for (i = 1; i <= count; ++i) rank[names[i]] = i }
  FNR == 1 {
    parts = split(FILENAME, path, "/")
    own = path[1] == "src" && parts > 3 ? path[3] : "system"
    if (!(own in rank)) { print FILENAME ": folder " own " has no place in the order of CMakeLists.txt"; bad = 1; nextfile }
  }
  /^[ \t]*#[ \t]*include[ \t]*[<"]spslam\// {
    header = $0; sub(/^[^<"]*[<"]/, "", header); sub(/[>"].*$/, "", header)
    parts = split(header, path, "/")
    other = parts > 2 ? path[2] : "system"
    if (!(other in rank)) { print FILENAME ":" FNR ": unknown folder in " header; bad = 1 }
    else if (rank[other] > rank[own]) { print FILENAME ":" FNR ": " own " may not include " header ", which is above it"; bad = 1 }
  }
  END { exit bad }' || { echo "The order, lowest first: $order" >&2; exit 1; }
echo "layers: every folder includes only itself and lower ones"
