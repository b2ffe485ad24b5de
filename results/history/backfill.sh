#!/bin/sh
# Measures past commits and takes their records into the history:
#   results/history/backfill.sh [COMMIT …]     default: the commits below; those that the history holds are left out
# Each commit is checked out, built and run in a scratch clone ($SHADOWBENCH_BACKFILL or a folder of /tmp, kept for the next
# time), with a cache of references of its own, so that nothing else here changes. $JOBS compilers run at once (default: 2).
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
scratch=${SHADOWBENCH_BACKFILL:-/tmp/shadowbench-backfill}
source=$scratch/source

# First parents of main, from the first that the present program reads the records of.
commits='64331f8 d41c407 9afa401 1e4b952 97b5d2b 535dca6 256d0e6 dfd9b11 ca1fe33 b3e9328 6536706 4e1abb3 12d2dab'
techniques='sm-uniform sm-focused sm-lispsm sm-psm sm-history volume-zpass volume-zfail volume-xor pcf pcss'
scenes='dueling-frusta overlapping-occluders'

build() {
    [ -d "$source" ] || git clone --quiet --shared --no-checkout "$root" "$source"
    git -C "$source" -c advice.detachedHead=false checkout --quiet --force "$1"
    mkdir -p "$source/build/release"
    # With this base, compilers' results are shared with other clones.
    export CCACHE_BASEDIR="$source" CCACHE_NOHASHDIR=1
    cmake -S "$source" -B "$source/build/release" -G Ninja -DCMAKE_BUILD_TYPE=Release -DSHADOWBENCH_TESTS=OFF \
        -DSHADOWBENCH_BENCHMARKS=OFF >"$scratch/build.log" 2>&1 || return 1
    nice ninja -C "$source/build/release" -j "${JOBS:-2}" shadowbench >>"$scratch/build.log" 2>&1
}

# What the checked-out program knows of the techniques, without wall times, and with instructions if it can count them.
measure() {
    program=$source/build/release/shadowbench
    known=$("$program" list techniques)
    options=--no-time
    if "$program" run --help | grep -q -- --cost; then options='--cost instructions'; fi
    for technique in $techniques; do
        if echo "$known" | grep -qx "$technique"; then options="$options --technique $technique"; fi
    done
    # shellcheck disable=SC2046,SC2086 # lists of words
    nice "$program" run --quiet $options $(printf ' --scene %s' $scenes) --cache "$scratch/cache" --out "$1"
}

[ $# -gt 0 ] || eval "set -- $commits"
mkdir -p "$scratch"
for commit in "$@"; do
    hash=$(git -C "$root" rev-parse --verify --quiet "$commit^{commit}") ||
        { echo "backfill.sh: there is no commit $commit" >&2; exit 2; }
    if ls "$root/results/history/"*"-$(echo "$hash" | cut -c1-12)-"*.jsonl >/dev/null 2>&1; then continue; fi
    out=$scratch/records/$hash
    if [ ! -f "$out/results.jsonl" ]; then
        echo "backfill.sh: $(git -C "$root" log -1 --format='%h %s' "$hash")" >&2
        build "$hash" || { echo "backfill.sh: $commit does not build; see $scratch/build.log" >&2; continue; }
        measure "$out.new" >"$scratch/run.log" || { echo "backfill.sh: $commit does not run; see $scratch/run.log" >&2; continue; }
        mv "$out.new" "$out"
    fi
    "$root/bench" history add "$out/results.jsonl" --to "$root/results/history" ||
        echo "backfill.sh: the records of $commit are left out" >&2
done
