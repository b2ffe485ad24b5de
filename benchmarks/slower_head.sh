#!/bin/sh
# Builds a program whose frames take about 5 % longer in each of the cells that `false_alarms` times, in FOLDER/source:
#   benchmarks/slower_head.sh FOLDER
# Then: false_alarms --base shadowbench --head FOLDER/source/build/release/shadowbench --name slower-5 …
set -eu
here=$(cd "$(dirname "$0")/.." && pwd)
git clone -q --shared "$here" "$1/source"
cd "$1/source"
git apply benchmarks/slower-head.patch
cmake -S . -B build/release -G Ninja -DCMAKE_BUILD_TYPE=Release -DSHADOWBENCH_TESTS=OFF -DSHADOWBENCH_BENCHMARKS=OFF >/dev/null
cmake --build build/release --target shadowbench >/dev/null
echo "$PWD/build/release/shadowbench"
