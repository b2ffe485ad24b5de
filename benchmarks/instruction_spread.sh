#!/bin/sh
# Counts the frame of every technique again and again and reports how much the counts differ:
#   benchmarks/instruction_spread.sh BUILD RUNS FOLDER [REPORT]
# The scenes are dueling frusta and overlapping occluders in small pictures, and filtered maps are small: the same code in a
# tenth of the time. Levels of detail are counted on simple. A folder that holds some of the runs gets the others.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
build=$1 runs=$2 folder=$3
hard="sm-* volume-* pcf* none planar-hard planar-fake vsm:map=256 lvsm:map=256 esm:map=256 csm-fourier:map=256 deep-sm:map=128"
soft="planar-soft:n=8 pcss sampled-maps:n=8 temporal-soft"

count() { # scene, techniques, folder
    set -f # patterns are the program's
    techniques=$(for technique in $2; do printf -- '--technique %s ' "$technique"; done)
    # shellcheck disable=SC2086 # a list of words
    "$build/shadowbench" run --quiet --scene "$1" $techniques --cost instructions --out "$3" >/dev/null
    set +f
}

list=
for i in $(seq "$runs"); do
    run="$folder/$i"
    list="$list $run"
    [ -s "$run/results.jsonl" ] && continue
    count "$here/small-frusta.toml" "$hard" "$run/hard"
    count "$here/small-occluders.toml" "$soft" "$run/soft"
    count simple 'lod-*' "$run/lod"
    cat "$run"/*/results.jsonl >"$run/results.jsonl"
    echo "run $i of $runs" >&2
done
# shellcheck disable=SC2086
exec "$build/instruction_spread" $list ${4:+--out "$4"}
