# SPDX-License-Identifier: Apache-2.0
# The tools that read images: srisptool, srisppack.
set(SRISP_LIBEXEC_DIR ${CMAKE_INSTALL_LIBEXECDIR}/srisp)

# All of srisptool but its main(), for the tests too. No OpenImageIO: it would cost its start-up time twice.
add_library(srisptool_parts STATIC
    srisptool/child_process.cpp
    srisptool/command_line.cpp
    srisptool/command_table.cpp
    srisptool/frame_pattern.cpp
    srisptool/help.cpp
    srisptool/inputs.cpp
    srisptool/job.cpp
    srisptool/modifiers.cpp
    srisptool/output_depth.cpp
    srisptool/rewriter.cpp
    srisptool/session.cpp
    srisptool/srisp_command.cpp
    srisptool/stock_oiiotool.cpp)
target_link_libraries(srisptool_parts PUBLIC srisp_tools_common srisp_file)

add_executable(srisptool srisptool/main.cpp)
target_compile_definitions(srisptool PRIVATE SRISP_VERSION="${PROJECT_VERSION}")
target_link_libraries(srisptool PRIVATE srisptool_parts)
install(TARGETS srisptool DESTINATION ${CMAKE_INSTALL_BINDIR})

# The same program under oiiotool's name, for those who put its folder in front of PATH.
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/libexec/srisp)
file(CREATE_LINK ../../bin/srisptool ${PROJECT_BINARY_DIR}/libexec/srisp/oiiotool SYMBOLIC)
install(PROGRAMS ${PROJECT_BINARY_DIR}/libexec/srisp/oiiotool DESTINATION ${SRISP_LIBEXEC_DIR})

# Loaded into the stock oiiotool, which knows no sanitizers.
add_library(output_guard MODULE srisptool/output_guard.cpp)
set_target_properties(output_guard PROPERTIES PREFIX ""
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib/srisp)
target_link_libraries(output_guard PRIVATE ${CMAKE_DL_LIBS})
if(SRISP_SANITIZE)
    target_compile_options(output_guard PRIVATE -fno-sanitize=all)
    target_link_options(output_guard PRIVATE -fno-sanitize=all)
endif()
install(TARGETS output_guard DESTINATION ${CMAKE_INSTALL_LIBDIR}/srisp)

srisp_man_page(srisptool --srisp-help)

# All of srisppack but its main(), for the tests too.
add_library(srisppack_parts STATIC
    srisppack/camera_folder.cpp
    srisppack/crops.cpp
    srisppack/csv_table.cpp
    srisppack/help.cpp
    srisppack/inputs.cpp
    srisppack/linear_set.cpp
    srisppack/manifest.cpp
    srisppack/options.cpp
    srisppack/pack_images.cpp
    srisppack/pack_run.cpp
    srisppack/photo_task.cpp
    srisppack/raw_task.cpp
    srisppack/reflectance.cpp
    srisppack/spectra.cpp
    srisppack/summary.cpp
    srisppack/unmasked_part.cpp)
target_compile_definitions(srisppack_parts PUBLIC SRISP_VERSION="${PROJECT_VERSION}")
target_link_libraries(srisppack_parts PUBLIC srisp_tools_common srisp_static CLI11::CLI11)

add_executable(srisppack srisppack/main.cpp)
target_link_libraries(srisppack PRIVATE srisppack_parts)
install(TARGETS srisppack DESTINATION ${CMAKE_INSTALL_BINDIR})
srisp_man_page(srisppack --help)

# All of srispbake but its main(), for the tests too.
add_library(srispbake_parts STATIC
    srispbake/bake.cpp
    srispbake/bake_errors.cpp
    srispbake/choice.cpp
    srispbake/config_entries.cpp
    srispbake/config_fragment.cpp
    srispbake/cube_file.cpp
    srispbake/help.cpp
    srispbake/linear_srgb.cpp
    srispbake/options.cpp
    srispbake/output_names.cpp
    srispbake/photo_sample.cpp
    srispbake/report.cpp
    srispbake/watch.cpp
    srispbake/yaml_sections.cpp)
target_include_directories(srispbake_parts PUBLIC ${PROJECT_SOURCE_DIR}/lib/src ${PROJECT_SOURCE_DIR}/ocio/src)
target_compile_definitions(srispbake_parts PUBLIC SRISP_VERSION="${PROJECT_VERSION}")
target_link_libraries(srispbake_parts PUBLIC srisp_tools_common srisp_ocio_static CLI11::CLI11)

add_executable(srispbake srispbake/main.cpp)
target_link_libraries(srispbake PRIVATE srispbake_parts)
install(TARGETS srispbake DESTINATION ${CMAKE_INSTALL_BINDIR})
srisp_man_page(srispbake --help)
