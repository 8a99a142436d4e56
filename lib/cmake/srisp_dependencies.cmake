# SPDX-License-Identifier: Apache-2.0
# OpenImageIO, as the build and the installed package need it.
find_package(OpenImageIO 2.4 REQUIRED)
find_package(Threads REQUIRED)

# Targets of Debian 12's packages name include folders that are not installed (/usr/include/opencv4, /include).
function(srisp_drop_missing_includes target)
    get_target_property(includes ${target} INTERFACE_INCLUDE_DIRECTORIES)
    set(existing "")
    foreach(folder IN LISTS includes)
        if(EXISTS "${folder}" OR folder MATCHES "^\\$<")
            list(APPEND existing "${folder}")
        endif()
    endforeach()
    set_target_properties(${target} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${existing}")
endfunction()
srisp_drop_missing_includes(OpenImageIO::OpenImageIO)
