# SPDX-License-Identifier: Apache-2.0
"""All tools that write, while the machine fails them:

    faults_test.py BUILD SOURCE [SWEEP…] [--all] [--tool NAME…] [--jobs N]

  writes       each call that changes a file fails: full disk, broken disk, interrupted, only a part written
  kills        killed at each of these calls: the tool alone, or all that it started, too
  folders      the folder is deleted, or becomes read-only, at each of these calls
  memory       each request for much memory fails
  limits       ulimit -n and ulimit -v in steps
  clocks       the clock goes backwards all the time

A tool gives its result to the bit, or exit code 1 and one message that says where; nothing hangs, crashes, or leaves
half a file, or one without a name; what was there stays; the same command then gives the same bits.

Without --all a spread of a few. The last line counts what was tried.
"""
import argparse
import concurrent.futures
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from writing_tools import Workplace, broken_files, left_behind, messages, snapshot, tools_of

SPREAD = {"writes": 2, "kills": 2}  # faults of a sweep for each tool without --all; else 1
SHORT = ("unprocess_exr", "sensor_dng", "parameters", "bake_fragment", "batch_exr", "eval", "pack", "python_exr", "dng_plugin")
LONG_ROW, OF_ROW = 40, 10  # of so many equal calls in a row, with --all, every so manieth
LARGE_PIECE = 1 << 16  # bytes; libraries that get no small piece of memory end the process by themselves
DESCRIPTORS = (4, 6, 8, 10, 12, 16, 20, 32, 64)
VIRTUAL_MB = (30, 60, 100, 200, 300, 400, 500, 600, 700, 800, 1000, 1200, 1500, 2000, 3000, 4000)
LOADER = "error while loading shared libraries|cannot allocate memory in static TLS|Cannot fork|fork: retry|fork: Cannot"


def spread(items, count):
    """Some of them, the middle of each part."""
    items = list(items)
    if len(items) <= count:
        return items
    return [items[int((part + 0.5) * len(items) / count)] for part in range(count)]


def ends_of_rows(calls):
    """Of each row of the same call on the same file the first, the second and the last."""
    same = [call[1:] for call in calls]
    return [call for place, call in enumerate(calls)
            if place < 2 or same[place] != same[place - 2] or place + 1 == len(calls) or same[place] != same[place + 1]]


def thinned(calls):
    """Without most of long rows of the same call on the same file."""
    kept, row, last = [], 0, None
    for at, name, path in calls:
        row = row + 1 if (name, path) == last else 0
        last = (name, path)
        if row < LONG_ROW or row % OF_ROW == 0:
            kept.append((at, name, path))
    return kept


class Sweeper:
    def __init__(self, workplace, everything):
        self.workplace, self.everything = workplace, everything
        self.tracer = workplace.build / "tests" / "fault_tracer"
        self.preload = {"LD_PRELOAD": str(workplace.build / "tests" / "libpreloaded_faults.so")}

    def chosen(self, sweep, items):
        return list(items) if self.everything else spread(items, SPREAD.get(sweep, 1))

    def traced(self, tool, place, at=0, action="EIO"):
        """Runs it; also the calls, as (number, name, path)."""
        log = place.with_suffix(".calls")
        code, said = self.workplace.run(tool, place, [str(self.tracer), f"{place}/", str(log), str(at), action])
        lines = (line.split(" ", 2) for line in log.read_text(errors="replace").splitlines())
        return code, said, [(int(number), name, path) for number, name, path in lines]

    def good(self, tool):
        """What it gives, and its calls; what was there before."""
        place = self.workplace.begin(tool)
        before = snapshot(place, tool)
        code, said, calls = self.traced(tool, place)
        if code != 0 or left_behind(place):
            raise RuntimeError(f"{tool.name}: exit code {code}, {said}, {left_behind(place)}")
        return snapshot(place, tool), calls, before

    def outcome(self, tool, place, code, said, path="", leftovers=True):
        """What is wrong with what a run that met a fault did; "": nothing."""
        wrong = []
        told = messages(said)
        names = [*(Path(output).stem for output in tool.outputs), "TMPDIR", "tmp/", Path(path).name]  # "": any
        if code == 0:
            if snapshot(place, tool) != self.expected[tool.name]:
                wrong.append("exit code 0, another result")
        elif code == -6 and "oiiotool" in tool.command and "std::bad_alloc" in said:
            pass  # the stock oiiotool ends so without memory, whatever plugins it has
        elif code != 1:
            wrong.append(f"exit code {code}")
        elif not told or len(told) > 1 and not tool.name.startswith(("batch", "eval", "pack")):  # one for each photo
            wrong.append(f"{len(told)} messages")
        elif not any(name in told[0] for name in names):
            wrong.append("the message names no file")
        if broken := broken_files(place, tool, self.expected[tool.name], self.before[tool.name]):
            wrong.append(f"broken: {broken}")
        if leftovers and (left := left_behind(place)):
            wrong.append(f"left: {left}")
        return "; ".join(wrong)

    def again(self, tool, place):
        """What is wrong with the same command, run again; not where all is as if it had not run, or as after a good run."""
        if snapshot(place, tool) in (self.before[tool.name], self.expected[tool.name]) and not left_behind(place):
            return ""
        code, said = self.workplace.run(tool, place)
        if code != 0:
            return f"again: exit code {code}: {said}"
        if snapshot(place, tool) != self.expected[tool.name]:
            return "again: another result"
        return f"again: left {left_behind(place)}" if left_behind(place) else ""

    def sweep(self, tool, sweeps):
        """{sweep: (tried, ended with a message, [what was wrong])}"""
        self.expected[tool.name], calls, self.before[tool.name] = self.good(tool)
        return {sweep: getattr(self, sweep)(tool, thinned(calls)) for sweep in sweeps}

    expected, before = {}, {}

    def meet(self, tool, faults, run, leftovers=True, again=True):
        told, wrong = 0, []
        for fault in faults:
            place = self.workplace.begin(tool)
            code, said, path = run(place, fault)
            told += code != 0
            problems = [self.outcome(tool, place, code, said, path, leftovers)] if code != "killed" else [
                f"broken: {broken}" for broken in broken_files(place, tool, self.expected[tool.name], self.before[tool.name])]
            if again:
                problems.append(self.again(tool, place))
            if any(problems):
                wrong.append(f"{tool.name}: {fault}: {'; '.join(filter(None, problems))}\n        {said.strip()[:600]}")
        return len(faults), told, wrong

    def hit(self, tool, place, fault):
        """A traced run; the path of the call that met the fault."""
        code, said, calls = self.traced(tool, place, fault[0], fault[1])
        return code, said, next((path for at, _, path in calls if at == fault[0]), "")

    def writes(self, tool, calls):
        actions = {"open": ("ENOSPC", "EINTR"), "link": ("ENOSPC", "EIO"), "sendfile": ("ENOSPC", "EIO", "short"), "unlink": ()}
        for name in ("write", "pwrite", "writev", "pwritev"):
            actions[name] = ("ENOSPC", "EIO", "EINTR", "short")
        for name in ("mkdir", "symlink", "ftruncate", "truncate", "fallocate"):
            actions[name] = ("ENOSPC",)
        for name in ("fsync", "close", "rename", "chmod"):
            actions[name] = ("EIO",)
        ends = ends_of_rows(calls)  # what goes on after a part does so everywhere
        faults = [(at, action, name, path) for at, name, path in calls for action in actions[name]
                  if action not in ("EINTR", "short") or (at, name, path) in ends]
        return self.meet(tool, self.chosen("writes", faults), lambda place, fault: self.hit(tool, place, fault))

    def kills(self, tool, calls):
        started = tool.command[0].endswith(("srisptool", "srispbatch"))
        actions = ("killall", "kill") if started else ("killall",)
        faults = [(at, action, name, path) for at, name, path in calls for action in actions]

        def run(place, fault):
            code, said, path = self.hit(tool, place, fault)
            return ("killed" if code == 137 else code), said, path
        return self.meet(tool, self.chosen("kills", faults), run, leftovers=False,
                         again=tool.command[0] != "oiiotool")  # the stock one leaves x.01234567.temp.dng for good

    def folders(self, tool, calls):
        faults = [(at, action, name, path) for at, name, path in calls for action in ("run rm -rf out", "EROFS")]

        def run(place, fault):
            action = fault[1].replace("rm -rf out", f"rm -rf {place}/out")
            code, said, path = self.hit(tool, place, (fault[0], action))
            (place / "out").mkdir(exist_ok=True)
            # What was deleted when it was complete is nobody's fault.
            return ("killed" if code == 0 and action != "EROFS" else code), said, path
        return self.meet(tool, self.chosen("folders", faults), run, leftovers=False, again=False)

    def memory(self, tool, _):
        count = self.workplace.root / f"{tool.name}.count"

        def run(place, fault):
            count.unlink(missing_ok=True)
            code, said = self.workplace.run(tool, place, environment={
                **self.preload, "FAULTS_COUNT": str(count), "FAULTS_MEMORY": f"{LARGE_PIECE} {fault}"})
            return code, said, ""
        run(self.workplace.begin(tool), 0)
        requests = int.from_bytes(count.read_bytes(), "little")
        return self.meet(tool, self.chosen("memory", range(1, requests + 1)), run, again=self.everything)

    def limits(self, tool, _):
        # NumPy's OpenBLAS asks for ever for memory that it cannot get.
        least = 1000 if tool.name.startswith("python") else 0
        faults = [("n", count) for count in DESCRIPTORS] + [("v", size * 1024) for size in VIRTUAL_MB if size >= least]

        def run(place, fault):
            kind, limit = fault
            code, said = self.workplace.run(tool, place, ["sh", "-c", f'ulimit -{kind} {limit}; exec "$@"', "sh"])
            return (1 if code == 127 and re.search(LOADER, said) else code), said, ""
        return self.meet(tool, self.chosen("limits", faults), run, again=False)

    def clocks(self, tool, _):
        def run(place, _):
            code, said = self.workplace.run(tool, place, environment={**self.preload, "FAULTS_CLOCK": "1"})
            return (code, said, "") if code == 0 else (f"{code}, though nothing failed", said, "")
        return self.meet(tool, ["backwards"], run)


WORDS = {"writes": "writes failed", "kills": "kills", "folders": "folders deleted or read-only",
         "memory": "requests for memory failed", "limits": "limits of descriptors and memory", "clocks": "clocks backwards"}


def reason_to_skip(build):
    tracer = Path(build) / "tests" / "fault_tracer"
    if not tracer.exists():
        return "fault_tracer is for Linux on x86-64"
    if subprocess.run([tracer, "/", "/dev/null", "0", "EIO", "true"], stderr=subprocess.DEVNULL).returncode != 0:
        return "ptrace or seccomp is not permitted here"
    if b"libasan" in subprocess.run(["ldd", Path(build) / "bin" / "srisptool"], stdout=subprocess.PIPE).stdout:
        return "the address sanitizer takes no preloaded library"
    return ""


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build")
    parser.add_argument("source")
    parser.add_argument("sweeps", nargs="*", metavar="SWEEP", help=", ".join(WORDS))
    parser.add_argument("--all", action="store_true", help="each fault at all tools; without it a spread")
    parser.add_argument("--tool", nargs="*", help="of these alone")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    options.build, options.source = os.path.abspath(options.build), os.path.abspath(options.source)
    if reason := reason_to_skip(options.build):
        print(f"SKIPPED cli_faults: {reason}")
        return 0
    sweeps = options.sweeps or list(WORDS)
    if unknown := set(sweeps) - set(WORDS):
        parser.error(f"no such sweep: {unknown}")
    wanted = options.tool or ([] if options.all else SHORT)
    tools = [tool for tool in tools_of(options.build) if not wanted or tool.name in wanted]
    with tempfile.TemporaryDirectory(prefix="faults-") as root:
        os.chmod(root, 0o755)
        sweeper = Sweeper(Workplace(root, options.build, options.source), options.all)
        tried, told, wrong = dict.fromkeys(sweeps, 0), dict.fromkeys(sweeps, 0), []
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            for results in pool.map(lambda tool: sweeper.sweep(tool, sweeps), tools):
                print(*(f"{sweep}: {count}" for sweep, (count, *_) in results.items()), sep=", ", flush=True)
                for sweep, (count, messages_told, problems) in results.items():
                    tried[sweep] += count
                    told[sweep] += messages_told
                    wrong += problems
                    for problem in problems:
                        print(f"FAILED: {sweep}: {problem}", flush=True)
    print(f"{sum(tried.values()) - len(wrong)} passed, {len(wrong)} failed")
    for sweep in sweeps:
        print(f"{WORDS[sweep]}: {tried[sweep]}, told: {told[sweep]}, tools: {len(tools)}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
