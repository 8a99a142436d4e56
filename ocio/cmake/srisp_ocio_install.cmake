# SPDX-License-Identifier: Apache-2.0
# Library and headers, beside those of lib: find_package(srisp COMPONENTS ocio) gives srisp::ocio.
set(_srisp_package ${CMAKE_INSTALL_LIBDIR}/cmake/srisp)
set_target_properties(srisp_ocio PROPERTIES EXPORT_NAME ocio)

install(TARGETS srisp_ocio EXPORT srisp_ocio_targets DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY include/srisp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT srisp_ocio_targets FILE srisp_ocio-targets.cmake NAMESPACE srisp:: DESTINATION ${_srisp_package})
install(FILES cmake/srisp_ocio_dependencies.cmake DESTINATION ${_srisp_package})
# From the folder of srisp_ocio.pc up to the prefix.
file(RELATIVE_PATH SRISP_PC_PREFIX /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(cmake/srisp_ocio.pc.in ${CMAKE_CURRENT_BINARY_DIR}/srisp_ocio.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/srisp_ocio.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
