#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The SP-SLAM authors
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing of the Debian or Ubuntu packages that the project needs; does nothing when all are there.
#   scripts/install_dependencies.sh          to build, run and test
#   scripts/install_dependencies.sh --ci     also for the sanitizers, the fuzzers and the checks
set -euo pipefail

packages=(
  build-essential cmake ninja-build libopencv-dev libeigen3-dev libtbb-dev libspdlog-dev libfmt-dev zlib1g-dev libjpeg-dev
  libyaml-cpp-dev libcli11-dev nlohmann-json3-dev libceres-dev libembree-dev libgtest-dev libgmock-dev libbenchmark-dev
)
case "${1-}" in
  "") ;;
  --ci) packages+=(clang clang-format clang-tidy libclang-rt-14-dev universal-ctags) ;;
  *) echo "unknown argument '$1'; usage: $0 [--ci]" >&2; exit 2 ;;
esac

if ! command -v dpkg-query >/dev/null; then
  echo "This is not a Debian or Ubuntu machine. Install what these packages contain, then build with cmake:" >&2
  echo "  ${packages[*]}" >&2
  exit 1
fi

missing=()
for package in "${packages[@]}"; do
  if [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" != installed ]; then
    missing+=("$package")
  fi
done
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" != 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "Not root and no sudo here. Ask for: apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "Installing: ${missing[*]}"
"${as_root[@]}" apt-get -q -o Acquire::Retries=3 update
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o Acquire::Retries=3 -o Dpkg::Use-Pty=0 \
  install --no-install-recommends "${missing[@]}" </dev/null
