# SPDX-License-Identifier: Apache-2.0
# The tools that train models and hold them against tests. They take longest to build: they are installed where they are
# built, and `cmake --install` says where not.
function(srisp_install_trainer_tool name)
    install(TARGETS ${name} DESTINATION ${CMAKE_INSTALL_BINDIR} OPTIONAL)
    srisp_man_page(${name} --help OPTIONAL)
    install(CODE "if(NOT EXISTS \"$<TARGET_FILE:${name}>\")
        message(STATUS \"Not built, so not installed: ${name}\")
    endif()")
endfunction()

add_executable(srispeval srispeval/main.cpp)
target_link_libraries(srispeval PRIVATE srisp_train srisp_tools_common)
target_precompile_headers(srispeval REUSE_FROM srisp_train)
srisp_install_trainer_tool(srispeval)

add_custom_target(srisp_commit BYPRODUCTS ${CMAKE_CURRENT_BINARY_DIR}/srisp_commit.h
    COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DOUTPUT=${CMAKE_CURRENT_BINARY_DIR}/srisp_commit.h
        -P ${CMAKE_CURRENT_SOURCE_DIR}/srisptrain/commit.cmake VERBATIM)
file(GLOB srisptrain_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/srisptrain/*.cpp)
add_executable(srisptrain ${srisptrain_sources})
add_dependencies(srisptrain srisp_commit)
target_include_directories(srisptrain PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
target_link_libraries(srisptrain PRIVATE srisp_train srisp_tools_common)
target_precompile_headers(srisptrain REUSE_FROM srisp_train)
srisp_compile_together(srisptrain)
srisp_install_trainer_tool(srisptrain)
