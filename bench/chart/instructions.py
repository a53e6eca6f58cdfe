#!/usr/bin/env python3
"""Counts what the compiler made of each term: instructions in the loop of run_vectors, kernels/entry/terms.hpp.

usage: instructions.py OBJDUMP OUTPUT.cpp OBJECT...    (objects each in a folder named after its instruction set)

Writes a C++ table of {instruction set, term, instructions per vector, divisions and square roots among them}.
"""
import re
import subprocess
import sys

FUNCTION = re.compile(r"^[0-9a-f]+ <(.*)>:$")
INSTRUCTION = re.compile(r"^\s+([0-9a-f]+):\s+(\S+)\s*(.*)$")
TERM = re.compile(r"::run_vectors<&.*?::\(anonymous namespace\)::(\w+)<[^(]*\(anonymous namespace\)::Float>\(")
VECTOR = re.compile(r"%[xyz]mm|\bv\d+\.4s|\bq\d+")
JUMP = re.compile(r"^(j\w+|b(\.\w+)?|cbn?z|tbn?z)$")
SLOW = re.compile(r"^v?(div|sqrt)ps$|^fdiv$|^fsqrt$")


def functions(objdump, path):
    """(demangled name, [(address, mnemonic, operands)]) of each function of an object file."""
    text = subprocess.run([objdump, "-dC", "--no-show-raw-insn", path], check=True, capture_output=True, text=True)
    name, body = None, []
    for line in text.stdout.splitlines():
        if match := FUNCTION.match(line):
            if name:
                yield name, body
            name, body = match.group(1), []
        elif (match := INSTRUCTION.match(line)) and name:
            body.append((int(match.group(1), 16), match.group(2), match.group(3)))
    if name:
        yield name, body


def loop_of(body):
    """The loop with the most vector instructions: from the target of a backward jump to the jump."""
    best, most = [], 0
    for end, (address, mnemonic, operands) in enumerate(body):
        target = re.search(r"\b([0-9a-f]+) <", operands) if JUMP.match(mnemonic) else None
        if not target or int(target.group(1), 16) > address:
            continue
        loop = [entry for entry in body[: end + 1] if entry[0] >= int(target.group(1), 16)]
        vectors = sum(bool(VECTOR.search(operands)) for _, _, operands in loop)
        if vectors > most:
            best, most = loop, vectors
    return best


def main():
    objdump, output, objects = sys.argv[1], sys.argv[2], sys.argv[3:]
    rows = []
    for path in objects:
        isa = re.search(r"tessera_kernels_(\w+)\.dir", path).group(1)
        if "/terms_" not in path:
            continue
        for name, body in functions(objdump, path):
            term = TERM.search(name)
            loop = loop_of(body) if term else []
            if loop:
                slow = sum(bool(SLOW.match(mnemonic)) for _, mnemonic, _ in loop)
                rows.append(f'    {{"{isa}", "{term.group(1)}", {len(loop)}, {slow}}},')
    with open(output, "w", encoding="utf-8") as file:
        file.write('#include "bench/chart/instructions.hpp"\n\nnamespace tessera::chart {\n\n'
                   "const std::vector<LoopCount>& loop_counts() {\n  static const std::vector<LoopCount> all = {\n" +
                   "\n".join(sorted(rows)) + "\n  };\n  return all;\n}\n\n}  // namespace tessera::chart\n")


if __name__ == "__main__":
    main()
