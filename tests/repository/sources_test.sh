#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# What holds for every source file: format, licence line, length; and that scripts parse.
. "$(dirname "$0")/check.sh"
cd "$source" || exit 1
find $(ls -d lib plugin ocio tools tests configs .ci CMakeLists.txt 2>/dev/null) -type f ! -path '*/models/*' ! -path '*/sample/*' >"$scratch/files"
grep -E '\.(cpp|h)$' "$scratch/files" >"$scratch/cpp"
grep -E '\.(cpp|h|cu|sh|py|cmake|in|map)$|CMakeLists\.txt$|^\.ci/run$' "$scratch/files" >"$scratch/sources"

has_licence() { ! xargs -d '\n' grep -L 'SPDX-License-Identifier: Apache-2.0' <"$scratch/sources" | grep .; }
fits() { ! xargs -d '\n' -n 1 wc -l <"$scratch/sources" | awk '$1 > 500' | grep .; }
formatted() { xargs -d '\n' clang-format-14 --dry-run -Werror <"$scratch/cpp"; }
one_json_door() { ! grep -E '^(lib|plugin|ocio|tools)/' "$scratch/cpp" | grep -vx lib/base/json_text.cpp |
    xargs -d '\n' grep -nE '(::|\.)(sax_)?parse\(|json::accept\(|json_stream' | grep -E 'json|sax_'; }
parses() { grep '\.sh$' "$scratch/sources" | while read -r file; do sh -n "$file" || return 1; done; }

tells_no_command() { ! grep -lraE 'oiiotool .* -o |/home/' docs/images configs/sample; }

check "every source file has its SPDX line" has_licence
check "no source file is longer than 500 lines" fits
check "every shell script parses" parses
check "no picture tells the command that made it" tells_no_command
check "JSON is parsed by lib/base/json_text.cpp alone, which knows limits" one_json_door
if command -v clang-format-14 >/dev/null; then
    check "clang-format-14 would change nothing" formatted
else
    echo "SKIPPED tests/repository/sources_test.sh: needs clang-format-14" >&2
fi
finish
