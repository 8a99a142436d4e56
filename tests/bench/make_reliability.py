#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes docs/reliability.md: runs every trial that build has no result of, and writes what its last line says.

    /usr/bin/python3 tests/bench/make_reliability.py --build build [--again TRIAL...]

Some hours. Results are kept in BUILD/reliability, so a run that is stopped goes on there. The hours of the fuzzers are those
that tests/fuzz/run.sh has counted in build-fuzz so far."""
import argparse
import datetime
import json
import os
import shlex
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
PAGE = ROOT + "/docs/reliability.md"


class Trial:
    """A command whose last line says what was tried and what came of it."""

    def __init__(self, name, tried, command):
        self.name, self.tried, self.command = name, tried, command


TRIALS = []  # filled below


def run(trial, build, folder):
    """The result of a trial: kept, or made now."""
    path = f"{folder}/{trial.name}.json"
    if os.path.exists(path):
        with open(path) as file:
            return json.load(file)
    command = trial.command.replace("build/", shlex.quote(build) + "/")
    print(f"make_reliability: {trial.name}: {command}", file=sys.stderr, flush=True)
    begin = time.monotonic()
    ended = subprocess.run(["sh", "-c", command], cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                           stdin=subprocess.DEVNULL)
    lines = [line for line in ended.stdout.splitlines() if line.strip()]
    if ended.returncode or not lines:
        sys.stderr.write(ended.stdout[-4000:])
        sys.exit(f"make_reliability: '{command}' ended with {ended.returncode}; what was made before is kept")
    result = {"line": lines[-1].strip(), "seconds": round(time.monotonic() - begin),
              "date": datetime.date.today().isoformat(), "command": trial.command}
    with open(path + ".part", "w") as file:
        json.dump(result, file)
    os.replace(path + ".part", path)
    return result
