# SPDX-License-Identifier: Apache-2.0
# Installs share/doc/srisp/sbom.spdx.json, a list of what was installed and of what it was built with (SPDX 2.3):
# sbom_install.cmake adds the files, which are known then. docs/contributing.md has the reasons for each.
set(SRISP_SBOM_PACKAGES "")

# srisp_sbom(NAME VERSION LICENCE KIND LIBRARY...): something that was found. KIND: DYNAMIC_LINK, or DEPENDS_ON (headers, whose
# code is in our files). LIBRARY: its names as programs need them, without versions.
macro(srisp_sbom name version licence kind)
    if(NOT "${version}" STREQUAL "")
        string(REPLACE ";" " " libraries "libraries: ${ARGN}")
        string(APPEND SRISP_SBOM_PACKAGES "${name}|${version}|${licence}|${kind}|${libraries}\n")
    endif()
endmacro()

foreach(package nlohmann_json CLI11 OpenColorIO) # found in other folders
    find_package(${package} QUIET)
endforeach()

srisp_sbom(OpenImageIO "${OpenImageIO_VERSION}" BSD-3-Clause DYNAMIC_LINK libOpenImageIO libOpenImageIO_Util)
srisp_sbom(OpenColorIO "${OpenColorIO_VERSION}" BSD-3-Clause DYNAMIC_LINK libOpenColorIO)
srisp_sbom(LibRaw "${LIBRAW_VERSION}" "LGPL-2.1-only OR CDDL-1.0" DYNAMIC_LINK libraw_r)
srisp_sbom(LittleCMS "${LCMS_VERSION}" MIT DYNAMIC_LINK liblcms2)
srisp_sbom(libtiff "${TIFF_VERSION}" libtiff DYNAMIC_LINK libtiff)
srisp_sbom(libheif "${HEIF_VERSION}" LGPL-3.0-or-later DYNAMIC_LINK libheif)
srisp_sbom(libjpeg-turbo "${JPEG_VERSION}" "IJG AND BSD-3-Clause AND Zlib" DYNAMIC_LINK libjpeg)
srisp_sbom(libwebp "${WEBP_libwebp_VERSION}" BSD-3-Clause DYNAMIC_LINK libwebp libwebpdemux)
srisp_sbom(pugixml "${PUGIXML_VERSION}" MIT DYNAMIC_LINK libpugixml)
srisp_sbom(zlib "${ZLIB_VERSION}" Zlib DYNAMIC_LINK libz)
srisp_sbom(OpenSSL "${CRYPTO_VERSION}" Apache-2.0 DYNAMIC_LINK libcrypto)
srisp_sbom(Highway "${HWY_VERSION}" Apache-2.0 DYNAMIC_LINK libhwy)
srisp_sbom(xxHash "${XXHASH_VERSION}" BSD-2-Clause DEPENDS_ON)
srisp_sbom(nlohmann-json "${nlohmann_json_VERSION}" MIT DEPENDS_ON)
srisp_sbom(CLI11 "${CLI11_VERSION}" BSD-3-Clause DEPENDS_ON)
if(TARGET srisp_python)
    srisp_sbom(OpenEXR "${OpenEXR_VERSION}" BSD-3-Clause DYNAMIC_LINK libOpenEXR)
    srisp_sbom(pybind11 "${pybind11_VERSION}" BSD-3-Clause DEPENDS_ON)
    srisp_sbom(Python "${Python_VERSION}" Python-2.0 DEPENDS_ON)
endif()
if(TARGET srisp_train)
    srisp_sbom(LibTorch "${Torch_VERSION}" BSD-3-Clause DYNAMIC_LINK libtorch libtorch_cpu libtorch_cuda libc10 libc10_cuda)
endif()

configure_file(${CMAKE_CURRENT_LIST_DIR}/sbom_install.cmake.in ${PROJECT_BINARY_DIR}/lib/sbom_install.cmake @ONLY)
install(SCRIPT ${PROJECT_BINARY_DIR}/lib/sbom_install.cmake)
