#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The SP-SLAM authors
# SPDX-License-Identifier: Apache-2.0
# Fails when the documentation names what does not exist: a relative link, a file of the tree, a script, a subcommand or an option of
# `spslam`, a key of --set.
#   scripts/check_docs.sh [PROGRAM]      PROGRAM is build/release's spslam unless given; without one, commands are not checked
set -euo pipefail
program=${1:+$(realpath -m "$1")}
cd "$(dirname "$0")/.."
: "${program:=$PWD/build/release/bin/spslam}"
mapfile -t pages < <(find . \( -name .git -o -name build -o -name out -o -name node_modules \) -prune -o -name '*.md' -print | sort)
failed=0
complain() { echo "$1"; failed=1; }

check_links() {  # PAGE
  local target
  while read -r target; do
    case "$target" in http://* | https://* | mailto:* | '#'* | '') continue ;; esac
    [ -e "$(dirname "$1")/${target%%#*}" ] || complain "$1: the link to $target leads nowhere"
  done < <(grep -v '^ *```' "$1" | grep -o -E '\]\([^) ]+|(src|href)="[^"]+' | sed -E 's/^(\]\(|src="|href=")//')
}

# The code of a page: fenced blocks line by line, and inline code.
code_of() {  # PAGE
  awk '/^ *```/ { fenced = !fenced; next }
       fenced { print; next }
       { line = $0; while (match(line, /`[^`]+`/)) { print substr(line, RSTART + 1, RLENGTH - 2); line = substr(line, RSTART + RLENGTH) } }' "$1"
}

check_paths() {  # PAGE
  local path
  while read -r path; do
    [ -e "$path" ] || complain "$1: there is no $path"
  done < <(code_of "$1" | grep -o -E '(^|[ (])(src|include|tests|bench|docs|config|cmake|scripts|web)/[A-Za-z0-9_./-]+([^A-Za-z0-9_./<*{-]|$)' |
    sed -E 's/^[ (]//; s/[^A-Za-z0-9_\/-]+$//' | sort -u)
}

declare -A help_of
help_for() {  # SUBCOMMAND: its help, asked once; "" if there is no such subcommand
  if [ -z "${help_of[$1]+asked}" ]; then
    help_of[$1]=""
    if grep -q -E "^  $1( |\$)" <<<"$subcommands"; then help_of[$1]=$("$program" "$1" --help); fi
  fi
}

check_commands() {  # PAGE
  local command subcommand option key
  while read -r command; do
    read -r _ subcommand _ <<<"$command"
    help_for "$subcommand"
    if [ -z "${help_of[$subcommand]}" ]; then
      complain "$1: spslam has no subcommand '$subcommand' ($command)"
      continue
    fi
    while read -r option; do
      grep -q -E -e "(^|[ ,])$option([^a-z-]|$)" <<<"${help_of[$subcommand]}" || complain "$1: spslam $subcommand has no $option"
    done < <(grep -o -E -e '--[a-z][a-z-]*' <<<"$command" | sort -u)
    while read -r key; do
      [ "$key" = key ] || grep -q -E -e "^ *${key//./\\.}( |:|=|$)" <<<"$options" || complain "$1: there is no option key '$key'"
    done < <(grep -o -E -e '--set +[a-z0-9_.]+=' <<<"$command" | sed -E 's/^--set +//; s/=$//' | sort -u)
  done < <(code_of "$1" | grep -o -E '(^|[ /;(])spslam +[a-z][a-z-]+( [^|;&#]*)?' | sed -E 's/^[ \/;(]//' | sort -u)
}

options="" subcommands=""
if [ -x "$program" ]; then
  subcommands=$("$program" --help | sed -n '/^Subcommands:/,$p')
  # The keys of --set: those of a run and those of a simulated scene.
  options=$("$program" config --print && "$program" simulate bank --print) || complain "spslam cannot print its options"
else
  echo "no program at $program: commands are not checked"
fi
for page in "${pages[@]}"; do
  check_links "$page"
  check_paths "$page"
  [ ! -x "$program" ] || check_commands "$page"
done
[ $failed = 1 ] || echo "docs: ${#pages[@]} pages"
exit $failed
