# SPDX-License-Identifier: Apache-2.0
# Writes OUTPUT, a header with the commit of the sources in SOURCE, where git knows it; touches it only when it changes.
set(commit "")
find_program(git git)
if(git)
    execute_process(COMMAND ${git} describe --always --abbrev=40 --exclude * --dirty
        WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
set(text "// Made by commit.cmake\nconstexpr char kSourceCommit[] = \"${commit}\";\n")
set(old "")
if(EXISTS ${OUTPUT})
    file(READ ${OUTPUT} old)
endif()
if(NOT old STREQUAL text)
    file(WRITE ${OUTPUT} "${text}")
endif()
