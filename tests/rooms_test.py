#!/usr/bin/env python3
"""Draws the arrows between the rooms from the includes of all sources, and fails on one that no room has declared.

    rooms_test.py SOURCE ROOMS            checks; ROOMS is the list that CMake writes: "room: used room ..." from the ground up
    rooms_test.py SOURCE ROOMS --planted  checks that an upward include, were it there, would be found
    rooms_test.py SOURCE ROOMS --draw     prints every arrow with the number of includes, to look at
"""
import collections
import pathlib
import re
import sys

# Libraries of others, and the rooms that may see them.
THIRD_PARTY = {
    "CLI/": {"tools"},
    "opencv2/": {"output"},
    "vulkan/vulkan": {"vulkan"},
    "Eigen/": {"cpu_ref"},
    "toml++/": {"reprocess"},
    "mpi.h": {"reprocess"},
    "nlohmann/": {"output", "reprocess", "tools"},
    "openssl/": {"digest"},
    "hdf5": {"io/hdf5", "output", "bench"},
    "H5": {"io/hdf5", "output", "bench"},
}
# Devices know nothing of events, and what defines results knows nothing of devices.
NEVER = {
    "vulkan": {"scarf/core/event.h", "scarf/core/representation.h", "scarf/device/stream.h"},
    "kernels": {"scarf/device/stream.h"},
}
INCLUDE = re.compile(r'^\s*#\s*include\s+(["<])([^">]+)[">]', re.M)


def read_rooms(path):
    """Rooms in their order, with those that each may see: itself, what it names, and what these may see."""
    seen = {}
    for line in path.read_text().splitlines():
        room, uses = line.split(":")
        seen[room] = {room}.union(*(seen[use] for use in uses.split()))
    return seen


def room_of(file, rooms):
    """The room of a path relative to the project; public headers are api/<component>."""
    parts = file.split("/")
    if file == "include/scarf/scarf.h":
        return None  # the umbrella
    if parts[:2] == ["include", "scarf"]:
        return f"api/{parts[2]}" if len(parts) > 3 else "api/core"
    folder = "/".join(parts[1:-1] if parts[0] == "src" else parts[:-1])
    while folder and folder not in rooms:
        folder = folder.rpartition("/")[0]
    return folder or None


def resolve(included, files):
    for base in ("include/", "src/", ""):
        if base + included in files:
            return base + included
    return None


def check(files, rooms):
    """Faults, and the number of includes of every arrow. `files`: paths and contents."""
    faults, arrows = [], collections.Counter()
    for file, content in sorted(files.items()):
        room = room_of(file, rooms)
        if room is None:
            continue
        for quote, included in INCLUDE.findall(content):
            if quote == "<":
                for prefix, allowed in THIRD_PARTY.items():
                    if included.startswith(prefix) and room not in allowed:
                        faults.append(f"{file} includes <{included}>, which is for {', '.join(sorted(allowed))}")
                continue
            target = resolve(included, files)
            if target is None:
                continue  # generated, or beside the file
            if included in NEVER.get(room, ()):
                faults.append(f"{file} includes {included}, which {room} must not know")
            to = room_of(target, rooms)
            if to == room:
                continue
            arrows[room, to] += 1
            if to not in rooms.get(room, ()):
                faults.append(f"{file} includes {included}: {room} does not use {to}")
    return faults, arrows


def main():
    source, rooms = pathlib.Path(sys.argv[1]), read_rooms(pathlib.Path(sys.argv[2]))
    files = {}
    for folder in ("include", "src", "cpu_ref", "shaders", "tools", "bench"):
        for path in (source / folder).rglob("*"):
            if path.suffix in (".h", ".cpp"):
                files[path.relative_to(source).as_posix()] = path.read_text()
    if len(files) < 400:
        sys.exit(f"only {len(files)} sources were found")

    if "--planted" in sys.argv:
        for file, line in (("src/core/text.h", '#include "device/stream.h"\n'),
                           ("src/io/base/format.h", '#include "io/open/open.h"\n'),
                           ("cpu_ref/surface.h", '#include "kernels/pipeline.h"\n'),
                           ("src/device/make.cpp", '#include "cpu_ref/surface.h"\n'),
                           ("src/session/play.h", "#include <CLI/CLI.hpp>\n"),
                           ("src/vulkan/device.h", '#include "scarf/core/event.h"\n')):
            planted = dict(files, **{file: line + files[file]})
            if len(check(planted, rooms)[0]) <= len(check(files, rooms)[0]):
                sys.exit(f"{line.strip()} in {file} was not found")
        return
    faults, arrows = check(files, rooms)
    if "--draw" in sys.argv:
        for (room, to), count in sorted(arrows.items()):
            print(f"{room} -> {to}: {count}")
    for fault in faults:
        print(fault, file=sys.stderr)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
