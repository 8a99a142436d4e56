# SPDX-License-Identifier: Apache-2.0
# The tools that read images.
set(SRISP_LIBEXEC_DIR ${CMAKE_INSTALL_LIBEXECDIR}/srisp)

# A tool: srisp_image_tool(NAME library...). All but its main.cpp is NAME_parts, which the tests link, too. The libraries are
# the rooms that docs/architecture.md allows it.
function(srisp_image_tool name)
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
    list(FILTER sources EXCLUDE REGEX "/(main|output_guard)\\.cpp$")
    add_library(${name}_parts STATIC ${sources})
    target_link_libraries(${name}_parts PUBLIC srisp_tools_common ${ARGN})
    add_executable(${name} ${name}/main.cpp)
    target_link_libraries(${name} PRIVATE ${name}_parts)
    install(TARGETS ${name} DESTINATION ${CMAKE_INSTALL_BINDIR})
endfunction()

# No OpenImageIO: it would cost its start-up time twice.
srisp_image_tool(srisptool srisp_base srisp_model srisp_recipe)
srisp_man_page(srisptool --srisp-help)

# The same program under oiiotool's name, for those who put its folder in front of PATH.
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/libexec/srisp)
file(CREATE_LINK ../../bin/srisptool ${PROJECT_BINARY_DIR}/libexec/srisp/oiiotool SYMBOLIC)
install(PROGRAMS ${PROJECT_BINARY_DIR}/libexec/srisp/oiiotool DESTINATION ${SRISP_LIBEXEC_DIR})

# Loaded into the stock oiiotool, which knows no sanitizers.
add_library(output_guard MODULE srisptool/output_guard.cpp common/unfinished_output.cpp
    ${PROJECT_SOURCE_DIR}/lib/base/png_orientation.cpp ${PROJECT_SOURCE_DIR}/lib/base/device_output.cpp)
target_include_directories(output_guard PRIVATE ${PROJECT_SOURCE_DIR}/lib)
set_target_properties(output_guard PROPERTIES PREFIX ""
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib/srisp)
target_link_libraries(output_guard PRIVATE ${CMAKE_DL_LIBS})
if(SRISP_SANITIZE)
    target_compile_options(output_guard PRIVATE -fno-sanitize=all)
    target_link_options(output_guard PRIVATE -fno-sanitize=all)
endif()
install(TARGETS output_guard DESTINATION ${CMAKE_INSTALL_LIBDIR}/srisp)

srisp_image_tool(srisppack srisp_base srisp_model srisp_recipe srisp_thumbnail srisp_container srisp_photo
    srisp_pack)
target_link_libraries(srisppack_parts PUBLIC srisp_static) # load_reference, by its public header
srisp_man_page(srisppack --help)

srisp_image_tool(srispbake srisp_base srisp_photo srisp_ocio_static)
target_include_directories(srispbake_parts PRIVATE ${PROJECT_SOURCE_DIR}) # parts of ocio, by their path
srisp_man_page(srispbake --help)

srisp_image_tool(srispbatch srisp_base srisp_recipe srisp_container srisp_photo srisp_reference srisp_result)
target_link_libraries(srispbatch_parts PUBLIC srisp_static) # its public headers
srisp_man_page(srispbatch --help)

srisp_image_tool(srispeval srisp_base srisp_camera srisp_recipe srisp_thumbnail srisp_container srisp_reference srisp_pack
    srisp_rendering srisp_result)
target_link_libraries(srispeval_parts PUBLIC srisp_static) # its public headers
target_include_directories(srispeval_parts PUBLIC ${CMAKE_CURRENT_SOURCE_DIR}/srispeval)
srisp_man_page(srispeval --help)

# The report's style sheet, page parts and scripts, in the program.
set(report ${CMAKE_CURRENT_SOURCE_DIR}/srispeval/report)
set(report_files report.css report_sort.js report_pictures.js report_viewer.js report_viewer.html)
string(REPLACE ";" "," report_list "${report_files}")
list(TRANSFORM report_files PREPEND ${report}/)
add_custom_command(OUTPUT report_assets.cpp
    COMMAND ${CMAKE_COMMAND} -DSOURCE=${report} -DFILES=${report_list} -DOUTPUT=report_assets.cpp
        -P ${report}/embed.cmake
    DEPENDS ${report_files} ${report}/embed.cmake VERBATIM)
target_sources(srispeval_parts PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/report_assets.cpp)
target_include_directories(srispeval_parts PRIVATE ${report})

# Started by the others, so it is no command of users'. Of the libraries that its own link it needs few, and each costs
# time to load: OpenImageIO alone, whose two hundred it does not call, a third of a second.
add_executable(srispdecode srispdecode/main.cpp)
target_link_libraries(srispdecode PRIVATE srisp_noise)
target_link_options(srispdecode PRIVATE -Wl,--as-needed)
set_target_properties(srispdecode PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/libexec/srisp)
install(TARGETS srispdecode DESTINATION ${SRISP_LIBEXEC_DIR} COMPONENT python)
