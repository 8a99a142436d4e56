#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# srispbatch on several machines: a real Slurm, of which a node is lost and a task cancelled; GNU parallel; Dask.
. "$(dirname "$0")/setup.sh"
. "$source/tests/cli/batch_setup.sh"
. "$source/tests/cli/slurm_cluster.sh"
PATH=$build/bin:$PATH

"$batch" photos --reference refs -o out --per-image 6 -q || exit 1

if command -v parallel >/dev/null; then
    # The line of docs/batch.md.
    with_parallel() {
        seq 0 3 | parallel -j 2 srispbatch photos/ --reference refs/ -o parallel --per-image 6 --threads 1 -q --shard {}/4 &&
            same_results out parallel
    }
    check "GNU parallel" with_parallel
else
    echo "SKIPPED GNU parallel: it is not installed (parallel)"
fi
if /usr/bin/python3 -c "import distributed" 2>/dev/null; then
    with_dask() {
        sed -n '/^```python title=dask/,/^```/p' "$source/docs/batch.md" | sed '/^```/d' >dask_shards.py
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
wait_for_jobs() { # until none is left; at most a minute and a half
    waited=0
    while [ -n "$(squeue -h 2>/dev/null)" ]; do
        sleep 0.5
        waited=$((waited + 1))
        [ $waited -lt 180 ] || { squeue; return 1; }
    done
}
script=$build/share/srisp/slurm/srispbatch.sbatch
submit() { # submit OUTPUT OPTIONS OF sbatch…
    folder=$1
    shift
    sbatch --parsable --mem-per-cpu=100 --cpus-per-task=1 -o "$scratch/slurm-%a.log" "$@" "$script" photos --reference refs -o "$folder" \
        --per-image 6 -q
}
lost_node() {
    job=$(submit cluster --array=0-7) || return 1
    until [ "$(ls cluster/manifest/*-of-8.jsonl 2>/dev/null | wc -l)" -ge 2 ]; do sleep 0.2; done
    kill -9 "$(node_pid n2)" # a machine is gone
    pkill -9 -f "$scratch/cluster/spool.n2"
    scancel "${job}_7"
    sleep 1
    start_node n2 # it is mended
    submit cluster --array=7 >/dev/null # what was cancelled comes again
    wait_for_jobs || return 1
    same_results out cluster || { cat slurm-*.log; return 1; }
}
check "a node is lost, a task cancelled: in the end all is there, to the bit" lost_node
verified() { [ "$(ls cluster/manifest/*.jsonl)" = cluster/manifest/all.jsonl ] && exits 0 "$batch" --verify cluster -q; }
check "the job that depends on it has merged the manifests" verified
out_of_time() { # the time limit comes before the end: the task goes on afterwards
    submit short --array=0-0 --signal=B:USR1@58 --time=1 >/dev/null
    wait_for_jobs && same_results out short && grep -q "\"output\"" short/manifest/all.jsonl
}
check "a task whose time is up is queued again and goes on" out_of_time
finish
