# SPDX-License-Identifier: Apache-2.0
# OpenImageIO, as the build and the installed package need it.
find_package(OpenImageIO 2.4 REQUIRED)
find_package(Threads REQUIRED)

# Debian 12's OpenImageIO target names include folders that its packages do not install (/usr/include/opencv4).
get_target_property(_srisp_includes OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
set(_srisp_existing "")
foreach(_srisp_folder IN LISTS _srisp_includes)
    if(EXISTS "${_srisp_folder}" OR _srisp_folder MATCHES "^\\$<")
        list(APPEND _srisp_existing "${_srisp_folder}")
    endif()
endforeach()
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${_srisp_existing}")
