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

# What srispeval starts for packs; where the trainer is built alone, it is srispeval.
add_executable(srispeval_pack srispeval_pack/main.cpp)
target_link_libraries(srispeval_pack PRIVATE srisp_train srisp_tools_common)
target_precompile_headers(srispeval_pack REUSE_FROM srisp_train)
if(SRISP_TRAINER_ONLY)
    set_target_properties(srispeval_pack PROPERTIES OUTPUT_NAME srispeval)
    srisp_install_trainer_tool(srispeval_pack)
else()
    set_target_properties(srispeval_pack PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/libexec/srisp)
    install(TARGETS srispeval_pack DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/srisp OPTIONAL)
endif()

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
