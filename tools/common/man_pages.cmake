# SPDX-License-Identifier: Apache-2.0
# srisp_man_page(tool help_option [OPTIONAL]): builds and installs <tool>.1 from what the tool itself says.
function(srisp_man_page tool help_option)
    set(page ${PROJECT_BINARY_DIR}/share/man/man1/${tool}.1)
    set(script ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/man_page.sh)
    file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/share/man/man1)
    add_custom_command(OUTPUT ${page}
        COMMAND sh ${script} $<TARGET_FILE:${tool}> ${help_option} ${PROJECT_VERSION} > ${page}.new
        COMMAND ${CMAKE_COMMAND} -E rename ${page}.new ${page}
        DEPENDS ${tool} ${script} VERBATIM)
    add_custom_target(${tool}_man_page ALL DEPENDS ${page})
    install(FILES ${page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 ${ARGN})
endfunction()
