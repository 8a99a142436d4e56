#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Texts and names that strangers send: nested JSON, paths in metadata, FIFOs and devices, URLs, headers without end.
. "$(dirname "$0")/setup.sh"

srisppack=$build/bin/srisppack srispbake=$build/bin/srispbake
OIIO_LIBRARY_PATH=$plugins
export OIIO_LIBRARY_PATH

# told TEXT COMMAND…: exits with 1 or 2 within a minute, with TEXT on stderr or stdout, on a short line.
told() {
    text=$1
    shift
    timeout 60 "$@" >"$scratch/told" 2>&1 </dev/null
    code=$?
    [ "$code" -eq 1 ] || [ "$code" -eq 2 ] || { echo "exit code $code"; head -c 2000 "$scratch/told"; return 1; }
    grep -qF -- "$text" "$scratch/told" || { echo "lacks: $text"; head -c 2000 "$scratch/told"; return 1; }
    awk 'length > 4000 { exit 1 }' "$scratch/told" || { echo "a line is too long"; return 1; }
}
works() { timeout 60 "$@" </dev/null; }

/usr/bin/python3 - <<'P'
import json
deep = "[" * 100000 + "]" * 100000
open("nested.txt", "w").write('{"srisp":"x","direction":"reverse","parameters":' + "[" * 100000)
recipe = '{"format":"srisp-recipe-1","source":"photo.jpg","reference":"reference.dng",'
open("nested.json", "w").write('{"gain":' + deep + "}")
open("parameters.srisp", "w").write(recipe + '"parameters":' + deep + "}")
open("open.srisp", "w").write(recipe + '"model":' + "[" * 100000)
def entries(count, name):
    return "{" + ",".join('"' + name(i) + '":{}' for i in range(count)) + "}"
def safetensors(file, header):
    open(file, "wb").write(len(header).to_bytes(8, "little") + header.encode())
safetensors("same.safetensors", entries(100000, lambda i: ""))
safetensors("many.safetensors", entries(100000, str))
safetensors("deep.safetensors", '{"x":' + deep + "}")
P
oiiotool "$photo" --attrib ImageDescription "$(cat nested.txt)" -o nested.png -o nested.exr
for file in nested.png nested.exr; do
    for input in "" :input=srgb; do
        check "$file with a nested record is unprocessed$input" works "$tool" "$file" "--srisp-unprocess$input" "$reference" -o raw.exr
    done
    check "and holds no parameters" told "records no parameters" "$tool" "$file" --srisp-process -o no.tif
    check "nor any to save" told "holds no recorded parameters" "$tool" "$file" --srisp-save-params no.json
done
mkdir photos
cp nested.png "$photo" photos
cp "$photo" photos/b.jpg
check "a nested record is no trouble to a pack" works "$srisppack" photos -o pack
check "which holds all three" sh -c "grep -q nested.png pack/pack.json && grep -q b.jpg pack/pack.json"
check "nested parameters in a recipe" told "nested more than 32 levels deep" iinfo parameters.srisp
check "a recipe that opens brackets without end" told "nested more than 32 levels deep" iinfo open.srisp
check "nested parameters in a file" told "nested more than 32 levels deep" "$tool" "$photo" --srisp-unprocess:params=nested.json - -o no.exr
check "and in a query" told "nested more than 32 levels deep" iinfo "photo.jpg.srisp?params=nested.json"
check "and in a bake" told "nested more than 32 levels deep" "$srispbake" --params nested.json --reference "$reference" -o no

for file in same many deep; do
    check "a model with a header of 100000 entries ($file)" told "$file.safetensors" \
        "$tool" "$photo" "--srisp-unprocess:model=./$file.safetensors" "$reference" -o no.exr
    check "and a set" told "$file.safetensors" "$srisppack" --strict --raws $file.safetensors -o no
done

# What an image says of its model is a name.
echo "12345678 and more that is nobody's business" >secret
mkfifo fifo
"$tool" "$photo" --srisp-unprocess "$reference" -o raw.exr
for name in "$scratch/secret" "$scratch/fifo" ./secret ../x.safetensors /dev/zero; do
    /usr/bin/python3 - "$name" <<'P'
import sys
import OpenImageIO as oiio
image = oiio.ImageBuf("raw.exr")
for key in ("ImageDescription", "unprocess:record"):
    text = image.spec().get_string_attribute(key)
    assert '"name":"default"' in text
    image.specmod().attribute(key, text.replace('"name":"default"', f'"name":"{sys.argv[1]}"'))
assert image.write("named.exr")
P
    check "a recorded model '$name' is not opened" told "model '$name' (xxh128:" "$tool" named.exr --srisp-process -o no.tif
    check "the message says what to do" told "; model=FILE gives it" "$tool" named.exr --srisp-process -o no.tif
    check "another model is not taken for it" works "$tool" named.exr --srisp-process:model=default -o back.tif
done
cp "$source/configs/models/default.safetensors" mine.safetensors
"$tool" "$photo" --srisp-unprocess:model=mine.safetensors "$reference" -o mine.exr
check "a model given by its path is not found again by itself" told "model 'mine' (xxh128:" "$tool" mine.exr --srisp-process -o no.tif
check "but by the same path" works "$tool" mine.exr --srisp-process:model=mine.safetensors -o back.tif
mkdir models
cp mine.safetensors models
check "and by its name and hash" works env SRISP_MODEL_PATH="$scratch/models" "$tool" mine.exr --srisp-process -o again.tif
check "with the same pixels" same back.tif again.tif

# What is no regular file.
irregular="is not a regular file"
mkdir tables
mkfifo tables/manifest.csv
cp "$photo" tables
mkfifo fifo.dng fifo.jpg
for file in fifo /dev/zero; do
    check "$file as parameters" told "$irregular" "$tool" "$photo" --srisp-unprocess:params=$file - -o no.exr
    check "$file as parameters of a query" told "$irregular" iinfo "photo.jpg.srisp?params=$file"
    check "$file as parameters of a bake" told "$irregular" "$srispbake" --params $file --reference "$reference" -o no
    check "$file as model" told "$irregular" "$tool" "$photo" "--srisp-unprocess:model=$(realpath $file)" "$reference" -o no.exr
    printf '{"format":"srisp-recipe-1","source":"%s","reference":"reference.dng"}' $file >source.srisp
    check "$file as a recipe's source" told "$irregular" iinfo source.srisp
    printf '{"format":"srisp-recipe-1","source":"photo.jpg","parameters":"%s"}' $file >source.srisp
    check "$file as a recipe's parameters" told "$irregular" iinfo source.srisp
    check "$file as a reference" told "$irregular" "$tool" "$photo" --srisp-unprocess $file -o no.exr
done
check "a FIFO as a bake's reference" told "$irregular" "$srispbake" --reference fifo.dng -o no
check "a FIFO as manifest" told "$irregular" "$srisppack" tables -o no
check "a FIFO as photo of a pack" told "" "$srisppack" --strict --photos fifo.jpg -o no

# URLs: nobody is asked.
/usr/bin/python3 - <<'P' &
import os, socket
listener = socket.socket()
listener.bind(("127.0.0.1", 0))
listener.listen()
listener.settimeout(120)
open("port.tmp", "w").write(str(listener.getsockname()[1]))
os.rename("port.tmp", "port")
while not os.path.exists("asked"):
    try:
        connection, _ = listener.accept()
    except OSError:
        break
    open("asked" if not os.path.exists("done") else "bye", "w").close()
    connection.close()
    if os.path.exists("done"):
        break
P
server=$!
until [ -e port ]; do sleep 0.1; done
host=127.0.0.1:$(cat port)
url=http://$host/a.mp4
mkdir -p "http:/$host"
cp "$photo" "http:/$host/a.mp4"
head -c 100000 /dev/zero >"http:/$host/b.mp4"
for name in "$url" "http://$host/b.mp4" "http://$host/a.mp4?x" "http:/$host/b.mp4"; do
    for key in source reference model parameters; do
        printf '{"format":"srisp-recipe-1","source":"photo.jpg","reference":"reference.dng","%s":"%s"}' $key "$name" |
            sed "s/\"$key\":\"[^\"]*\",\(.*\"$key\"\)/\1/" >url.srisp
        check "a recipe's $key '$name'" told "$(case $name in *://*) echo "is a URL" ;; esac)" iinfo url.srisp
    done
done
check "a URL in a query" told "is a URL" iinfo "$url.srisp?reference=reference.dng"
check "as its reference" told "is a URL" iinfo "photo.jpg.srisp?reference=$url"
check "as its model" told "is a URL" iinfo "photo.jpg.srisp?reference=reference.dng&model=$url"
check "as its parameters" told "is a URL" iinfo "photo.jpg.srisp?params=$url"
check "a URL as reference" told "is a URL" "$tool" "$photo" --srisp-unprocess "$url" -o no.exr
check "a URL as parameters" told "is a URL" "$tool" "$photo" "--srisp-unprocess:params=\"$url\"" - -o no.exr
check "a URL to pack" told "is a URL" "$srisppack" --photos "$url" -o no
check "a URL to bake" told "is a URL" "$srispbake" --reference "$url" -o no
check "a URL as a bake's photo" told "is a URL" "$srispbake" --reference "$reference" --source "$url" -o no
check "no URL was opened" [ ! -e asked ]
touch done
kill $server 2>/dev/null
wait $server 2>/dev/null

# Messages are UTF-8 whatever they show.
check "an error that Python can read" works /usr/bin/python3 - <<'P'
import OpenImageIO as oiio
for query in ("reference=%ü日", "reference=%日本", "reference=a&model=%FF%E6%97", "reference=%FF.dng", "%E6=1", "input=%C3"):
    image = oiio.ImageInput.open("photo.jpg.srisp?" + query)
    assert image is None
    assert oiio.geterror(), query
P
check "no output is left" sh -c '[ ! -e no ] && [ ! -e no.tif ] && [ ! -e no.exr ] && [ ! -e no.json ]'
check "nothing is left" nothing_left
finish
