#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# srispbatch on several machines: a real Slurm, of which a node is lost and a task cancelled; GNU parallel; Dask.
. "$(dirname "$0")/setup.sh"
. "$source/tests/cli/batch_setup.sh"
. "$source/tests/cli/slurm_cluster.sh"
PATH=$build/bin:$PATH

"$batch" photos --reference refs -o out --per-image 80 -q || exit 1

if command -v parallel >/dev/null; then
    # The line of docs/batch.md.
    with_parallel() {
        seq 0 3 | parallel -j 2 srispbatch photos/ --reference refs/ -o parallel --per-image 80 --threads 1 -q --shard {}/4 &&
            same_results out parallel
    }
    check "GNU parallel" with_parallel
else
    echo "SKIPPED GNU parallel: it is not installed (parallel)"
fi
if /usr/bin/python3 -c "import distributed" 2>/dev/null; then
    with_dask() {
        awk '/^```/ { if (block ~ /distributed/) printf "%s", block; block = ""; next } { block = block $0 "\n" }' \
            "$source/docs/batch.md" >dask_shards.py
        [ -s dask_shards.py ] && /usr/bin/python3 dask_shards.py >dask.log 2>&1 || { cat dask.log; return 1; }
        "$batch" photos --reference refs -o single -q && same_results single dask_raw
    }
    check "Dask" with_dask
else
    echo "SKIPPED Dask: it is not installed (python3-distributed)"
fi

if ! has_slurm; then
    echo "SKIPPED Slurm: slurm-wlm and munge are not installed, or this is not root"
    finish
    exit
fi
trap 'stop_cluster; cd /; rm -rf "$scratch"' EXIT
check "a cluster of two nodes" start_cluster
no_jobs() { [ -z "$(squeue -h 2>/dev/null)" ]; }
script=$build/share/srisp/slurm/srispbatch.sbatch
submit() { # submit OUTPUT OPTIONS OF sbatch…
    folder=$1
    shift
    sbatch --parsable --mem-per-cpu=100 --cpus-per-task=1 -o "$scratch/slurm-%a.log" "$@" "$script" photos --reference refs -o "$folder" \
        --per-image 80 -q
}
at_work() { # at_work NODE: a task there has made some of its results
    task=$(squeue -h -w "$1" -t R -o %K) && [ -n "$task" ] && [ "$(cat "array/manifest/$task-of-8.jsonl" 2>/dev/null | wc -l)" -gt 10 ]
}
lost_node() {
    job=$(submit array --array=0-7) && wait_for 60 at_work n2 || return 1
    lose_node n2
    scancel "${job}_7"
    sleep 1
    start_node n2 # it is mended
    submit array --array=7 >/dev/null # what was cancelled comes again
    wait_for 300 no_jobs && same_results out array && grep -q "NODE_FAIL\|requeue\|Requeue" "$cluster/slurmctld.log" && return 0
    diff one.txt two.txt
    cat slurm-*.log
    tail -n 40 "$cluster/slurmctld.log"
    return 1
}
check "a node is lost, a task cancelled: in the end all is there, to the bit" lost_node
verified() { [ "$(ls array/manifest/*.jsonl)" = array/manifest/all.jsonl ] && exits 0 "$batch" --verify array -q; }
check "the job that depends on it has merged the manifests" verified
out_of_time() { # a signal like the one before the time limit
    submit short --array=0-0 >short.txt && wait_for 30 [ -s short/manifest/all.jsonl ] || return 1
    scancel --signal=USR1 --batch "$(cat short.txt)_0"
    wait_for 200 no_jobs && same_results out short && grep -q "[Rr]equeue\|Terminated\|143" slurm-0.log || cat slurm-0.log
}
check "a task whose time is nearly up is queued again and goes on" out_of_time
finish
