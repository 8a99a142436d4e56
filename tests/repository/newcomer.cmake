# SPDX-License-Identifier: Apache-2.0
# A toolchain file: the machine on which readme_test.sh builds. In the folder SRISP_NEWCOMER may be
#   hidden    a list of folders in which CMake finds nothing
#   objects   a build folder whose objects are taken, so that nothing is compiled twice
if(EXISTS $ENV{SRISP_NEWCOMER}/hidden)
    file(READ $ENV{SRISP_NEWCOMER}/hidden CMAKE_IGNORE_PATH)
endif()
if(EXISTS $ENV{SRISP_NEWCOMER}/objects)
    set(CMAKE_CXX_COMPILER_LAUNCHER sh ${CMAKE_CURRENT_LIST_DIR}/take_object.sh $ENV{SRISP_NEWCOMER}/objects)
endif()
