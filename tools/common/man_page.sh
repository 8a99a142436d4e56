#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Writes a man page from a tool's own help text, so that the two cannot differ.
#   sh man_page.sh TOOL HELP_OPTION VERSION
# The help text: "NAME -- what it is", "Usage: …", then paragraphs; "Examples:" and the like start sections.
set -eu
name=$(basename "$1")
"$1" "$2" | awk -v name="$name" -v version="$3" -v option="$2" '
    function section(title) {
        if (verbatim) print ".fi"
        print ".SH " toupper(title)
        print ".nf"
        verbatim = 1
    }
    {
        gsub(/\\/, "\\e")
        gsub(/-/, "\\-")
        sub(/^[.\x27]/, "\\\\\\&&")
    }
    NR == 1 {
        sub(/^.* \\-\\- /, "")
        printf ".\\\" Made by man_page.sh from %s %s\n.TH %s 1 \"\" \"srisp %s\" \"User Commands\"\n", name, option, toupper(name), version
        printf ".SH NAME\n%s \\- %s\n", name, $0
        next
    }
    /^Usage: / { section("Synopsis"); sub(/^Usage: /, ""); print; after_usage = 1; next }
    after_usage && !/^ / && NF { section("Description"); after_usage = 0 }
    /^(Options|Examples|Environment|Files|Exit codes):/ {
        title = body = $0
        sub(/:.*/, "", title)
        sub(/^[^:]*: */, "", body)
        section(title)
        if (body != "") print body
        next
    }
    { print }
    END { print ".fi"; print ".SH SEE ALSO"; print ".BR oiiotool (1)" }'
