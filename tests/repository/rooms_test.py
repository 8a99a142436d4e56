#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Holds every #include to the table of rooms in docs/architecture.md; no file includes itself in the end.

rooms_test.py SOURCE: first the checker is tried on small trees with one wrong arrow each, then on the sources.
"""
import os
import re
import sys
import tempfile

INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]', re.M)
CODE = (".h", ".cpp", ".cu", ".inc")
DOORS = ("plugin", "ocio", "python")  # besides these, each folder of tools/


class Row:
    """A line of the table."""

    def __init__(self, name, headers, others):
        self.name, self.headers, self.others = name, headers, others


def read_table(text):
    """The rows under the heading that begins with `| Room |`, lowest room first."""
    lines = iter(text.splitlines())
    heading = next((line for line in lines if re.match(r"\|\s*Room\s*\|", line)), None)
    rows = []
    for line in lines if heading else ():
        if not line.startswith("|"):
            break
        cells = [re.findall(r"`([^`]+)`", cell) for cell in line.strip("|").split("|")]
        if cells[0]:
            rows.append(Row(cells[0][0], cells[2], cells[3]))
    return rows


class Sources:
    """All files of a tree, and what each includes."""

    def __init__(self, root):
        self.root = root
        self.files = set()
        for top in ("lib", "plugin", "ocio", "tools"):
            for folder, folders, names in os.walk(os.path.join(root, top)):
                folder = os.path.relpath(folder, root)
                self.files.update(f"{folder}/{name}" for name in names if name.endswith(CODE))
        self.names = {os.path.basename(file) for file in self.files}

    def text(self, file):
        path = os.path.join(self.root, file)
        return open(path, encoding="utf-8").read() if os.path.exists(path) else ""

    def find(self, file, quote, name):
        """The file that `file` includes as `name`; nothing if that is none of ours."""
        places = [os.path.dirname(file)] if quote == '"' else []
        for folder in places + ["lib", "lib/include", "ocio/include", ""]:
            path = os.path.normpath(os.path.join(folder, name))
            if path in self.files:
                return path
        return None


def part_of(file, room_of_header):
    """The room, or the thing outside lib, that a file belongs to."""
    words = file.split("/")
    if "/include/srisp/" in file:
        return room_of_header.get(words[-1])
    if words[0] == "tools":
        return f"tools/{words[1]}" if words[1] == "common" else words[1]
    if words[0] != "lib":
        return words[0]
    return "/".join(words[1:-1])


def is_door(part):
    return top(part) in DOORS


def is_public(file):
    return "/include/srisp/" in file


def top(part):
    return part.split("/")[0]


def table_problems(sources, rows):
    """Rooms and public headers that the table lacks, or has too many."""
    rooms = {part_of(file, {}) for file in sources.files if file.startswith("lib/") and not is_public(file)}
    rooms -= set(DOORS)
    rooms.update(door for door in DOORS if any(door in row.name.split("/") for row in rows))
    named = [row.name for row in rows]
    for room in sorted(rooms - set(named)):
        yield f"the table lacks the room '{room}'"
    for room in sorted(set(named) - rooms):
        yield f"the table's room '{room}' does not exist"
    headers = {os.path.basename(file) for file in sources.files if is_public(file)}
    listed = [header for row in rows for header in row.headers]
    for header in sorted(headers - set(listed)):
        yield f"the table lacks the public header '{header}'"
    for header in sorted(set(listed) - headers):
        yield f"the table's public header '{header}' does not exist"
    for name in sorted({name for name in named + listed if (named + listed).count(name) > 1}):
        yield f"the table has '{name}' twice"


def cmake_problems(sources, rows):
    """The lists of rooms in the build files."""
    made = set(re.findall(r"^srisp_room\((\w+)", sources.text("lib/CMakeLists.txt"), re.M))
    for row in rows:
        if made and row.name not in made and top(row.name) != "train" and row.name not in DOORS:
            yield f"lib/CMakeLists.txt does not make the room '{row.name}'"
    line = re.search(r"^# Rooms, lowest first: (.*)$", sources.text("lib/train/CMakeLists.txt"), re.M)
    table = [row.name.split("/")[1] for row in rows if row.name.startswith("train/")]
    if line and re.findall(r"\w+", line[1]) != table:
        yield "lib/train/CMakeLists.txt and the table have the trainer's rooms in another order"
    tools = re.findall(r"^srisp_image_tool\((\w+) ([^)]*)\)", sources.text("tools/image_tools.cmake"), re.M)
    for tool, libraries in tools:
        linked = {library[len("srisp_") :].replace("ocio_static", "ocio") for library in libraries.split()}
        allowed = {row.name for row in rows if tool in row.others}
        for room in sorted(linked ^ allowed):
            yield f"tools/image_tools.cmake and the table disagree whether '{tool}' has '{room}'"


def arrow_problems(sources, rows, graph):
    """Includes that the table does not allow, and allowances that nothing needs."""
    order = {row.name: index for index, row in enumerate(rows)}
    others = {row.name: set(row.others) for row in rows}
    room_of_header = {header: row.name for row in rows for header in row.headers}
    beside = {top(name) for name in order} & {name for names in others.values() for name in names}
    used = set()
    for file, included in sorted(graph.items()):
        part = part_of(file, room_of_header)
        for other in included:
            room = part_of(other, room_of_header)
            if part is None or room is None or room == part:
                continue
            outside = not file.startswith("lib/") or is_door(part)
            if room not in order:
                if room != "tools/common" or not file.startswith("tools/"):
                    yield f"{file} includes {other}, which is no room"
                continue
            if outside and is_public(other):
                continue
            if outside or top(part) in beside:
                used.add((room, top(part)))
            if order.get(part, len(order)) < order[room]:
                yield f"{file} includes {other}: '{room}' is a later room than '{part}'"
            elif top(part) != top(room) and (outside or top(part) in beside) and top(part) not in others[room]:
                yield f"{file} includes {other}: the table does not allow '{room}' to '{top(part)}'"
    for row in rows:
        for name in row.others:
            if (row.name, name) not in used:
                yield f"the table allows '{row.name}' to '{name}', which does not include it"


def cycle_problems(graph):
    """The first cycle that each file is found to be in."""
    done = set()

    def visit(file, way):
        if file in way:
            yield "files include each other: " + " → ".join(way[way.index(file) :] + [file])
        elif file not in done:
            for other in sorted(graph.get(file, ())):
                yield from visit(other, way + [file])
            done.add(file)

    for file in sorted(graph):
        yield from visit(file, [])


def problems(root):
    sources = Sources(root)
    rows = read_table(sources.text("docs/architecture.md"))
    if not rows:
        return ["docs/architecture.md has no table that begins with '| Room |'"]
    found, graph = [], {}
    for file in sorted(sources.files):
        graph[file] = set()
        for quote, name in INCLUDE.findall(sources.text(file)):
            other = sources.find(file, quote, name)
            if other:
                graph[file].add(other)
            elif quote == '"' and name in sources.names:
                found.append(f"{file} includes '{name}' of another folder by its bare name")
    for more in (
        table_problems(sources, rows),
        cmake_problems(sources, rows),
        arrow_problems(sources, rows, graph),
        cycle_problems(graph),
    ):
        found.extend(more)
    return found


# A small tree in order. Each case changes some of its files, and says what the checker must find.
GOOD = {
    "docs/architecture.md": """
| Room | Holds | Public headers | Others |
|---|---|---|---|
| `base` | files | `expected.h` | `train`, `tool` |
| `photo` | photos | `photo.h` | |
| `train/tensors` | numbers | | |
| `train/network` | layers | | |
""",
    "lib/CMakeLists.txt": "srisp_room(base)\nsrisp_room(photo LINK srisp_base)\n",
    "lib/train/CMakeLists.txt": "# Rooms, lowest first: tensors, network.\n",
    "tools/image_tools.cmake": "srisp_image_tool(tool srisp_base)\n",
    "lib/include/srisp/expected.h": "#include <string>\n",
    "lib/include/srisp/photo.h": "#include <srisp/expected.h>\n",
    "lib/base/files.h": "#include <srisp/expected.h>\n",
    "lib/base/more.h": '#include "base/files.h"\n',
    "lib/photo/photo.cpp": '#include <srisp/photo.h>\n#include "base/files.h"\n',
    "lib/photo/colour.h": "",
    "lib/train/tensors/colour.h": '#include "base/files.h"\n',
    "lib/train/network/layers.h": '#include "train/tensors/colour.h"\n',
    "plugin/input.cpp": '#include "input.h"\n#include <srisp/photo.h>\n',
    "plugin/input.h": "",
    "lib/python/module.cpp": '#include "arrays.h"\n#include <srisp/photo.h>\n',
    "lib/python/arrays.h": "",
    "tools/common/failure.h": "",
    "tools/tool/main.cpp": '#include "../common/failure.h"\n#include "base/files.h"\n#include <srisp/photo.h>\n',
    "tools/tool/help.h": "",
}
TABLE = GOOD["docs/architecture.md"]
CASES = [
    ("a tree in order has no problems", {}, None),
    ("a room may not include a later one", {"lib/base/more.h": '#include "photo/colour.h"\n'}, "later room"),
    ("nor a later room's public header", {"lib/base/more.h": "#include <srisp/photo.h>\n"}, "later room"),
    (
        "nor may a public header include a later room's",
        {"lib/include/srisp/expected.h": "#include <srisp/photo.h>\n", "lib/include/srisp/photo.h": ""},
        "later room",
    ),
    (
        "the trainer's rooms keep their order",
        {"lib/train/tensors/more.h": '#include "train/network/layers.h"\n'},
        "later",
    ),
    (
        "the trainer includes only the rooms that the table allows it",
        {"lib/train/tensors/more.h": '#include "photo/colour.h"\n'},
        "does not allow 'photo' to 'train'",
    ),
    (
        "and public headers of these only",
        {"lib/train/tensors/more.h": "#include <srisp/photo.h>\n"},
        "does not allow 'photo' to 'train'",
    ),
    (
        "the plugin includes no room that the table does not allow",
        {"plugin/input.cpp": '#include "base/files.h"\n'},
        "does not allow 'base' to 'plugin'",
    ),
    (
        "nor does the Python module, though it lies in lib",
        {"lib/python/arrays.h": '#include "photo/colour.h"\n'},
        "does not allow 'photo' to 'python'",
    ),
    (
        "a tool includes no room that the table does not allow",
        {"tools/tool/help.h": '#include "photo/colour.h"\n'},
        "does not allow 'photo' to 'tool'",
    ),
    (
        "a tool does not include another one",
        {"tools/other/main.cpp": '#include "../tool/help.h"\n'},
        "no room",
    ),
    ("a room does not include the plugin", {"lib/photo/colour.h": '#include "plugin/input.h"\n'}, "no room"),
    (
        "the table allows only what is needed",
        {"docs/architecture.md": TABLE.replace("`tool`", "`tool`, `plugin`")},
        "which does not include it",
    ),
    ("a bare name stays in its folder", {"lib/photo/colour.h": '#include "more.h"\n'}, "by its bare name"),
    (
        "two files do not include each other",
        {"lib/base/files.h": '#include "more.h"\n'},
        "include each other",
    ),
    (
        "nor do three",
        {"lib/base/files.h": '#include "base/c.h"\n', "lib/base/c.h": '#include "base/more.h"\n'},
        "lib/base/c.h → lib/base/more.h → lib/base/files.h → lib/base/c.h",
    ),
    ("a room that the table lacks is found", {"lib/attic/old.h": ""}, "lacks the room 'attic'"),
    (
        "a room of the table that does not exist is found",
        {"lib/photo/photo.cpp": None, "lib/photo/colour.h": None},
        "'photo' does not exist",
    ),
    (
        "a public header that the table lacks is found",
        {"lib/include/srisp/image.h": ""},
        "lacks the public header 'image.h'",
    ),
    (
        "a public header that does not exist is found",
        {"docs/architecture.md": TABLE.replace("`photo.h`", "`photo.h`, `old.h`")},
        "'old.h' does not exist",
    ),
    (
        "a public header has one room",
        {"docs/architecture.md": TABLE.replace("`photo.h`", "`photo.h`, `expected.h`")},
        "'expected.h' twice",
    ),
    (
        "the build has each room",
        {"lib/CMakeLists.txt": "srisp_room(base)\n"},
        "does not make the room 'photo'",
    ),
    (
        "the build has the trainer's rooms in the table's order",
        {"lib/train/CMakeLists.txt": "# Rooms, lowest first: network, tensors.\n"},
        "another order",
    ),
    (
        "a tool links the rooms that the table allows it",
        {"tools/image_tools.cmake": "srisp_image_tool(tool srisp_base srisp_photo)\n"},
        "disagree whether 'tool' has 'photo'",
    ),
    ("a page without the table is found", {"docs/architecture.md": "# Rooms\n"}, "no table"),
]


def found_in_made_tree(changes):
    with tempfile.TemporaryDirectory() as root:
        for file, text in {**GOOD, **changes}.items():
            if text is not None:
                os.makedirs(os.path.join(root, os.path.dirname(file)), exist_ok=True)
                with open(os.path.join(root, file), "w", encoding="utf-8") as out:
                    out.write(text)
        return problems(root)


def main():
    results = []
    for sentence, changes, expected in CASES:
        found = found_in_made_tree(changes)
        right = any(expected in problem for problem in found) if expected else not found
        results.append((sentence, [] if right else found or [f"nothing found; expected: {expected}"]))
    results.append(("the sources keep to docs/architecture.md", problems(sys.argv[1])))
    for sentence, found in results:
        if found:
            print("FAILED: " + sentence, *found, sep="\n    ")
    failed = sum(1 for _, found in results if found)
    print(f"{len(results) - failed} passed, {failed} failed")
    return 1 if failed else 0


sys.exit(main())
