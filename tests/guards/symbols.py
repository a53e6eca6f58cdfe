#!/usr/bin/env python3
"""Keeps code compiled for a wide instruction set from reaching a narrower machine, and libm out of the kernels.

usage: symbols.py NM OBJECT...      (the kernels' object files, each in a folder named after its instruction set)

Fails on
- a weak or unique symbol: the linker keeps one copy for the whole program, perhaps the one that uses AVX-512.
  Passed over if it is one of xsimd's (sanitizers keep some from being inlined) and of one instruction set only;
- a global symbol outside its instruction set's namespace, or one that two objects define;
- an undefined symbol that is neither a kernel's nor on the short list below: libm's results change with the machine.
"""
import re
import subprocess
import sys

# What compilers call for copying and clearing memory, what sanitizers and stack protection insert, the linker's own.
ALLOWED_UNDEFINED = re.compile(
    r"mem(cpy|set|move|cmp)$|__asan_|__ubsan_|__tsan_|__sanitizer_|__stack_chk_fail$|_GLOBAL_OFFSET_TABLE_$")
# Weak definitions that hold no code of ours: sanitizers' module hooks, the linker's reference to a personality.
ALLOWED_WEAK = re.compile(r"asan\.|__odr_asan|__asan_|DW\.ref\.")


def symbols(nm, path):
    """(type letter, name) of each symbol of an object file."""
    out = subprocess.run([nm, "--format=posix", path], check=True, capture_output=True, text=True).stdout
    for line in out.splitlines():
        name, kind = line.split()[:2]
        yield kind, name


def main():
    nm, objects = sys.argv[1], sys.argv[2:]
    if not objects:
        sys.exit("symbols.py: no object files given")
    problems, owner, needed, weak = [], {}, {}, {}
    for path in objects:
        isa = re.search(r"tessera_kernels_(\w+)\.dir", path).group(1)
        ours = f"{len(isa)}{isa}"  # as it appears in a mangled name
        for kind, name in symbols(nm, path):
            if kind in "VWuvw" and not ALLOWED_WEAK.match(name):
                weak.setdefault(name, set()).add((isa, path))
            elif kind == "U":
                needed.setdefault(name, []).append((path, ours))
            elif kind.isupper() and not ALLOWED_WEAK.match(name):
                if "7tessera" + ours not in name:
                    problems.append(f"{path}: {name} is visible outside, and not in the namespace of {isa}")
                if name in owner:
                    problems.append(f"{name}: defined by {path} and {owner[name]}")
                owner[name] = path
    for name, places in weak.items():
        if "5xsimd" not in name or len({isa for isa, _ in places}) > 1:
            problems += [f"{path}: weak or unique symbol {name}" for _, path in sorted(places)]
    for name, users in needed.items():
        for path, ours in users:
            if not ALLOWED_UNDEFINED.match(name) and not (name in owner and "7tessera" + ours in name):
                problems.append(f"{path}: calls {name}, which no kernel of its instruction set defines")
    for problem in problems:
        print(problem)
    print(f"{len(objects)} objects, {len(owner)} visible symbols, {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
