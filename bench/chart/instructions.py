#!/usr/bin/env python3
"""Counts what the compiler made of each term and of each way to sample: the instructions in the loop of run_vectors,
kernels/entry/terms.hpp, or of sample_vectors, kernels/entry/sampling.cpp.

usage: instructions.py OBJDUMP OUTPUT.cpp OBJECT...    (objects each in a folder named after its instruction set)

Writes two C++ tables: {instruction set, term, instructions per vector, divisions and square roots among them} and
{instruction set, format, layout, filter, cube, instructions per vector, gathers of 32 and of 64 bits among them}.
"""
import re
import subprocess
import sys

FUNCTION = re.compile(r"^[0-9a-f]+ <(.*)>:$")
INSTRUCTION = re.compile(r"^\s+([0-9a-f]+):\s+(\S+)\s*(.*)$")
TERM = re.compile(r"::run_vectors<&.*?::\(anonymous namespace\)::(\w+)<[^(]*\(anonymous namespace\)::Float>\(")
SAMPLER = re.compile(r"::sample_vectors<\(tessera::SamplingFormat\)(\d), \(tessera::SamplingLayout\)(\d), "
                     r"\(tessera::SamplingFilter\)(\d), (true|false)>\(")
VECTOR = re.compile(r"%[xyz]mm|\bv\d+\.4s|\bq\d+")
JUMP = re.compile(r"^(j\w+|b(\.\w+)?|cbn?z|tbn?z)$")
GATHERS = re.compile(r"^v(gatherdps|pgatherdd)$"), re.compile(r"^v(gatherdpd|pgatherdq)$")
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


def count(loop, pattern):
    return sum(bool(pattern.match(mnemonic)) for _, mnemonic, _ in loop)


def table(function, entry, rows):
    return (f"const std::vector<{entry}>& {function}() {{\n  static const std::vector<{entry}> all = {{\n" +
            "".join(f"    {{{row}}},\n" for row in sorted(rows)) + "  };\n  return all;\n}\n\n")


def main():
    objdump, output, objects = sys.argv[1], sys.argv[2], sys.argv[3:]
    terms, samplers = [], []
    for path in objects:
        isa = re.search(r"tessera_kernels_(\w+)\.dir", path).group(1)
        for name, body in functions(objdump, path):
            if term := TERM.search(name):
                if loop := loop_of(body):
                    terms.append(f'"{isa}", "{term.group(1)}", {len(loop)}, {count(loop, SLOW)}')
            elif sampler := SAMPLER.search(name):
                if loop := loop_of(body):
                    kinds = [f"{kind}({value})" for kind, value in
                             zip(("SamplingFormat", "SamplingLayout", "SamplingFilter"), sampler.groups())]
                    gathers = [str(count(loop, width)) for width in GATHERS]
                    samplers.append(", ".join([f'"{isa}"', *kinds, sampler.group(4), str(len(loop)), *gathers]))
    with open(output, "w", encoding="utf-8") as file:
        file.write('#include "bench/chart/instructions.hpp"\n\nnamespace tessera::chart {\n\n' +
                   table("loop_counts", "LoopCount", terms) + table("sampler_counts", "SamplerCount", samplers) +
                   "}  // namespace tessera::chart\n")


if __name__ == "__main__":
    main()
