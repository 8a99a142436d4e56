# SPDX-License-Identifier: Apache-2.0
# OpenImageIO loads plugins into other people's programs, for all to see.
. "${0%/*}/setup.sh"

module=$OIIO_LIBRARY_PATH/srisp.imageio.so
printf '%s\n' srisp_imageio_library_version srisp_imageio_version srisp_input_extensions srisp_input_imageio_create \
    srisp_output_extensions srisp_output_imageio_create >expected.txt
nm -D --defined-only "$module" | awk '{ print $3 }' | sort >exported.txt
check "nothing but the entry points is exported" diff expected.txt exported.txt
printf '%s\n' dng_imageio_library_version dng_imageio_version dng_output_extensions dng_output_imageio_create >expected_dng.txt
nm -D --defined-only "$OIIO_LIBRARY_PATH/dng.imageio.so" | awk '{ print $3 }' | sort >exported_dng.txt
check "nothing but the entry points of a writer is exported from dng.imageio" diff expected_dng.txt exported_dng.txt
check "neither LibTorch nor OpenColorIO is needed" sh -c '! ldd "$1" | grep -i torch && ! readelf -d "$1" | grep -i OpenColorIO' - "$module"
check "the format is listed" sh -c "oiiotool --list-formats | grep -q 'srisp'"
finish
