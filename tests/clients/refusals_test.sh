# SPDX-License-Identifier: Apache-2.0
# With the plugin loaded, what nobody can read still fails at once: OpenImageIO 2.4 offers it to every plugin under a lock.
. "${0%/*}/setup.sh"

head -c 1000 /dev/zero >garbage.png
head -c 1000 /dev/zero >garbage.srisp
oiiotool photo.jpg -o whole.png
head -c 3000 whole.png >truncated.png
mkdir folder.exr
for reader in iinfo "oiiotool --info" "iconvert -v"; do
    for file in missing.exr garbage.png unknown.extension missing.srisp garbage.srisp folder.exr photo.jpg.srisp \
        "missing.jpg.srisp?reference=reference.dng" "garbage.png.srisp?reference=reference.dng" \
        "photo.jpg.srisp?refrence=reference.dng" "photo.jpg.srisp?reference" "photo.jpg.srisp?reference=missing.dng" \
        "photo.jpg.srisp?reference=photo.jpg" "folder.exr.srisp?reference=reference.dng" "x.srisp.srisp?reference=a"; do
        target=
        [ "$reader" = "iconvert -v" ] && target=out.exr
        # shellcheck disable=SC2086
        check "$reader refuses $file at once" says "" $reader "$file" $target
        check "$reader leaves nothing of $file" test ! -e out.exr
    done
done

check "a misspelt option is named" says "did you mean 'reference'?" iinfo "photo.jpg.srisp?refrence=reference.dng"
check "an unknown model is named" says "did you mean 'spatial'?" iinfo "$name&model=spatail"
check "a missing source is named" says "photo 'missing.jpg': does not exist" iinfo "missing.jpg.srisp?reference=reference.dng"
check "a missing reference is named" says "reference 'missing.dng'" iinfo "photo.jpg.srisp?reference=missing.dng"
check "a JPEG is no reference" says "display-encoded" iinfo "photo.jpg.srisp?reference=photo.jpg"
check "a truncated photo is an error" says "truncated.png" oiiotool "truncated.png.srisp?reference=reference.dng" -o t.exr
check "a truncated photo leaves no output" test ! -e t.exr
check "srisp is no format to write" says "srisp files hold no pixels" oiiotool photo.jpg -o picture.srisp
check "and nothing is written" test ! -e picture.srisp
finish
