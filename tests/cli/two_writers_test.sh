#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Two processes that write one output at the same time, many times: what lies there afterwards is one's or the other's,
# whole; nothing else is left; and each of them succeeds, or says that the place is taken. srispbatch's own folder
# is in batch_harm_test.sh. Usage: two_writers_test.sh BUILD SOURCE [ROUNDS]
. "$(dirname "$0")/setup.sh"
rounds=${3:-2}

# at_once OUTPUT FIRST SECOND COMMAND…: VARIANT in the command stands for what differs between the two. It runs in a folder
# of its own, so that outputs record the same names.
written() ( # written FOLDER VARIANT COMMAND…: runs it there
    cd "$1" && variant=$2
    shift 2
    eval "$(printf '%s' "$*" | sed "s|VARIANT|$variant|g")"
)
hash_of() { # of a file's bytes, or of all in a folder
    if [ -d "$1" ]; then (cd "$1" && find . -type f | sort | xargs md5sum | md5sum); else md5sum <"$1"; fi
}
at_once() {
    output=$1 first=$2 second=$3
    shift 3
    rm -rf one other both && mkdir one other both
    written one "$first" "$@" >one.log 2>&1 || { cat one.log; return 1; }
    written other "$second" "$@" >one.log 2>&1 || { cat one.log; return 1; }
    one=$(hash_of "one/$output") other=$(hash_of "other/$output")
    [ "$one" != "$other" ] || { echo "the two are the same"; return 1; }
    round=0 won_first=0 refused=0
    while [ $round -lt "$rounds" ]; do
        round=$((round + 1))
        [ $((round % 2)) -eq 0 ] && rm -rf "both/$output"
        written both "$first" "$@" >first.log 2>&1 &
        one_id=$!
        written both "$second" "$@" >second.log 2>&1 &
        other_id=$!
        for id in $one_id $other_id; do
            wait $id && continue
            refused=$((refused + 1))
            log=$([ $id -eq $one_id ] && echo first.log || echo second.log)
            grep -q "$output" $log || { echo "failed without a reason:"; cat $log; return 1; }
            cat $log
        done
        case $(hash_of "both/$output") in
            "$one") won_first=$((won_first + 1)) ;;
            "$other") ;;
            *) echo "round $round: neither the one nor the other"; return 1 ;;
        esac
        [ "$(ls -A both)" = "$output" ] || { ls -lA both; return 1; }
    done
    echo "$output: $rounds rounds, the first one's $won_first times, refused $refused" >>"$scratch/figures"
}
export SOURCE_DATE_EPOCH=0
"$tool" "$photo" --srisp-unprocess "$reference" -o plain.exr
check "srisptool, EXR" at_once raw.exr default spatial $tool $photo --srisp-unprocess:model=VARIANT $reference -o raw.exr
check "srisptool, TIFF" at_once raw.tif default spatial $tool $photo --srisp-unprocess:model=VARIANT $reference -o raw.tif
check "srisptool, DNG" at_once raw.dng default spatial $tool $photo --srisp-unprocess:model=VARIANT $reference -o raw.dng
check "srisptool, parameters" at_once p.json default spatial $tool $photo --srisp-unprocess:model=VARIANT $reference --srisp-save-params p.json
check "the DNG plugin in the stock oiiotool" at_once stock.dng 0.5 0.9 OIIO_LIBRARY_PATH="$plugins" "$stock" "$scratch/plain.exr" --mulc VARIANT -o stock.dng
bake() { "$build/bin/srispbake" --reference "$reference" --source "$photo" -q "$@"; }
check "srispbake, a table" at_once table.cube 0 1 bake --brightness VARIANT -o table.cube
check "srisppack" at_once pack 1 2 "$build/bin/srisppack" "$source/configs/sample" --size 32 --seed VARIANT -o pack
check "srispeval" at_once scores.json 64 128 "$build/bin/srispeval" half-split "$reference" -q --size VARIANT --json scores.json
cat "$scratch/figures"
finish
