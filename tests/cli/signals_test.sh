#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# A signal reaches oiiotool, everything temporary goes, and srisptool dies of the same signal.
. "$(dirname "$0")/setup.sh"

# A stock oiiotool that takes its time in the middle of an output.
cat >slow_oiiotool <<'SLOW'
#!/bin/sh
echo "$$" >pid
: >out.0123abcd.temp.exr
printf '%s\0' "$PWD/out.0123abcd.temp.exr" >>"$SRISP_GUARD_LIST"
echo started >started
exec sleep 100
SLOW
chmod +x slow_oiiotool

# interrupted SIGNAL CODE
interrupted() {
    rm -f started pid
    # A shell ignores SIGINT for what it runs in the background: a program of its own resets that.
    /usr/bin/python3 -c "
import os, signal, sys
for name in ('SIGINT', 'SIGQUIT', 'SIGTERM', 'SIGHUP'): signal.signal(getattr(signal, name), signal.SIG_DFL)
os.environ['SRISP_OIIOTOOL'] = '$scratch/slow_oiiotool'
os.execv('$tool', ['$tool', '$photo', '--flip', '--srisp-unprocess', '$reference', '-o', 'out.exr'])" &
    srisptool=$!
    for _ in $(seq 200); do [ -e started ] && break; sleep 0.05; done
    [ -n "$(ls -A "$TMPDIR")" ] || { echo "no temporary folder was made"; return 1; }
    kill "-$1" "$srisptool"
    wait "$srisptool"
    code=$?
    [ "$code" -eq "$2" ] || { echo "exit code $code"; return 1; }
    ! kill -0 "$(cat pid)" 2>/dev/null || { echo "oiiotool lives on"; return 1; }
    [ ! -e out.0123abcd.temp.exr ] || { echo "an unfinished output is left"; return 1; }
    nothing_left
}
check "SIGINT" interrupted INT 130
check "SIGTERM" interrupted TERM 143
check "SIGHUP" interrupted HUP 129

killed() {
    interrupted KILL 137
    [ -n "$(ls -A "$TMPDIR")" ] || return 1
    for _ in $(seq 100); do kill -0 "$(cat pid)" 2>/dev/null || break; sleep 0.05; done
    ! kill -0 "$(cat pid)" 2>/dev/null || { echo "oiiotool lives on"; return 1; }
    $tool "$photo" --srisp-unprocess "$reference" -o next.exr
    [ ! -e out.0123abcd.temp.exr ] || { echo "an unfinished output is left"; return 1; }
    nothing_left
}
check "what SIGKILL leaves goes with the next run" killed

# The real one: in the middle of whatever it does at that time.
oiiotool "$photo" --resize 3000x2000 -o large.tif
for delay in 0.1 0.3 0.6 1 1.5; do
    real() {
        rm -f raw.*
        timeout --preserve-status --foreground -s INT "$delay" "$tool" large.tif --srisp-unprocess "$reference" -o raw.exr
        [ $? -eq 130 ] || [ -s raw.exr ] || return 1
        [ -z "$(find . -name '*.temp.*')" ] || { ls; return 1; }
        nothing_left
    }
    check "SIGINT after $delay s leaves nothing unfinished" real
done
cat >crashing_oiiotool <<'CRASH'
#!/bin/sh
kill -SEGV $$
CRASH
chmod +x crashing_oiiotool
crashing() { SRISP_OIIOTOOL=$scratch/crashing_oiiotool exits 139 "$tool" "$photo" --srisp-process; }
check "a crash of oiiotool comes through as 128 + its signal" crashing
failing() { SRISP_OIIOTOOL=/bin/false exits 1 "$tool" "$photo" --srisp-process; }
check "an exit code of oiiotool comes through" failing
check "nothing is left" nothing_left
finish
