# SPDX-License-Identifier: Apache-2.0
# Library, headers, CMake package and pkg-config file. All find each other by relative paths: any prefix, movable.
include(CMakePackageConfigHelpers)
set(_srisp_package ${CMAKE_INSTALL_LIBDIR}/cmake/srisp)

install(TARGETS srisp EXPORT srisp_targets
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT python NAMELINK_COMPONENT development)
install(DIRECTORY include/srisp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT srisp_targets FILE srisp-targets.cmake NAMESPACE srisp:: DESTINATION ${_srisp_package})

configure_package_config_file(cmake/srisp-config.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/srisp-config.cmake
    INSTALL_DESTINATION ${_srisp_package})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/srisp-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES
    ${CMAKE_CURRENT_BINARY_DIR}/srisp-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/srisp-config-version.cmake
    cmake/srisp_dependencies.cmake
    DESTINATION ${_srisp_package})

# From the folder of srisp.pc up to the prefix.
file(RELATIVE_PATH SRISP_PC_PREFIX /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(cmake/srisp.pc.in ${CMAKE_CURRENT_BINARY_DIR}/srisp.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/srisp.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
