#!/bin/sh
# A large run over the machines of a Slurm cluster: an array job measures the shards, a job after it merges and judges.
set -eu

usage() {
    cat <<'EOF'
Usage: submit.sh --out DIR --shards N [options] [-- OPTIONS OF shadowbench run]

  --out DIR          folder of manifest, cells, logs, records and report; every machine must see it
  --shards N         tasks of the array; more of them than machines even out slow cells
  --time T           limit of a shard, as sbatch writes it (default 04:00:00)
  --merge-time T     limit of the merging job (default 00:30:00)
  --retries N        how often a shard that exits with 75 is queued again (default 3)
  --program FILE     the program (default: $SHADOWBENCH_BUILD or build/release of this tree)
  --sbatch OPTIONS   more options of sbatch for both jobs, such as "--partition=long --constraint=skylake": all machines
                     must be of one kind, merge refuses others
  --wait             wait for the merging job and exit as it does

Example:
  tools/slurm/submit.sh --out /shared/large --shards 64 -- --profile paper --cache /shared/cache --cost none

The merging job runs after every shard has ended, however it ended (afterany): it exits with 5 and names the cells that are
missing. The same command again measures these only. After afterok, one failed shard would leave it in the queue for ever.
Truths are computed by the shard that first needs them; put --cache where every machine sees it.
EOF
}

fail() {
    echo "submit.sh: $1; see --help" >&2
    exit 2
}

# One task of the array. Exit code 75 says that the same again may go well: the task goes back into the queue, for any machine.
# Its own name is written out: the job id of one task is that of the whole array.
measure_shard() {
    program=$1 out=$2 shards=$3 retries=$4
    shift 4
    status=0
    "$program" run "$@" --out "$out" --shard "$SLURM_ARRAY_TASK_ID/$shards" --quiet || status=$?
    if [ "$status" -eq 75 ] && [ "${SLURM_RESTART_COUNT:-0}" -lt "$retries" ]; then
        echo "shard $SLURM_ARRAY_TASK_ID: retry $((${SLURM_RESTART_COUNT:-0} + 1)) of $retries"
        scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID"
    fi
    exit "$status"
}

merge_shards() {
    exec "$1" merge "$2"
}

submit() {
    here=$(cd "$(dirname "$0")" && pwd)
    out='' shards='' time=04:00:00 merge_time=00:30:00 retries=3 more='' wait=''
    program=${SHADOWBENCH_BUILD:-$here/../../../build/release}/shadowbench
    while [ $# -gt 0 ]; do
        case $1 in
        --help) usage && exit 0 ;;
        --wait) wait=--wait ;;
        --) shift && break ;;
        --out | --shards | --time | --merge-time | --retries | --program | --sbatch)
            [ $# -ge 2 ] || fail "$1 needs a value"
            case $1 in
            --out) out=$2 ;;
            --shards) shards=$2 ;;
            --time) time=$2 ;;
            --merge-time) merge_time=$2 ;;
            --retries) retries=$2 ;;
            --program) program=$2 ;;
            --sbatch) more=$2 ;;
            esac
            shift
            ;;
        *) fail "there is no option $1" ;;
        esac
        shift
    done
    [ -n "$out" ] || fail "--out is missing"
    [ "$shards" -ge 1 ] 2>/dev/null || fail "--shards is no number of shards"
    [ "$retries" -ge 0 ] 2>/dev/null || fail "--retries is no number"
    [ -x "$program" ] || fail "there is no program $program"
    command -v sbatch >/dev/null || fail "sbatch is missing: this is no machine of a Slurm cluster"

    "$program" run "$@" --out "$out" --manifest
    mkdir -p "$out/logs"
    # shellcheck disable=SC2086 # options of sbatch are words
    array=$(sbatch --parsable --job-name=shadowbench --array="1-$shards" --time="$time" --requeue --open-mode=append \
        --output="$out/logs/shard-%a.log" $more "$0" measure_shard "$program" "$out" "$shards" "$retries" "$@")
    echo "array job: $array, $shards shards; logs: $out/logs"
    # shellcheck disable=SC2086
    exec sbatch $wait --job-name=shadowbench-merge --dependency="afterany:$array" --time="$merge_time" \
        --output="$out/logs/merge.log" $more "$0" merge_shards "$program" "$out"
}

case ${1:-} in
measure_shard | merge_shards) "$@" ;;
*) submit "$@" ;;
esac
