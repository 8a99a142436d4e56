# SPDX-License-Identifier: Apache-2.0
# Writes OUTPUT, a C++ source that holds the FILES (with commas between them; of folder SOURCE) for report_assets.h:
#   cmake -DSOURCE=folder -DFILES=report.css,report.js -DOUTPUT=report_assets.cpp -P embed.cmake
set(text "// Made by embed.cmake\n#include \"report_assets.h\"\n\nnamespace srisp::tool {\n")
string(REPLACE "," ";" files "${FILES}")
foreach(file IN LISTS files)
    string(MAKE_C_IDENTIFIER "${file}" name)
    file(READ "${SOURCE}/${file}" bytes HEX)
    file(SHA256 "${SOURCE}/${file}" hash)
    # Single characters: compilers limit the length of a string literal.
    string(REGEX REPLACE "(..)" "'\\\\x\\1'," bytes "${bytes}")
    string(APPEND text "\nstatic constexpr char ${name}_bytes[] = { ${bytes} };\n"
        "Asset ${name}()\n{\n    return { { ${name}_bytes, sizeof ${name}_bytes }, \"${hash}\" };\n}\n")
endforeach()
string(APPEND text "\n} // namespace srisp::tool\n")
file(WRITE "${OUTPUT}" "${text}")
