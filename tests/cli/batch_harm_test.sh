#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# srispbatch where things go wrong: killed, stopped, full disks, decoders that crash and hang. In the end the results are
# those of an undisturbed run.
. "$(dirname "$0")/setup.sh"
. "$source/tests/cli/batch_setup.sh"

"$batch" photos --reference refs -o out -q || exit 1
whole() { # whole FOLDER: nothing there is half written
    find "$1" -name "*.exr" ! -name ".*" 2>/dev/null | xargs -r iinfo >/dev/null
}

killed() { # 50 times, in both ways to decode
    round=0
    while [ $round -lt 50 ]; do
        round=$((round + 1))
        [ $((round % 10)) -eq 0 ] && rm -rf killed
        isolated=$([ $((round % 2)) -eq 0 ] && echo --isolate || echo --no-isolate)
        "$batch" photos --reference refs -o killed -q $isolated &
        sleep 0.$((round * 37 % 60 + 10))
        kill -9 $! 2>/dev/null
        wait $! 2>/dev/null
        whole killed || return 1
    done
    "$batch" photos --reference refs -o killed -q && same_results out killed && exits 0 "$batch" --verify killed -q
}
check "killed at any moment, 50 times, it goes on to the same bits" killed
interrupted() {
    "$batch" photos --reference refs -o stopped --per-image 20 -q &
    pid=$!
    sleep 0.7
    kill -TERM $pid # a shell's background jobs ignore the other one
    wait $pid
    [ $? -eq 143 ] || return 1
    [ -z "$(find stopped -name '.*' -type f)" ] && "$batch" photos --reference refs -o stopped --per-image 20 -q &&
        [ "$(find stopped -name '*.exr' | wc -l)" -eq 240 ]
}
check "a signal lets it finish what is being written" interrupted
cut_line() {
    cp -r out cut && truncate -s -40 cut/manifest/all.jsonl
    summary 1 11 0 "$batch" photos --reference refs -o cut && summary 0 12 0 "$batch" photos --reference refs -o cut
}
check "a record that was cut off is no record" cut_line
at_once() { # as where a task is started anew while the lost node still works
    "$batch" photos --reference refs -o twice -q &
    first=$!
    "$batch" photos --reference refs -o twice -q &
    second=$!
    wait $first && wait $second && same_results out twice && exits 0 "$batch" --verify twice -q
}
check "two runs of the same at once" at_once
if mount -t tmpfs -o size=300k tmpfs "$(mkdir -p full && echo full)" 2>/dev/null; then
    trap 'cd /; umount "$scratch/full" 2>/dev/null; rm -rf "$scratch"' EXIT
    full() {
        says 1 "No space left on device" "$batch" photos --reference refs -o full || return 1
        [ "$(grep -c . "$scratch/stderr")" -eq 1 ] && mount -o remount,size=40m full &&
            "$batch" photos --reference refs -o full -q && same_results out full
    }
    check "a full disk stops it with one message, and it goes on" full
    umount full
fi

# Photos of these widths do what $crash says (crashing_decoder.cpp).
crashing=$build/tests/libcrashing_decoder.so
case "$(ldd "$batch")" in *libasan*) skip "what follows preloads a library, which the address sanitizer does not take" ;; esac
cp -r photos harm
for kind in 61:crash 67:hang 71:memory; do oiiotool "$photo" --resize ${kind%:*}x50 -o harm/street/${kind#*:}.jpg; done
disturbed() { LD_PRELOAD=$crashing "$batch" "$@"; }
isolated() {
    exits 1 disturbed harm --reference refs -o harm_out --memory 1 --time-limit 8 >summary.txt 2>harm.log || return 1
    grep -q "12 made, 0 done before, 3 failed" summary.txt && grep -q "crash.jpg': crashed the decoder (Aborted)" harm.log &&
        grep -q "hang.jpg': took longer than 8 s (--time-limit)" harm.log && grep -q "memory.jpg': takes more memory than its size explains\|memory.jpg': took longer" harm.log || { cat summary.txt harm.log; return 1; }
    rm harm_out/manifest/failed.jsonl && same_results out harm_out
}
check "photos that crash, hang and flood a decoder cost themselves" isolated
mended() { "$batch" harm --reference refs -o harm_out | grep -q "3 made, 12 done before, 0 failed"; }
check "and are made once the decoder is mended" mended
again() {
    cp -r photos flaky && oiiotool "$photo" --resize 73x50 -o flaky/once.jpg
    once=$scratch/once
    export once
    disturbed flaky --reference refs -o flaky_out | grep -q "12 made, 0 done before, 1 failed" || return 1
    rm once && rm -r flaky_out
    disturbed flaky --reference refs -o flaky_out --retry 1 | grep -q "13 made, 0 done before, 0 failed"
}
check "what fails once is tried again" again
in_time() { # a signal while a decoder hangs
    for isolated in --isolate --no-isolate; do
        rm -rf hang hang_out
        mkdir hang && cp harm/street/hang.jpg hang
        LD_PRELOAD=$crashing "$batch" hang --reference refs -o hang_out -q $isolated &
        pid=$!
        sleep 1
        start=$(date +%s%N)
        kill -TERM $pid
        wait $pid
        [ $? -eq 143 ] || return 1
        taken=$((($(date +%s%N) - start) / 1000000))
        [ $taken -lt 2000 ] || { echo "$isolated: $taken ms"; return 1; }
        [ -z "$(find hang_out -name '*.exr')" ] && [ -z "$(pgrep -f "srispbatch --worker hang")" ] || return 1
    done
}
check "a signal ends it within two seconds, whatever a decoder does" in_time
finish
