"""Checks who includes whom: include_directions.py ROOT

Reads every `#include "..."` of include/, src/ and apps/ under ROOT and compares it with the table of
docs/design/architecture.md. The core needs Eigen, xsimd and Boost alone: every other library belongs to some layers.
What other platforms lack goes through one file each.
Prints each violation as FILE:LINE and exits 1 if there is one.
"""

import pathlib
import re
import sys

# A layer may include itself and what stands here. "ode/segment" is that one header.
ALLOWED = {
    "text": set(),
    "math": {"text"},
    "law": {"math", "text"},
    "ode": {"math", "text"},
    "geom": {"math"},
    "rigid": {"math", "ode/segment"},
    "event": {"math", "law", "ode/segment"},
    "collide": {"math", "law", "ode/segment", "geom", "rigid", "event"},
}
ALLOWED["scene"] = set(ALLOWED)
ALLOWED["sim"] = ALLOWED["scene"] | {"scene"}
ALLOWED["study"] = ALLOWED["sim"] | {"sim"}
ALLOWED["ensemble"] = ALLOWED["study"] | {"study"}
ALLOWED["io"] = ALLOWED["viz"] = ALLOWED["ensemble"] | {"ensemble"}
ALLOWED["apps"] = ALLOWED["io"] | {"io", "viz"}
# Headers directly in include/trajet/ that every layer may include; any other one is for users of the library only.
LEAVES = {"error", "portable", "version"}
# Which layers may include a library, by the first folder or the name of its header.
LIBRARIES = {
    "cvode": {"ode"},
    "nvector": {"ode"},
    "sunlinsol": {"ode"},
    "sunmatrix": {"ode"},
    "sunnonlinsol": {"ode"},
    "toml++": {"io"},
    "udunits2.h": {"io"},
    "tiny_gltf.h": {"io"},
    "nlohmann": {"io", "viz"},
    "fmt": {"io", "viz", "apps"},
    "assimp": {"io"},
    "hdf5.h": {"io"},
    "tbb": {"ensemble"},
    "Random123": {"ensemble"},
    "dlfcn.h": {"io"},
    "CLI": {"apps"},
}

# What other platforms lack, and the one file that may say it.
DOORS = {
    re.compile(r"\bstd::ranges::|\bstd::bit_cast\b|\blong double\b"): "include/trajet/portable.hpp",
    re.compile(r"\bfrom_chars\("): "src/text/decimal_number.cpp",
    re.compile(r"<xsimd/"): "include/trajet/math/pack.hpp",
}

INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"')
LIBRARY_INCLUDE = re.compile(r"^\s*#\s*include\s*<([^/>]+)")


def place(path):
    """The layer of a file and its name within the house without extension: (collide, collide/detect/contact_table)."""
    parts = path.with_suffix("").parts
    if parts[0] == "apps":
        return "apps", "/".join(parts)
    inside = parts[2:] if parts[:2] == ("include", "trajet") else parts[1:]
    return (inside[0] if len(inside) > 1 else ""), "/".join(inside)


def resolve(root, source, name):
    """The file that an include means, relative to root."""
    if name == "trajet/version.hpp":  # written into the build folder
        return pathlib.Path("include/trajet/version.hpp")
    for candidate in (source.parent / name, pathlib.Path("include") / name, pathlib.Path("src") / name):
        if (root / candidate).is_file():
            return pathlib.Path(*(root / candidate).resolve().relative_to(root).parts)
    return None


def violations(root):
    """Every include that the table does not allow, as text; and the number of includes read."""
    root = pathlib.Path(root).resolve()
    found, count = [], 0
    sources = sorted(p for top in ("include", "src", "apps") for p in (root / top).rglob("*.[ch]pp"))
    for absolute in sources:
        source = absolute.relative_to(root)
        layer, _ = place(source)
        if layer == "" and source.parts[0] == "include" and source.stem not in LEAVES:
            continue  # the umbrella header
        if layer not in ALLOWED and layer != "":
            found.append(f"{source}:1: {layer} is no layer of the table")
            continue
        for number, line in enumerate(absolute.read_text(encoding="utf-8").splitlines(), 1):
            where = f"{source}:{number}"
            for door, owner in DOORS.items():
                if door.search(line.split("//")[0]) and source.as_posix() != owner:
                    found.append(f"{where}: {door.search(line)[0]} is behind {owner}")
            library = LIBRARY_INCLUDE.match(line)
            if library and layer not in LIBRARIES.get(library[1], {layer}):
                found.append(f"{where}: {layer or 'a leaf'} may not include <{library[1]}>")
            match = INCLUDE.match(line)
            if not match:
                continue
            count += 1
            target = resolve(root, source, match[1])
            if target is None:
                found.append(f'{where}: "{match[1]}" is no file of include/ or src/')
            elif target.parts[0] not in ("include", "src", "apps"):
                found.append(f"{where}: includes {target}")
            else:
                target_layer, target_name = place(target)
                allowed = ALLOWED.get(layer, set())
                if target_layer == "" and target_name in LEAVES:
                    continue
                if target_layer != layer and target_layer not in allowed and target_name not in allowed:
                    found.append(f"{where}: {layer or 'a leaf'} may not include {target_name}")
    return found, count


if __name__ == "__main__":
    problems, includes = violations(sys.argv[1])
    print("\n".join(problems) if problems else f"{includes} includes follow the table")
    sys.exit(1 if problems or includes == 0 else 0)
