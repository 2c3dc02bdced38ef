#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The SP-SLAM authors
# SPDX-License-Identifier: Apache-2.0
# Runs every code block of README.md that is tagged `sh`, in order, in a scratch directory, so that what the page tells is true.
#   scripts/run_readme.sh [README.md]
# The scratch directory has the tree's folders as links; `spslam` is found as after an installation. A block that is nothing but
# scripts/test.sh is left to .ci/run, which runs it anyway.
set -euo pipefail
page=$(realpath "${1:-"$(dirname "$0")/../README.md"}")
root=$(realpath "$(dirname "$0")/..")
scratch=$root/build/readme
rm -rf "$scratch"
mkdir -p "$scratch"
cd "$scratch"
ln -s "$root"/* .
rm -f build out
export PATH=$root/build/release/bin:$PATH

awk '/^```sh$/ { name = sprintf("block_%02d.sh", ++count); inside = 1; next }
     /^```/ { inside = 0; next }
     inside { print > name }' "$page"

count=0
for block in block_*.sh; do
  [ -e "$block" ] || break
  if [ "$(cat "$block")" = scripts/test.sh ]; then continue; fi
  echo "== README block:"
  sed 's/^/   $ /' "$block"
  bash -euo pipefail "$block" </dev/null
  count=$((count + 1))
done
[ $count -gt 0 ] || { echo "no sh block in $page was run" >&2; exit 1; }
echo "readme: $count blocks ran"
