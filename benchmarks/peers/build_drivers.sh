#!/bin/bash
# usage: build_drivers.sh PEERS_PYTHON OUT
# Compiles the C++ drivers against the headers and libraries inside the wheels, with seacrane's own flags.
# Pinocchio's headers need some minutes; its CMake package cannot be found from the wheel, hence plain g++.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
site=$("$1" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')
out=$2
flags=(-std=c++20 -O3 -DNDEBUG -fno-math-errno "-I$here" "-I$here/../../cpp")
mkdir -p "$out"

mujoco=$(echo "$site"/mujoco/libmujoco.so.*)
g++ "${flags[@]}" "-I$site/mujoco/include" "$here/mujoco_run.cpp" -o "$out/mujoco_run" "$mujoco" \
  "-Wl,-rpath,$site/mujoco"

prefix=$site/cmeel.prefix
g++ "${flags[@]}" -w -DBOOST_MPL_LIMIT_LIST_SIZE=30 -DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS \
  -isystem "$prefix/include" -isystem /usr/include/eigen3 -c "$here/pinocchio_dynamics.cpp" \
  -o "$out/pinocchio_dynamics.o"
integrate=$here/../../cpp/seacrane/integrate
g++ "${flags[@]}" "$here/pinocchio_run.cpp" "$out/pinocchio_dynamics.o" -o "$out/pinocchio_run" \
    "$integrate"/{integrator,error_norm,one_step,adaptive_step,fixed_step,rk4,embedded_pairs}.cpp \
    "-L$prefix/lib" -pthread -lpinocchio_default "-Wl,-rpath,$prefix/lib"
