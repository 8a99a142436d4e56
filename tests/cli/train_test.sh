#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# srisptrain from end to end, on a made-up pack: trains, stops, goes on, refuses, and several processes together.
. "$(dirname "$0")/setup.sh"

train=$build/bin/srisptrain
"$build/bin/small_pack" pack || exit 1
cat >tiny.json <<'RECIPE'
{
    "base": "default", "description": "for tests", "pack": "pack", "steps": 8, "pairs": 2, "unpaired": 2,
    "log_every": 1, "validate_every": 4, "data": { "image_size": 32 }, "anchor_fit": { "pairs": 32, "steps": 20 },
    "optimizer": { "rate": 1e-4, "dictionary_rate": 1e-4 }, "mean_teacher": { "start": 0.3 }, "validation": { "set": { "real_images": 1, "simulated_images": 2 } }
}
RECIPE

# steps FILE: the steps in a log, in order; losses FILE: step and loss.
steps() { cut -d, -f1 "$1" | uniq | tr '\n' ' '; }
losses() { awk -F, '$4 != "" && NR > 1 { print $1, $4 }' "$1"; }
# wait_for COMMAND…: until it succeeds.
wait_for() {
    for _ in $(seq 600); do
        "$@" 2>/dev/null && return 0
        sleep 0.05
    done
    echo "never: $*"
    return 1
}
# wait_for_step FILE N: until the log has step N.
wait_for_step() { wait_for grep -q "^$2," "$1"; }
# start COMMAND…: in the background, with signals as a terminal gives them; $! is the program itself.
start() {
    # A shell ignores SIGINT for what it runs in the background: a program of its own resets that.
    /usr/bin/python3 -c "
import os, signal, sys
signal.signal(signal.SIGINT, signal.SIG_DFL)
os.execv(sys.argv[1], sys.argv[1:])" "$@" &
}

trains() {
    "$train" tiny.json -o whole --threads 1 || return 1
    [ "$(ls whole | tr '\n' ' ')" = "best.safetensors checkpoint.safetensors log.csv log.jsonl recipe.json " ] &&
        [ "$(steps whole/log.csv)" = "step 1 2 3 4 5 6 7 8 " ] &&
        "$tool" "$photo" --srisp-unprocess:model=whole/best.safetensors "$reference" -o raw.exr
}
check "a recipe gives a model that srisptool can use" trains

interrupted() {
    start "$train" tiny.json -o parts --threads 1
    pid=$!
    wait_for_step parts/log.csv 2 || return 1
    kill -INT $pid
    wait $pid
    code=$?
    [ $code -eq 130 ] || { echo "exit code $code"; return 1; }
    says 0 "going on from step" "$train" tiny.json -o parts --threads 1 || return 1
    [ "$(steps parts/log.csv)" = "step 1 2 3 4 5 6 7 8 " ] || { cat parts/log.csv; return 1; }
    cmp whole/best.safetensors parts/best.safetensors
}
check "Ctrl-C, then the same command: the model comes out to the bit" interrupted

killed() {
    start "$train" tiny.json -o killed --threads 1 --set checkpoint_minutes=0
    pid=$!
    wait_for_step killed/log.csv 5 || return 1
    kill -KILL $pid
    wait $pid
    says 0 "going on from step" "$train" tiny.json -o killed --threads 1 || return 1
    [ "$(steps killed/log.csv)" = "step 1 2 3 4 5 6 7 8 " ] || { cat killed/log.csv; return 1; }
    cmp whole/best.safetensors killed/best.safetensors
}
check "kill -9 loses no more than what came after the checkpoint" killed
stopped_in_the_anchor() {
    set -- tiny.json --threads 1 --steps 2 --set anchor_fit.pairs=1280
    "$train" "$@" -o fit_whole || return 1
    start "$train" "$@" -o fit_parts --set checkpoint_minutes=0
    pid=$!
    wait_for test -e fit_parts/anchor_pairs.safetensors || return 1
    kill -KILL $pid
    wait $pid
    start "$train" "$@" -o fit_parts 2>notes.txt
    pid=$!
    wait_for grep -q "going on from [0-9]* of 1280 pairs for the anchor" notes.txt || return 1
    kill -INT $pid
    wait $pid
    code=$?
    [ $code -eq 130 ] && grep -q "stopped with [0-9]* of 1280 pairs" notes.txt || { echo "exit code $code"; cat notes.txt; return 1; }
    says 1 "'fit_parts/anchor_pairs.safetensors' is of another training: anchor_fit.pairs is 1280 there, 64 here" \
        "$train" tiny.json --threads 1 --steps 2 --set anchor_fit.pairs=64 -o fit_parts || return 1
    says 0 "of 1280 pairs for the anchor" "$train" "$@" -o fit_parts && [ ! -e fit_parts/anchor_pairs.safetensors ] &&
        cmp fit_whole/best.safetensors fit_parts/best.safetensors
}
check "the fit of the anchor, too, is gone on from after kill -9 and Ctrl-C" stopped_in_the_anchor
check "a finished training has nothing to do" says 0 "going on from step 8" "$train" tiny.json -o whole --threads 1

check "a checkpoint of another recipe is not gone on from" says 1 \
    "'whole/checkpoint.safetensors' is of another training: optimizer.rate is 0.0001 there, 0.002 here; --restart starts again" \
    "$train" tiny.json -o whole --set optimizer.rate=0.002
restarted() {
    cp -r whole again
    "$train" tiny.json -o again --threads 1 --steps 4 --restart && [ "$(steps again/log.csv)" = "step 1 2 3 4 " ]
}
check "--restart starts over" restarted
truncated_checkpoint() {
    cp -r whole broken
    truncate -s 1000000 broken/checkpoint.safetensors
    says 1 "checkpoint 'broken/checkpoint.safetensors': " "$train" tiny.json -o broken
}
check "a truncated checkpoint is refused" truncated_checkpoint
busy() {
    start "$train" tiny.json -o busy --threads 1 --steps 400
    pid=$!
    wait_for_step busy/log.csv 1
    says 1 "another training is writing to 'busy'" "$train" tiny.json -o busy
    result=$?
    kill -TERM $pid
    wait $pid
    [ $? -eq 143 ] && return $result
}
check "two trainings do not share a folder; SIGTERM stops one" busy

check "no recipe" says 2 "no recipe is given" "$train"
check "an unknown option" exits 2 "$train" tiny.json --sett x
check "an unknown recipe" says 1 "unknown recipe 'defualt'; did you mean 'default'?" "$train" defualt
check "an unknown setting" says 2 "--set optimizer.rat=1: unknown setting 'optimizer.rat'; did you mean 'optimizer.rate'" \
    "$train" tiny.json --set optimizer.rat=1
check "an impossible setting" says 2 "'steps' must be a whole number from 1 to 100000000, has 0" "$train" tiny.json --set steps=0
check "a pack that is not there" says 1 "pack 'gone'" "$train" tiny.json --pack gone
truncated_pack() {
    cp -r pack cut
    truncate -s 5000 cut/photos.safetensors
    says 1 "pack 'cut': " "$train" tiny.json --pack cut -o cut_out && [ ! -e cut_out ]
}
check "a truncated pack" truncated_pack
shrinking_pack() {
    cp -r pack shrinking
    start "$train" tiny.json --pack shrinking -o shrunk --threads 1 --set steps=100000 2>shrunk.err
    pid=$!
    wait_for_step shrunk/log.csv 2 || return 1
    truncate -s 5000 shrinking/photos.safetensors shrinking/raws.safetensors
    wait $pid
    code=$?
    tail -n 3 shrunk.err
    [ $code -eq 1 ] && grep -q "^srisptrain: pack 'shrinking': [a-z]*.safetensors was made shorter while it was read" shrunk.err
}
check "a pack that is truncated while it is read" shrinking_pack
# keeps FILE WORDS…: the training is refused, FILE stays.
keeps() {
    before=$(cksum <"$1")
    says 1 "inputs are never overwritten" "$train" "$2" -o whole --threads 1 $3 && [ "$(cksum <"$1")" = "$before" ]
}
check "a model to start from in the output's folder" keeps whole/best.safetensors tiny.json "--init whole/best.safetensors"
ln whole/best.safetensors linked.safetensors
check "the same, by a hard link" keeps whole/best.safetensors tiny.json "--init linked.safetensors"
check "a model whose anchor is taken" keeps whole/best.safetensors tiny.json "--set anchor_fit.from=whole/best.safetensors"
check "a recipe in the output's folder that would change" keeps whole/recipe.json whole/recipe.json "--steps 9"
same_recipe() { "$train" whole/recipe.json --threads 1; }
check "a finished training by its own recipe, which stays the same" same_recipe
check "a model of another kernel size as --init" says 1 \
    "--init spatial is another kind of model than the recipe's: 'model.kernel_size' is \"3\" there, \"1\" here" \
    "$train" tiny.json --init spatial -o init
check "no model as --init" says 1 "unknown model 'defalt'; did you mean 'default'?" "$train" tiny.json --init defalt -o init
with_an_anchor() {
    "$train" tiny.json -o anchored --set anchor_fit.from=spatial --steps 1 2>err && ! grep -q "anchor fitted" err &&
        [ -s anchored/best.safetensors ]
}
check "the anchor of another model, without a fit" with_an_anchor
check "no model to take the anchor from" says 1 "unknown model 'defalt'; did you mean 'default'?" \
    "$train" tiny.json --set anchor_fit.from=defalt -o anchored_2
check "--device cuda without a GPU, or with one" sh -c '"$1" tiny.json -o gpu --device cuda --steps 2 2>err ||
    grep -q "LibTorch finds no GPU here" err' sh "$train"

fine_tuned() {
    "$train" finetune --pack pack --init default -o tuned --threads 1 --steps 2 --set data.image_size=32 \
        --set pairs=2 --set validation.set.simulated_images=1 --set anchor_fit.pairs=64 --set anchor_fit.steps=2 \
        >tuned.txt 2>&1 && [ -s tuned/best.safetensors ] &&
        grep -q "validation: .* dB and .* deg with 0 % of the new anchor" tuned.txt &&
        grep -q "validation: .* dB and .* deg with 100 % of the new anchor" tuned.txt &&
        [ "$(grep -c '"step":0,' tuned/log.jsonl)" = 1 ] || { cat tuned.txt; return 1; }
}
check "a finished model is carried on with real RAW images" fine_tuned
tested_only() {
    says 0 "'upi' has nothing to learn" "$train" upi --pack pack -o upi --threads 1 \
        --set validation.set.simulated_images=1 --set data.image_size=32 && [ -s upi/log.jsonl ]
}
check "a method without parameters is tested" tested_only
rehearsed() {
    "$train" tiny.json -o dry --dry-run --threads 1 >plan || return 1
    grep -q "^a step " plan && grep -q "^anchor .*before the first step" plan && grep -q "^memory " plan && [ ! -e dry ]
}
check "--dry-run says what would be done, and writes nothing" rehearsed
# Progress is shown once something has taken two seconds, which eight steps need not.
on_a_terminal() {
    script -qec "'$train' tiny.json -o tty --steps 32 --threads 1" /dev/null </dev/null >tty.txt || { cat tty.txt; return 1; }
    tr '\r' '\n' <tty.txt | grep -q '/32, .*/s, loss [0-9][0-9.]* .* left' || { cat tty.txt; return 1; }
}
check "on a terminal a line says how far it is" on_a_terminal
check "--list-settings" sh -c '"$1" tiny.json --list-settings | grep -q "^steps = 8$"' sh "$train"
check "--list-recipes" sh -c '"$1" --list-recipes | grep -qx paper' sh "$train"

# reserve_port: sets $port to one that no other program gets as long as $keeper runs; those who meet there may bind it, too.
reserve_port() {
    rm -f port.txt
    /usr/bin/python3 -c "
import socket, time
keeper = socket.socket()
keeper.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
keeper.bind(('127.0.0.1', 0))
print(keeper.getsockname()[1], flush=True)
time.sleep(600)" >port.txt &
    keeper=$!
    wait_for test -s port.txt && port=$(cat port.txt)
}
reserve_port
# node RANK OUTPUT OPTIONS…: one of two processes.
node() {
    rank=$1 output=$2
    shift 2
    start "$train" tiny.json -o "$output" --threads 1 --nodes 2 --rank "$rank" --address "127.0.0.1:$port" "$@"
}
together() {
    node 1 two
    second=$!
    node 0 two
    first=$!
    wait $first && wait $second || return 1
    losses whole/log.csv >one.txt
    losses two/log.csv >two.txt
    paste one.txt two.txt | awk '{ d = ($2 - $4) / $2; if (d < 0) d = -d; if ($1 != $3 || d > 1e-3) { print; bad = 1 } }
        END { exit bad || NR != 8 }'
}
check "two processes have the losses of one" together
kill $keeper
reserve_port
one_lost() {
    node 1 lost --steps 4000
    second=$!
    node 0 lost --steps 4000
    first=$!
    wait_for_step lost/log.csv 2 || return 1
    kill -KILL $second
    timeout 30 tail --pid=$first -f /dev/null || { echo "rank 0 waits for ever"; kill -KILL $first; return 1; }
    wait $first
    [ $? -eq 1 ]
}
check "a process that is killed ends the other one" one_lost
kill $keeper
reserve_port
one_silent() {
    node 1 silent --steps 4000 --timeout 5
    second=$!
    node 0 silent --steps 4000 --timeout 5
    first=$!
    wait_for_step silent/log.csv 2 || return 1
    kill -STOP $second
    timeout 30 tail --pid=$first -f /dev/null
    ended=$?
    kill -KILL $second
    [ $ended -eq 0 ] || { echo "rank 0 waits for ever"; kill -KILL $first; return 1; }
    wait $first
    [ $? -eq 1 ]
}
check "a process that does not answer ends the other one" one_silent
kill $keeper
check "a rank without an address" says 2 "need the address host:port of rank 0" "$train" tiny.json --nodes 2 --rank 0

mkdir full
if mount -t tmpfs -o size=80m tmpfs full 2>/dev/null; then
    trap 'cd /; umount "$scratch/full"; rm -rf "$scratch"' EXIT
    full_disk() {
        says 0 "" "$train" tiny.json -o full/run --threads 1 --steps 2 || return 1
        # Room for that checkpoint (24 MB), not for the next one beside it.
        head -c 40000000 /dev/zero >full/other
        says 1 "the last checkpoint could not be written" "$train" tiny.json -o full/run --threads 1 --steps 2 \
            --set checkpoint_minutes=0 || return 1
        "$train" tiny.json -o full/run --threads 1 --steps 2 --dry-run | grep -q "goes on from step 2" &&
            ! ls full/run | grep -v -e '^best.safetensors$' -e '^checkpoint.safetensors$' -e '^log.csv$' \
                -e '^log.jsonl$' -e '^recipe.json$'
    }
    check "a full disk: the checkpoint before stays whole" full_disk
else
    echo "SKIPPED ${0##*/}: mounting a tmpfs is not permitted here" >&2
fi
# The bench of a task that learns from RAW-like images (docs/research/downstream_task.md), in small.
task() {
    SRISP_MODEL_PATH=$source/configs/models "$build/bin/taskbench" --pack pack --out task --seeds 1 --steps 2 --size 32 \
        --references 2 --batch 4 --threads 1 "$@"
}
learns_a_task() {
    task >task.txt && [ "$(ls task | wc -l)" -eq 6 ] && grep -q "^  default  *[0-9]" task.txt
}
check "a task is learnt from what six ways made" learns_a_task
again() { task >task_again.txt 2>task_again.log && cmp task.txt task_again.txt && ! grep -q "colours .* s (" task_again.log; }
check "what was learnt is read again, with the same table" again
check "results of other settings are not mixed in" says 1 "made with other settings" task --rate 0.5
finish
