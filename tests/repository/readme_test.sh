#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Runs every command that README and docs/ show, in their order, as somebody new does: in a clone without a build, on a
# machine where LibTorch comes with tests/run.sh. Each fenced block of sh or python runs in a shell of its own in the root
# of the clone, where there are files of the names that the text uses; README's blocks of cpp are built with what it
# installed, and run. Real are the demo, its build and the installation; of tests/run.sh all but the tests themselves.
# The objects are those of the build that is tested: compiling them again would show nothing.
. "$(dirname "$0")/check.sh"
sample=$source/configs/sample
work=$scratch/work
home=$scratch/home
mkdir -p "$work/tests" "$home"

# The clone.
for entry in "$source"/*; do
    case ${entry##*/} in tests | build* | run | srisp-demo) ;; *) ln -s "$entry" "$work/" ;; esac
done
ln -s "$source"/tests/* "$work/tests/"
# All that tests/run.sh does, but the tests are only listed: this is one of them. Its first run is without LibTorch.
mv "$work/tests/run.sh" "$work/tests/real_run.sh"
cat >"$work/tests/run.sh" <<'END'
set -e
run=$(dirname "$0")/real_run.sh
sh "$run" -N >"$SRISP_NEWCOMER/run.without"
[ ! -f "$SRISP_NEWCOMER/trainer" ] || rm -f "$SRISP_NEWCOMER/hidden"
sh "$run" -N >"$SRISP_NEWCOMER/run.with"
END
cp "$sample/photo.jpg" "$work/photo.jpg"
cp "$sample/photo.jpg" "$work/my.jpg"
cp "$sample/reference.dng" "$work/ref.dng"
cp "$sample/reference.dng" "$work/my.dng"
for frame in 0001 0002 0003; do cp "$sample/photo.jpg" "$work/shot.$frame.jpg"; done

# The machine: LibTorch is hidden until tests/run.sh, and comes then if the build that is tested has it.
export SRISP_NEWCOMER="$scratch" CMAKE_TOOLCHAIN_FILE="$source/tests/repository/newcomer.cmake"
unset SRISP_BUILD_DIR
cached() { sed -n "s/^$1:[A-Z]*=//p" "$build/CMakeCache.txt"; }
torch=$(cached Torch_DIR)
printf '%s' "$torch;${torch#/usr};/usr$torch" >"$scratch/hidden"
[ -n "$(cached SRISP_NO_TRAINER)" ] || : >"$scratch/trainer"
[ "$(cached SRISP_SANITIZE)" != OFF ] || ln -s "$build" "$scratch/objects"

# Writes the blocks as $scratch/block.<number>.<language>, and fails where one has no known language.
blocks_of() {
    awk -v stem="$scratch/block." -v list="$scratch/blocks" -v document="$1" '
        /^```/ && inside { inside = 0; close(file); next }
        /^```/ {
            inside = 1
            language = substr($0, 4)
            file = sprintf("%s%03d.%s", stem, NR, language)
            if (language ~ /^(sh|python|cpp)$/) printf "%d %s %s\n", NR, language, file >list
            else if (language !~ /^(text|json|cmake)$/) { print document ":" NR ": block of unknown language"; exit 1 }
            next
        }
        inside { print >file }' "$source/$1"
}

# A block without main() is the body of one.
run_cpp() {
    if grep -q 'main(' "$1"; then
        cp "$1" "$1.main.cpp"
    else
        { grep '^#include' "$1"; echo 'int main() {'; grep -v '^#include' "$1"; echo '}'; } >"$1.main.cpp"
    fi
    library=$(dirname "$(find "$HOME/srisp" -name srisp.pc)")
    g++ -std=c++17 -Wall -Wextra -Werror "$1.main.cpp" -o "$1.out" \
        $(PKG_CONFIG_PATH=$library pkg-config --cflags --libs srisp) -Wl,-rpath,"${library%/pkgconfig}" && "$1.out"
}

run_block() (
    cd "$work" || exit 1
    export HOME="$home"
    export PATH="$HOME/srisp/bin:$PATH"
    case $1 in
        sh) sh -ex "$2" </dev/null ;;
        python)
            OIIO_LIBRARY_PATH="$HOME/srisp/lib/srisp" PYTHONPATH="$(echo "$HOME"/srisp/lib/python3*/dist-packages)" \
                /usr/bin/python3 "$2" </dev/null
            ;;
        cpp) run_cpp "$2" ;;
    esac
)

run_document() {
    rm -f "$scratch"/block.*
    : >"$scratch/blocks"
    check "$1: every block says its language" blocks_of "$1"
    if grep -q '^All blocks of this page are one program' "$source/$1"; then
        cat "$scratch"/block.*.python >"$scratch/program"
        check "$1 runs" run_block python "$scratch/program"
        return
    fi
    while read -r line language file; do
        [ "$language" != cpp ] || [ "$1" = README.md ] || continue
        check "$1:$line runs" run_block "$language" "$file"
    done <"$scratch/blocks"
}

check "README has at most 180 lines" test "$(wc -l <"$source/README.md")" -le 180
run_document README.md
echo 'sh tests/run.sh' >"$scratch/tests.sh"
[ -f "$scratch/run.with" ] || check "tests/run.sh runs" run_block sh "$scratch/tests.sh"

last_lines() { tail -n 2 "$1" | tr '\n' ' '; }
says_no_trainer() { last_lines "$1" | grep 'NOT BUILT, NOT TESTED srisptrain.*LibTorch.* passed, '; }
has_trainer() { grep ': train$' "$scratch/run.with" && ! says_no_trainer "$scratch/run.with" && "$work/build/bin/srisptrain" --version; }
check "tests/run.sh says in its last lines that there is no trainer" says_no_trainer "$scratch/run.without"
if [ -f "$scratch/trainer" ]; then
    check "tests/run.sh finds LibTorch in a folder that was configured without" has_trainer
    echo 'sh tools/demo.sh && cmake --install build --prefix "$HOME/srisp"' >"$scratch/again.sh"
    check "the demo runs and is installed after the tests, too" run_block sh "$scratch/again.sh"
    check "the trainer is installed then" test -x "$home/srisp/bin/srisptrain"
else
    echo "SKIPPED $0: needs LibTorch for the order demo, install, tests/run.sh"
fi
for document in "$source"/docs/*.md; do
    case ${document##*/} in contributing.md | training.md) ;; *) run_document "docs/${document##*/}" ;; esac
done
check "the results are there" test -s "$work/raw.exr" -a -s "$work/raw.0003.exr" -a -s "$work/srisp-demo/sheet.png"
finish
