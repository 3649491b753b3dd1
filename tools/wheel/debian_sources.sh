#!/usr/bin/env bash
# Fetches the source archives of SUNDIALS and Eigen as Debian or Ubuntu keep them. usage: debian_sources.sh FOLDER
# The system's own sources, asked for source packages, are copied into a configuration of this folder: nothing of
# the system changes, and nobody needs to be root.
set -euo pipefail
mkdir -p "$1"
cd "$1"
mkdir -p apt/parts apt/lists/partial apt/cache/archives/partial
for file in /etc/apt/sources.list.d/{debian,ubuntu}.sources; do
  [ ! -e "$file" ] || sed 's/^Types:.*/Types: deb-src/' "$file" > "apt/parts/$(basename "$file")"
done
[ ! -e /etc/apt/sources.list ] || sed -n 's/^deb /deb-src /p' /etc/apt/sources.list > apt/sources.list
apt_here=(-qq
  -o Dir::Etc::SourceList="$PWD/apt/sources.list" -o Dir::Etc::SourceParts="$PWD/apt/parts"
  -o Dir::State::Lists="$PWD/apt/lists" -o Dir::Cache="$PWD/apt/cache" -o APT::Sandbox::User="$(id -un)")
apt-get "${apt_here[@]}" update </dev/null
apt-get "${apt_here[@]}" source --download-only sundials eigen3 </dev/null
rm -rf apt
