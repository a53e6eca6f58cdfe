#!/usr/bin/env python3
"""Holds the direction of #include lines: what may know what.

usage: includes.py SOURCE_DIR

Layers of src/ (each folder may include itself and what its row names), and for kernels/:
only simd.hpp includes xsimd; no other system header than <cstddef> and <cstdint>; nothing of src/.
"""
import pathlib
import re
import sys

KERNELS = "kernels/interface.hpp"
PUBLIC = {KERNELS, "kernels/terms.hpp", "kernels/sampling.hpp"}  # what the rest may include
# folder -> the folders of src/ that it may include, and whether it may include kernels/interface.hpp
LAYERS = {
    "base": (set(), True),  # only constants of the interface
    "scene": ({"base"}, True),
    "io": ({"scene", "base"}, True),
    "raster": ({"scene", "base"}, True),
    "precompute": ({"scene", "base"}, True),
    "reference": (set(), False),
    "catalogue": (set(), True),
    "chart": ({"base"}, False),
    "frame": ({"raster", "precompute", "io", "scene", "base"}, True),
    "cli": ({"frame", "catalogue", "chart", "reference", "raster", "precompute", "io", "scene", "base"}, True),
}
# The same inside kernels/; all may include simd.hpp and interface.hpp.
KERNEL_LAYERS = {
    "interface": set(),  # the parts of interface.hpp
    "simd": set(),
    "math": set(),
    "bsdf": {"math"},
    "light": {"math"},
    "texture": {"math"},
    "tonemap": {"math"},
    "shade": {"bsdf", "light", "math"},
    "raster": {"texture", "math"},
    "bake": {"bsdf", "light", "texture", "math"},
    "entry": {"bake", "bsdf", "light", "math", "raster", "shade", "texture", "tonemap"},
}
KERNEL_SYSTEM_HEADERS = {"cstddef", "cstdint"}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)


def problems_of(path, text):
    """What is wrong with the #include lines of the file at `path` (relative, with forward slashes)."""
    parts = path.split("/")
    for bracket, target in INCLUDE.findall(text):
        system = bracket == "<"
        folder = target.split("/")[0]
        if folder == "xsimd" and path != "kernels/simd.hpp":
            yield f"{target}: only kernels/simd.hpp includes xsimd"
        if ".." in target.split("/"):
            yield f"{target}: includes are written from the top"
        if parts[0] == "kernels":
            if system and folder != "xsimd" and target not in KERNEL_SYSTEM_HEADERS:
                yield f"<{target}>: kernels include no system header but {sorted(KERNEL_SYSTEM_HEADERS)}"
            if not system and folder != "kernels":
                yield f"{target}: kernels include kernels only"
            if len(parts) > 2:  # in a folder
                allowed = KERNEL_LAYERS.get(parts[1])
                included = target.split("/")[1] if not system and target.count("/") > 1 else parts[1]
                if allowed is None:
                    yield f"kernels/{parts[1]} has no row in KERNEL_LAYERS"
                elif included != parts[1] and included not in allowed:
                    yield f"{target}: kernels/{parts[1]} may include {sorted(allowed)}"
        elif parts[0] == "src":
            allowed, interface = LAYERS.get(parts[1], (None, False))
            if allowed is None:
                yield f"src/{parts[1]} has no row in LAYERS"
                continue
            if folder == "kernels" and not (interface and target in PUBLIC):
                yield f"{target}: src/ knows the kernels through {sorted(PUBLIC)} alone" + (
                    "" if interface else f", and src/{parts[1]} not even that")
            if not system and folder in LAYERS and folder != parts[1] and folder not in allowed:
                yield f"{target}: src/{parts[1]} may include {sorted(allowed)}"
            if not system and folder not in LAYERS and folder != "kernels":
                yield f"{target}: not in src/ (other libraries are included with <>)"
        elif parts[0] == "bench" and folder == "kernels" and target not in PUBLIC:
            yield f"{target}: bench/ knows the kernels through {sorted(PUBLIC)} alone"


# Files that each break one rule, and one that breaks none: a guard that lets anything through is no guard.
EXAMPLES = [
    ("kernels/math/good.hpp", '#include "kernels/simd.hpp"\n#include <cstdint>\n#include "kernels/math/vector.hpp"', 0),
    ("kernels/math/bad.hpp", "#include <xsimd/xsimd.hpp>", 1),
    ("kernels/math/bad.hpp", "#include <cmath>", 1),
    ("kernels/math/bad.hpp", '#include "base/error.hpp"', 1),
    ("kernels/math/bad.hpp", '#include "kernels/bsdf/fresnel.hpp"', 1),
    ("kernels/light/bad.hpp", '#include "kernels/bsdf/fresnel.hpp"', 1),
    ("src/scene/bad.hpp", '#include "io/gltf.hpp"', 1),
    ("src/io/bad.cpp", '#include "raster/bins.hpp"', 1),
    ("src/frame/bad.cpp", '#include "kernels/math/approx.hpp"', 1),
    ("src/reference/bad.cpp", '#include "kernels/interface.hpp"', 1),
    ("src/frame/good.cpp", '#include "raster/bins.hpp"\n#include "kernels/interface.hpp"\n#include <vector>', 0),
    ("bench/bad.cpp", '#include "kernels/simd.hpp"', 1),
]


def main():
    for path, text, expected in EXAMPLES:
        assert len(list(problems_of(path, text))) == expected, (path, text)
    root = pathlib.Path(sys.argv[1])
    files, found = 0, []
    for top in ("kernels", "src", "bench"):
        for path in sorted((root / top).rglob("*")):
            if path.suffix in (".hpp", ".cpp", ".h"):
                files += 1
                name = path.relative_to(root).as_posix()
                found += [f"{name}: {problem}" for problem in problems_of(name, path.read_text(encoding="utf-8"))]
    for problem in found:
        print(problem)
    print(f"{files} files, {len(found)} problems")
    return 1 if found or not files else 0


if __name__ == "__main__":
    sys.exit(main())
