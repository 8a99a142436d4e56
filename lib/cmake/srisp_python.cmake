# SPDX-License-Identifier: Apache-2.0
# Whether the Python package can be built. Sanitizers are left out: the interpreter is built without.
if(NOT SRISP_BUILD_PYTHON OR SRISP_TRAINER_ONLY OR SRISP_SANITIZE)
    return()
endif()
# Debian's interpreter, before others that are on the path: its packages (numpy, torch) are what the package is used with.
if(NOT DEFINED Python_EXECUTABLE AND EXISTS /usr/bin/python3)
    set(Python_EXECUTABLE /usr/bin/python3)
endif()
find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module)
if(Python_FOUND)
    find_package(pybind11 2.10 QUIET)
    find_package(OpenEXR 3.1 QUIET)
endif()
if(pybind11_FOUND AND OpenEXR_FOUND)
    add_subdirectory(lib/python)
else()
    message(STATUS "No Python package: python3-dev, pybind11-dev or libopenexr-dev was not found")
endif()
