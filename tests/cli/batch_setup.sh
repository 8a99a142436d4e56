# SPDX-License-Identifier: Apache-2.0
# Sourced after setup.sh by the scripts about srispbatch: $batch, twelve small photos in photos/, two references in
# refs/; hashes, same_results, summary.
batch=$build/bin/srispbatch
mkdir -p photos/street refs
cp "$reference" refs/a.dng
"$tool" "$photo" --srisp-unprocess "$reference" -o refs/b.dng # a reference of another scene
for number in 1 2 3 4 5 6; do
    oiiotool "$photo" --mulc 0.$((10 - number)),0.9,0.8 -o photos/$number.jpg
    oiiotool "$photo" --mulc 0.7,0.9,0.$((number + 3)) -o photos/street/$number.png
done
echo text >photos/notes.txt
cp photos/1.jpg photos/.hidden.jpg

hashes() { # hashes FOLDER: names and bytes of all results
    (cd "$1" && find . -type f ! -path './manifest/*' | sort | xargs md5sum)
}
same_results() { hashes "$1" >one.txt && hashes "$2" >two.txt && cmp one.txt two.txt; }
summary() { # summary MADE DONE FAILED COMMAND…
    wanted=": $1 made, $2 done before, $3 failed"
    shift 3
    "$@" >summary.txt 2>batch.log
    grep -qF "$wanted" summary.txt && return 0
    cat summary.txt batch.log
    return 1
}

