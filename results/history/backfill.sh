#!/bin/sh
# Measures past commits and takes their records into the history:
#   results/history/backfill.sh [COMMIT …]     default: the commits below that the history does not hold yet
# Each commit is checked out, built and run in a scratch clone ($SHADOWBENCH_BACKFILL or a folder of /tmp, kept for the next
# time), with a cache of references of its own ($SHADOWBENCH_CACHE), so that nothing else here changes. $SCENES and $TECHNIQUES say which cells
# (default: below); $JOBS compilers run at once (default: 2).
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
scratch=${SHADOWBENCH_BACKFILL:-/tmp/shadowbench-backfill}
source=$scratch/source

# First parents of main, over the project's life.
commits='d41c407 9afa401 1e4b952 97b5d2b 535dca6 dfd9b11 b3e9328 6536706 4e1abb3 a57e74d 12d2dab'
techniques=${TECHNIQUES:-sm-uniform sm-focused sm-lispsm sm-psm sm-history volume-zpass volume-zfail volume-xor pcf pcss}
scenes=${SCENES:-dueling-frusta overlapping-occluders}

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
        if echo "$known" | grep -qx "${technique%%:*}"; then options="$options --technique $technique"; fi
    done
    # shellcheck disable=SC2046,SC2086 # lists of words
    nice "$program" run --quiet $options $(printf ' --scene %s' $scenes) --cache "${SHADOWBENCH_CACHE:-$scratch/cache}" --out "$1"
}

# Of an exit status: a run with a cell that is an error has been measured, too.
finished() { [ "$1" -lt 6 ] && [ -f "$2/results.jsonl" ]; }

held() { ls "$root/results/history/"*"-$(echo "$1" | cut -c1-12)-"*.jsonl >/dev/null 2>&1; }

hash_of() {
    git -C "$root" rev-parse --verify --quiet "$1^{commit}" || { echo "backfill.sh: there is no commit $1" >&2; exit 2; }
}

add() {
    hash=$(hash_of "$1")
    echo "backfill.sh: $(git -C "$root" log -1 --format='%h %s' "$hash")" >&2
    out=$scratch/records/$hash
    rm -rf "$out"
    build "$hash" || { echo "backfill.sh: $1 does not build; see $scratch/build.log" >&2; return; }
    measure "$out" >"$scratch/run.log" 2>&1 || finished $? "$out" ||
        { echo "backfill.sh: $1 does not run; see $scratch/run.log" >&2; return; }
    "$root/bench" history add "$out" --to "$root/results/history" || echo "backfill.sh: $1 is left out" >&2
}

mkdir -p "$scratch"
for commit in "$@"; do add "$commit"; done
[ $# -eq 0 ] || exit 0
for commit in $commits; do
    held "$(hash_of "$commit")" || add "$commit"
done
