#!/usr/bin/env python3
"""The table of a comparison: medians, and how many times faster Tessera is, by round.

usage: table.py LOG [AGREEMENT]

LOG holds the JSON lines of all rounds in the order in which they ran; AGREEMENT a line "VARIANT words" for each pair of
pictures that was compared. A row's ratio is taken within each round, whose two programs ran one after the other.
"""
import json
import statistics
import sys


def read(path):
    """The milliseconds of each program by variant, round after round; and what the programs call themselves."""
    times, names = {}, {}
    with open(path, encoding="utf-8") as log:
        for line in log:
            row = json.loads(line)
            program = "tessera" if row["impl"].startswith("tessera") else "mesa"
            names[program] = row["impl"]
            times.setdefault(row["variant"], {}).setdefault(program, []).append(row["median_ms"])
    return times, names


def spread(values, digits):
    """Median, least and most."""
    low, middle, high = min(values), statistics.median(values), max(values)
    return f"{middle:.{digits}f} ({low:.{digits}f} to {high:.{digits}f})"


def rows_of(times):
    """(title, Mesa's milliseconds by round, Tessera's): the variants, then what each further light costs."""
    rows = [(name, t["mesa"], t["tessera"]) for name, t in times.items()]
    if "L4" in times and "L16" in times:
        slopes = [[(b - a) / 12 for a, b in zip(times["L4"][p], times["L16"][p])] for p in ("mesa", "tessera")]
        rows.append(("a further light", *slopes))
    return rows


def main():
    times, names = read(sys.argv[1])
    rounds = min(len(values) for by_program in times.values() for values in by_program.values())
    print(f"Deferred shading, 1920 x 1080, milliseconds a frame: median (least to most) of {rounds} rounds")
    print(f"Mesa: {names['mesa']}; Tessera: {names['tessera']}\n")
    print(f"| {'lights':15} | {'Mesa llvmpipe':26} | {'Tessera':26} | {'times faster':26} |")
    print(f"| {'-' * 15} | {'-' * 25}: | {'-' * 25}: | {'-' * 25}: |")
    for title, mesa, tessera in rows_of(times):
        ratios = [m / t for m, t in zip(mesa, tessera) if t > 0]
        cells = [spread(mesa, 2), spread(tessera, 2), spread(ratios, 2) if ratios else "-"]
        print(f"| {title:15} | " + " | ".join(f"{cell:>26}" for cell in cells) + " |")
    if len(sys.argv) > 2:
        print("\nHow far the pictures are apart:")
        with open(sys.argv[2], encoding="utf-8") as lines:
            print("".join(f"  {line}" for line in lines), end="")


if __name__ == "__main__":
    main()
