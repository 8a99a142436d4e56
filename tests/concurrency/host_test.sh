#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# A host with threads of TBB and OpenMP, in a locale that prints numbers with a comma.
. "$(dirname "$0")/../repository/check.sh"
cat >"$scratch/comma" <<'END'
LC_CTYPE
copy "POSIX"
END LC_CTYPE
LC_NUMERIC
decimal_point ","
thousands_sep "."
grouping 3;3
END LC_NUMERIC
END
localedef -c -i "$scratch/comma" -f ANSI_X3.4-1968 "$scratch/comma_LOCALE" >/dev/null 2>&1
if [ -f "$scratch/comma_LOCALE/LC_NUMERIC" ]; then
    export LOCPATH="$scratch" LC_ALL=comma_LOCALE
else
    echo "SKIPPED host_test.sh: the C locale with a comma needs localedef and its sources (Debian: locales)"
fi
check "the same bits, and nothing of the host's changed" "$build/bin/host" --jobs 60
finish
