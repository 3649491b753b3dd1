#!/usr/bin/env bash
# Bundles the page's script with three.js. usage: build.sh FOLDER, which gets viewer.js and LICENSE.three.txt
set -euo pipefail
out=$(realpath "$1")
cd "$(dirname "$0")"
[ -d node_modules/three ] || npm ci --no-audit --no-fund
npm run --silent build -- --outfile="$out/viewer.js" --log-level=warning
cp node_modules/three/LICENSE "$out/LICENSE.three.txt"
