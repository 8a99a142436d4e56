#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""limits_test.py SOURCE: every test that docs/limits.md names exists."""
import re
import sys
from pathlib import Path


def fault(source, row):
    """What is wrong with a row of a table; empty: nothing."""
    cells = [cell.strip() for cell in row.strip().strip("|").split("|")]
    named = re.fullmatch(r"`([^`]+)`: (.+)", cells[-1])
    if not named:
        return "names no test"
    path = source / "tests" / named.group(1)
    if not path.is_file():
        return f"names {named.group(1)}, which does not exist"
    text = re.sub(r'"\s*\n\s*"', "", path.read_text())  # strings go on in the next line
    return "" if named.group(2) in text else f"names a test that {named.group(1)} does not have"


def rows_of(page):
    lines = [line for line in page.splitlines() if line.startswith("|")]
    return [line for i, line in enumerate(lines) if not line.startswith("|---") and
            (i + 1 == len(lines) or not lines[i + 1].startswith("|---"))]


def main(source):
    rows = rows_of((source / "docs/limits.md").read_text())
    faults = [(row, fault(source, row)) for row in rows]
    for row, what in faults:
        if what:
            print(f"FAILED: docs/limits.md {what}: {row}")
    wrong = "| a | b | c | `repository/limits_test.py`: no such " + "test |"
    checks = [len(rows) > 40, fault(source, wrong), fault(source, "| a | `no.cpp`: x |"), fault(source, "| a | b |")]
    failed = sum(bool(what) for _, what in faults) + sum(not good for good in checks)
    print(f"{len(rows)} rows, {failed} failed")
    return failed > 0


sys.exit(main(Path(sys.argv[1])))
