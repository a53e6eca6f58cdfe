#!/usr/bin/env python3
"""What the peer comparison concludes: its table's figures, and which pictures it takes for the same.

usage: comparison_test.py table.py tessera_peer_compare
"""
import array
import json
import pathlib
import subprocess
import sys
import tempfile


def check_table(table, folder):
    # Rounds of 40:10, 60:10 and 50:20: the ratios are 4, 6 and 2.5, their median 4, though 50 : 10 would be 5.
    log = folder / "log.jsonl"
    rows = []
    for mesa, tessera in ((40, 10), (60, 10), (50, 20)):
        for program, ms in (("4.5 Mesa", mesa), ("tessera-avx2", tessera)):
            rows += [{"impl": program, "variant": "L4", "median_ms": ms},
                     {"impl": program, "variant": "L16", "median_ms": ms + (24 if program == "4.5 Mesa" else 6)}]
    log.write_text("".join(json.dumps(row) + "\n" for row in rows), encoding="utf-8")
    text = subprocess.run([sys.executable, table, log], check=True, capture_output=True, text=True).stdout
    cells = {row[1]: row[2:5] for row in ([c.strip() for c in line.split("|")] for line in text.splitlines()) if len(row) > 5}
    assert cells["L4"] == ["50.00 (40.00 to 60.00)", "10.00 (10.00 to 20.00)", "4.00 (2.50 to 6.00)"], cells
    assert cells["a further light"] == ["2.00 (2.00 to 2.00)", "0.50 (0.50 to 0.50)", "4.00 (4.00 to 4.00)"], cells


def check_pictures(compare, folder):
    one = [0.0, 1.0, 100.0, 0.5]
    # Allowed are 0.0001, 0.0101, 1.0001 and 0.0051.
    cases = [(one, 0), ([0.00009, 1.01, 101.0, 0.495], 0), ([0.00011, 1.0, 100.0, 0.5], 1), ([0.0, 1.0, 98.9, 0.5], 1),
             ([0.0, float("nan"), 100.0, 0.5], 1), ([0.0, 1.0, float("inf"), 0.5], 1), (one[:3], 3)]
    for number, (other, expected) in enumerate(cases):
        paths = []
        for name, values in (("one", one), ("other", other)):
            paths.append(folder / f"{name}{number}.f32")
            paths[-1].write_bytes(array.array("f", values).tobytes())
        status = subprocess.run([compare, *paths], capture_output=True, check=False).returncode
        assert status == expected, (other, status)


def main():
    with tempfile.TemporaryDirectory() as name:
        check_table(sys.argv[1], pathlib.Path(name))
        check_pictures(sys.argv[2], pathlib.Path(name))
    print("the table's figures and the verdicts are right")


if __name__ == "__main__":
    main()
