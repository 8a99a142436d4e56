# SPDX-License-Identifier: Apache-2.0
# `cpack` in the build folder makes one Debian package. Configure with -DCMAKE_INSTALL_PREFIX=/usr for Debian's own folders
# (lib/x86_64-linux-gnu); others work as well.
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs)

set(CPACK_PACKAGE_CONTACT "the srisp authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "turns a photo into the RAW-like image of another camera")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION 
    "srisptool and a plugin for OpenImageIO: from a photo and one RAW file of a camera, the linear image that this camera
 would have recorded of the photo's scene. Library and headers included.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR DEB)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS openimageio-tools)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-numpy")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libopenimageio-dev, python3-openimageio")
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
include(CPack)
