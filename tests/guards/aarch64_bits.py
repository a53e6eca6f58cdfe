#!/usr/bin/env python3
"""Builds the kernels for AArch64, runs kernel_hash there under qemu-user, and compares with the native hashes.

usage: aarch64_bits.py SOURCE_DIR BUILD_DIR NATIVE_KERNEL_HASH
Exit status 77 (ctest's SKIP_RETURN_CODE) without a cross compiler or qemu.
"""
import pathlib
import shutil
import subprocess
import sys

SKIPPED = 77
TOOLS = ["aarch64-linux-gnu-g++", "qemu-aarch64-static", "cmake", "ninja"]


def hashes(command):
    """kernel -> {hash: [instruction sets]} as printed by kernel_hash."""
    out = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    result = {}
    for line in out.splitlines():
        isa, kernel, value = line.split()
        result.setdefault(kernel, {}).setdefault(value, []).append(isa)
    return result


def main():
    source, build, native = (pathlib.Path(argument) for argument in sys.argv[1:4])
    missing = [tool for tool in TOOLS if not shutil.which(tool)]
    if missing:
        print("skipped: no " + ", ".join(missing))
        return SKIPPED
    subprocess.run(["cmake", "-S", source, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                    f"-DCMAKE_TOOLCHAIN_FILE={source.resolve()}/cmake/aarch64.cmake", "-DTESSERA_KERNELS_ONLY=ON",
                    "-DTESSERA_BUILD_TESTS=OFF"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", build, "--target", "kernel_hash"], check=True, stdout=subprocess.DEVNULL)
    here = hashes([native])
    there = hashes(["qemu-aarch64-static", "-L", "/usr/aarch64-linux-gnu", build / "kernel_hash"])
    wrong = 0
    for kernel in here:
        together = {}
        for found in (here, there):
            for value, isas in found.get(kernel, {"nothing": ["neon64"]}).items():
                together.setdefault(value, []).extend(isas)
        if len(together) != 1:
            wrong += 1
        print(("same  " if len(together) == 1 else "DIFFER ") + kernel + ": " +
              "; ".join(f"{value} on {', '.join(isas)}" for value, isas in together.items()))
    return 1 if wrong or not here else 0


if __name__ == "__main__":
    sys.exit(main())
