#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that every #include respects the module table of docs/architecture.md.

Exit 0 when all do; otherwise prints `file:line: what` for each that does not, and exits 1.
"""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# module: (modules it may include besides itself, prefixes of third-party headers it may include).
BASE = {"core", "geometry", "semantics"}
VIEW = BASE | {"view"}
SERVICE = VIEW | {"io", "map", "raycast", "cache", "similarity", "service"}
MODULES = {
    "core": (set(), ["fmt/", "spdlog/", "xxhash.h", "tl/"]),
    "geometry": ({"core"}, ["Eigen/", "fmt/"]),
    "semantics": ({"core"}, ["fmt/"]),
    "view": (BASE, ["zstd.h", "fmt/"]),
    "io": (VIEW, ["png.h", "yaml-cpp/", "fmt/"]),
    "picture": (VIEW | {"io"}, ["cairo", "fmt/"]),
    "map": (BASE | {"io", "picture"}, ["yaml-cpp/", "tiny_gltf.h", "nlohmann/", "Eigen/", "fmt/"]),
    "localization": ({"core", "geometry"}, ["fmt/"]),
    "raycast": (VIEW | {"map"}, ["embree3/", "embree4/", "Eigen/", "fmt/"]),
    "similarity": (VIEW, ["fmt/"]),
    "cache": (VIEW, ["lmdb.h", "fmt/"]),
    "observation": (VIEW | {"localization"}, ["fmt/"]),
    "service": (VIEW | {"io", "map", "raycast", "cache", "similarity"}, ["fmt/", "Eigen/"]),
    "protocol": (VIEW | {"similarity"}, ["google/protobuf/", "fmt/"]),
    "simulation": (VIEW | {"io", "map", "raycast", "localization"}, ["fmt/"]),
    "evaluation": (SERVICE | {"localization", "observation", "simulation", "picture"}, ["fmt/"]),
}
# Folders outside src/semview, in the same form; "client/lib" is included as "client/lib/…".
PROGRAMS = {
    "server": (SERVICE | {"protocol"}, ["zmq", "CLI/", "yaml-cpp/", "fmt/"]),
    "client/lib": (VIEW | {"similarity", "protocol"}, ["zmq", "fmt/"]),
    "client/robot": (VIEW | {"io", "localization", "observation"}, ["fmt/"]),
}
THIRD_PARTY = re.compile(
    r"^(fmt/|spdlog/|xxhash\.h|tl/|Eigen/|zstd\.h|png\.h|yaml-cpp/|cairo|tiny_gltf\.h|nlohmann/"
    r"|embree\d/|lmdb\.h|google/protobuf/|zmq|CLI/|opencv2/|openvdb/|hwy/)")
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]')


def problems_of(path, own, modules, prefixes):
    for number, line in enumerate(path.read_text().splitlines(), start=1):
        match = INCLUDE.match(line)
        if not match:
            continue
        header = match.group(1)
        where = f"{path.relative_to(ROOT)}:{number}"
        if header.startswith("semview/"):
            module = header.split("/")[1]
            if module != own and module not in modules and module != "v1":
                yield f"{where}: {own} may not include {header}"
        elif header.startswith("client/"):
            folder = "/".join(header.split("/")[:2])
            if folder != own:
                yield f"{where}: {own} may not include {header}"
        elif THIRD_PARTY.match(header) and not any(header.startswith(p) for p in prefixes):
            yield f"{where}: {own} may not include third-party {header}"


def main():
    problems = []
    seen = set()
    for folder in sorted((ROOT / "src/semview").iterdir()):
        if not folder.is_dir():
            continue
        seen.add(folder.name)
        if folder.name not in MODULES:
            problems.append(f"{folder.relative_to(ROOT)}: a module that tools/check_layers.py does not know")
            continue
        for path in sorted([*folder.glob("**/*.hpp"), *folder.glob("**/*.cpp")]):
            problems += problems_of(path, folder.name, *MODULES[folder.name])
    for name, (modules, prefixes) in PROGRAMS.items():
        for path in sorted([*(ROOT / name).glob("*.hpp"), *(ROOT / name).glob("*.cpp")]):
            problems += problems_of(path, name, modules, prefixes)
    print("\n".join(problems) if problems else f"layers: {len(seen)} modules, every include allowed")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
