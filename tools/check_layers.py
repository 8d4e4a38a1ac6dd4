#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that includes and links respect the module table of docs/architecture.md.

check_layers.py [ROOT]    exit 0 when they do; otherwise `file:line: what` for each that does not, exit 1

For each module of the table: an #include names a header of itself, of a module that it may use, of a
library that it may use, or of the system; its CMakeLists.txt links the modules whose headers it
includes, no more and no fewer, and only libraries that it may use; and the table of
docs/architecture.md has the same modules and libraries, those used above those that use them.
"""
import re
import sys
from pathlib import Path
from typing import NamedTuple


class Module(NamedTuple):
    uses: set  # the modules whose headers it may include, besides its own
    libraries: set  # of LIBRARIES, besides those that everyone may use


class Library(NamedTuple):
    headers: tuple  # what its headers begin with
    targets: set  # as CMake knows it


LIBRARIES = {
    "fmt": Library(("fmt/",), {"fmt::fmt"}),
    "Eigen": Library(("Eigen/",), {"Eigen3::Eigen"}),
    "tl-expected": Library(("tl/",), {"tl::expected"}),
    "spdlog": Library(("spdlog/",), {"spdlog::spdlog"}),
    "xxHash": Library(("xxhash.h",), {"PkgConfig::xxhash"}),
    "zstd": Library(("zstd.h",), {"PkgConfig::zstd"}),
    "libpng": Library(("png.h",), {"PNG::PNG"}),
    "libjpeg": Library(("jpeglib.h",), {"JPEG::JPEG"}),
    "OpenCV": Library(("opencv2/",), {"OpenCV::core", "OpenCV::imgproc", "OpenCV::dnn"}),
    "yaml-cpp": Library(("yaml-cpp/",), {"yaml-cpp::yaml-cpp"}),
    "cairo": Library(("cairo/",), {"PkgConfig::cairo"}),
    "tinygltf": Library(("tiny_gltf.h",), set()),
    "nlohmann-json": Library(("nlohmann/",), {"nlohmann_json::nlohmann_json"}),
    "Embree": Library(("embree3/", "embree4/"), {"embree"}),
    "Highway": Library(("hwy/",), {"PkgConfig::hwy"}),
    "OpenVDB": Library(("openvdb/",), {"OpenVDB::openvdb"}),
    "LMDB": Library(("lmdb.h",), {"PkgConfig::lmdb"}),
    "protobuf": Library(("google/protobuf/",), {"protobuf::libprotobuf"}),
    "ZeroMQ": Library(("zmq.h",), {"cppzmq"}),
    "CLI11": Library(("CLI/",), {"CLI11::CLI11"}),
}
EVERYONES = {"fmt", "Eigen"}

BASE = {"core", "geometry", "semantics"}
VIEW = BASE | {"view"}
SERVICE = VIEW | {"io", "map", "raycast", "cache", "similarity", "field"}
# In the order of docs/architecture.md. A name with a slash, and those of PROGRAMS, are folders of the
# repository; the others are folders of src/semview.
MODULES = {
    "core": Module(set(), {"spdlog", "xxHash", "tl-expected"}),
    "geometry": Module({"core"}, set()),
    "semantics": Module({"core"}, set()),
    "view": Module(BASE, {"zstd"}),
    "io": Module(VIEW, {"libpng", "libjpeg", "yaml-cpp"}),
    "picture": Module(VIEW | {"io"}, {"cairo"}),
    "map": Module(BASE | {"io", "picture"}, {"tinygltf", "nlohmann-json"}),
    "localization": Module({"core", "geometry"}, set()),
    "raycast": Module(VIEW | {"map"}, {"Embree", "Highway"}),
    "similarity": Module(VIEW, {"Highway"}),
    "cache": Module(VIEW, {"LMDB"}),
    "segmentation": Module(VIEW | {"io"}, {"OpenCV"}),
    "field": Module(VIEW | {"map"}, {"OpenVDB", "Highway"}),
    "observation": Module(VIEW | {"localization"}, set()),
    "service": Module(SERVICE, set()),
    "protocol": Module(VIEW | {"similarity"}, {"protobuf"}),
    "simulation": Module(VIEW | {"io", "map", "raycast", "localization"}, set()),
    "places": Module(SERVICE | {"service", "observation"}, set()),
    "evaluation": Module(SERVICE | {"service", "localization", "observation", "simulation", "picture"},
                         set()),
    "benchmark": Module(SERVICE | {"service", "picture", "observation"}, {"zstd", "Highway"}),
    "server": Module(SERVICE | {"service", "observation", "protocol"}, {"ZeroMQ", "CLI11"}),
    "client/lib": Module(VIEW | {"similarity", "observation", "protocol"}, {"ZeroMQ"}),
    "client/load": Module(VIEW | {"similarity", "protocol", "client/lib"}, {"ZeroMQ"}),
    "client/robot": Module(VIEW | {"io", "localization", "observation"}, set()),
    "experiments/paper2017": Module(SERVICE | {"service", "localization", "observation", "evaluation",
                                               "picture", "client/robot"}, set()),
    "experiments/paper2023": Module(SERVICE | {"localization", "observation", "evaluation",
                                               "picture", "experiments/paper2017"}, set()),
    "cli": Module(SERVICE | {"service", "segmentation", "picture", "localization", "observation", "simulation",
                             "places", "evaluation", "benchmark", "server", "client/lib", "client/load",
                             "client/robot", "experiments/paper2017", "experiments/paper2023"},
                  {"CLI11", "nlohmann-json"}),
}
PROGRAMS = {"server", "cli"}
# CMake names of modules that are not `semview::` and the name.
TARGETS = {"client": "client/lib", "load": "client/load", "robot": "client/robot",
           "messages": "protocol", "paper2017": "experiments/paper2017",
           "paper2023": "experiments/paper2023"}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
SYSTEM = re.compile(r"^([a-z0-9_]+|sys/[a-z]+\.h|"
                    r"(arpa/inet|dlfcn|fcntl|ifaddrs|malloc|netinet/in|poll|unistd|xmmintrin)\.h)$")


def folder_of(root, module):
    return root / module if module in PROGRAMS or "/" in module else root / "src/semview" / module


def sources_of(folder):
    return sorted(path for kind in ("hpp", "cpp") for path in folder.glob(f"**/*.{kind}"))


def module_of_header(header, own):
    """The module of a header of ours; None for any other."""
    parts = header.split("/")
    if parts[0] == "semview":
        # The messages are the protocol's, and generated.
        return "protocol" if parts[1] == "v1" else parts[1]
    if parts[0] in {"client", "experiments"}:
        return "/".join(parts[:2])
    return parts[0] if parts[0] in PROGRAMS and len(parts) > 1 else None


def library_of_header(header):
    for name, library in LIBRARIES.items():
        if header.startswith(library.headers):
            return name
    return None


def allowed_libraries(module):
    return EVERYONES | MODULES[module].libraries


def problem_with_include(own, folder, bracket, header):
    """What is wrong with an include of `own`, if anything."""
    module = module_of_header(header, own)
    if module is not None:
        allowed = module == own or module in MODULES[own].uses
        return None if allowed else f"{own} may not include {header}"
    if bracket == '"':
        inside = "/" not in header and (folder / header).exists()
        return None if inside else f'"{header}" is no file of {own}; other modules by their full names'
    if SYSTEM.match(header):
        return None
    library = library_of_header(header)
    if library is None:
        return f"<{header}> is of no library that tools/check_layers.py knows"
    return None if library in allowed_libraries(own) else f"{own} may not include <{header}> of {library}"


def check_includes(root, own):
    """The problems, and the modules whose headers are included."""
    problems, included = [], set()
    folder = folder_of(root, own)
    for path in sources_of(folder):
        for number, line in enumerate(path.read_text().splitlines(), start=1):
            match = INCLUDE.match(line)
            if not match:
                continue
            problem = problem_with_include(own, folder, *match.groups())
            if problem:
                problems.append(f"{path.relative_to(root)}:{number}: {problem}")
            included.add(module_of_header(match.group(2), own))
    return problems, included - {None, own}


def links_of(text):
    """(line, name) of each library that a CMakeLists.txt links; `x` for both semview::x and semview_x."""
    text = re.sub(r"#.*", "", text)
    for call in re.finditer(r"(semview_module|target_link_libraries)\s*\(([^)]*)\)", text):
        in_modules, linking = False, call.group(1) != "semview_module"
        for index, token in enumerate(re.finditer(r"\S+", call.group(2))):
            word = re.sub(r"^\$<BUILD_INTERFACE:(.*)>$", r"\1", token.group())
            if word.isupper() and "_" in word or word in {"USES", "SOURCES", "HEADERS", "PUBLIC", "PRIVATE"}:
                in_modules = word == "USES"
                linking = in_modules or word in {"PUBLIC_LINKS", "PRIVATE_LINKS", "PUBLIC", "PRIVATE"}
            elif linking and index > 0:
                line = text.count("\n", 0, call.start(2) + token.start()) + 1
                yield line, f"semview::{word}" if in_modules else re.sub("^semview_", "semview::", word)


def check_links(root, own, included):
    file = folder_of(root, own) / "CMakeLists.txt"
    name = file.relative_to(root)
    if not file.exists():
        return [f"{name}: is missing"]
    problems, linked = [], set()
    known = {target: library for library, entry in LIBRARIES.items() for target in entry.targets}
    for line, target in links_of(file.read_text()):
        if target.startswith("semview::"):
            module = TARGETS.get(target[9:], target[9:])
            linked.add(module)
            if module not in {own, "options"} | included:
                problems.append(f"{name}:{line}: {own} links {module} and includes no header of it")
        elif target != "Threads::Threads" and known.get(target) not in allowed_libraries(own):
            problems.append(f"{name}:{line}: {own} may not link {target}")
    problems += [f"{name}: {own} includes headers of {module} and does not link it"
                 for module in sorted(included - linked)]
    return problems


def check_document(root):
    file = root / "docs/architecture.md"
    name = file.relative_to(root)
    rows = {}
    for number, line in enumerate(file.read_text().splitlines(), start=1):
        match = re.match(r"\| *\d+ *\| *`([a-z0-9/]+?)/?` *\|.*\|([^|]*)\|$", line)
        if match:
            libraries = {word.strip() for word in match.group(2).split(",")} - {""}
            rows[match.group(1)] = (number, libraries)
    for module in rows.keys() ^ MODULES.keys():
        yield f"{name}: {module} is in only one of its table and tools/check_layers.py"
    for module in [module for module in rows if module in MODULES]:
        number, libraries = rows[module]
        if libraries - EVERYONES != MODULES[module].libraries - EVERYONES:
            wanted = ", ".join(sorted(MODULES[module].libraries)) or "none"
            yield f"{name}:{number}: libraries of {module} other than in tools/check_layers.py: {wanted}"
        for used in sorted(MODULES[module].uses & rows.keys()):
            if rows[used][0] >= number:
                yield f"{name}:{number}: {module} may use {used}, which is not above it"


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent).resolve()
    problems = list(check_document(root))
    for folder in sorted((root / "src/semview").iterdir()):
        if folder.is_dir() and folder.name not in MODULES:
            problems.append(f"src/semview/{folder.name}: a module that tools/check_layers.py does not know")
    for module in MODULES:
        found, included = check_includes(root, module)
        problems += found + check_links(root, module, included)
    print("\n".join(problems) if problems
          else f"layers: {len(MODULES)} modules, every include and link allowed")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
