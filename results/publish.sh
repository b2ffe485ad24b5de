#!/bin/sh
# Makes the published sets of records, their reports and the verdicts on the papers' claims:
#   results/publish.sh [standard] [failures] [sweeps] [claims] [mutants]     default: the first four, in this order
# Wall times are part of the first and of the sweep over the viewport: keep the machine quiet.
set -eu
cd "$(dirname "$0")/.."

standard() { ./bench run --out results/published; }

# Every technique on every other built-in scene, then the variants that single scenes are about (their `[expect]`). These scenes
# are about errors, which are the same on every machine, so no time is measured.
failures() {
    out=results/failures
    scenes="basic huge caster-behind-eye colonnade contact depth-complexity eye-in-shadow grazing-light light-behind-camera
        light-jump moving-camera moving-caster moving-light moving-receiver near-plane open-mesh overlapping-volumes picket-fence
        screen-overlap tessellation"
    # shellcheck disable=SC2046,SC2086 # lists of words
    ./bench run --cost none $(printf ' --scene %s' $scenes) --out $out
    also caster-behind-eye sm-psm:behind=lost sm-psm:behind=move-back
    also contact sm-uniform:bias=constant,units=1600000
    also depth-complexity vsm:kernel=32 esm:kernel=32 csm-fourier:terms=4,damping=0 csm-fourier:terms=32,damping=0
    also eye-in-shadow volume-zfail:far=infinity
    also grazing-light sm-uniform:bias=none sm-uniform:bias=constant,units=1000000
    also near-plane sm-psm:fit=cube
    also open-mesh sm-midpoint:second=backface
    also picket-fence sm-uniform:map=256 sm-silhouette:map=256
    also basic sm-uniform:map=512 sm-silhouette:map=512
    ./bench report $out/results.jsonl --out $out
    rm $out/results.csv # says nothing that the records do not
}

# Adds variants of techniques on one scene to the failure set.
also() {
    scene=$1
    shift
    # shellcheck disable=SC2046 # a list of words
    ./bench run --cost none --scene "$scene" $(printf ' --technique %s' "$@") --resume --out results/failures
}

sweeps() {
    sweep light-view-angle dueling-frusta 'sm-*' sm-psm:fit=cube volume-zfail
    sweep near-plane near-plane 'sm-*' sm-psm:fit=cube sm-psm:fit=cube,shift=4 sm-psm:fit=cube,shift=5 volume-zfail
    sweep units contact sm-uniform:bias=constant sm-uniform sm-focused sm-silhouette pcf esm vsm
    sweep factor contact sm-uniform sm-uniform:units=65536 sm-focused sm-silhouette pcf sm-history
    sweep map dueling-frusta 'sm-*' pcf vsm esm deep-sm
    sweep light-elevation grazing-light 'sm-*' sm-uniform:bias=none sm-uniform:bias=constant,units=65536 'planar-*' volume-zfail
    sweep casters depth-complexity sm-uniform vsm vsm:kernel=32 esm esm:kernel=32 lvsm csm-fourier 'volume-*'
    sweep tessellation tessellation sm-uniform sm-cube sm-dual-paraboloid sm-dual-paraboloid:map=2048,units=16384 'volume-*'
    # What single claims are about.
    sweep casters trees volume-zpass sm-silhouette:map=256 --values 1,2,5,10,20
    sweep casters windmills volume-zpass sm-silhouette:map=256 --values 15,30,60
    sweep viewport windmills 'lod-*' --profile standard
}

# One axis of one scene, with the techniques that follow and then, from the first word with dashes on, options.
sweep() {
    axis=$1
    scene=$2
    shift 2
    set -f # patterns of techniques are no files
    techniques=
    while [ $# -gt 0 ] && [ "${1#--}" = "$1" ]; do
        techniques="$techniques --technique $1"
        shift
    done
    # shellcheck disable=SC2086 # a list of words
    ./bench sweep --axis "$axis" --scene "$scene" $techniques "$@" --out "results/sweeps/$axis-$scene"
    set +f
}

claims() {
    ./bench claims results/published/results.jsonl results/failures/results.jsonl results/sweeps/*/sweep.jsonl \
        --format md >results/claims.md.new
    mv results/claims.md.new results/claims.md
}

# Which of the faults that are planted on purpose the gate tells: goes on where it was stopped.
mutants() {
    cmake --preset release >/dev/null
    cmake --build build/release --target mutants
    build/release/tests/mutants
}

[ $# -gt 0 ] || set -- standard failures sweeps claims
for part in "$@"; do
    case $part in
    standard | failures | sweeps | claims | mutants) "$part" ;;
    *) echo "publish.sh: unknown part \"$part\"; known are standard, failures, sweeps, claims, mutants" >&2; exit 2 ;;
    esac
done
