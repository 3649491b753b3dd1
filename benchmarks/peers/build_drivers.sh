#!/bin/bash
# usage: build_drivers.sh PEERS_PYTHON OUT
# Compiles MuJoCo's driver against the header and library inside its wheel, with seacrane's own flags.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
site=$("$1" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')
out=$2
flags=(-std=c++20 -O3 -DNDEBUG -fno-math-errno "-I$here")
mkdir -p "$out"

mujoco=$(echo "$site"/mujoco/libmujoco.so.*)
g++ "${flags[@]}" "-I$site/mujoco/include" "$here/mujoco_run.cpp" -o "$out/mujoco_run" "$mujoco" \
  "-Wl,-rpath,$site/mujoco"
