#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints bench/results.json, which `semview bench --json` wrote, as a table of ranges over plans.

bench_summary.py [FILE]    Markdown: a line for each claim, panorama size and number of threads
"""
import json
import sys
from pathlib import Path

RESULTS = Path(__file__).resolve().parent.parent / "bench/results.json"
PREFIXES = ((1.0, ""), (1e-3, "m"), (1e-6, "u"), (1e-9, "n"))


def digits(value):
    """Three of them, and no exponent."""
    return f"{value:.3g}" if value < 1000 else f"{value:.0f}"


def figure(value, unit):
    if unit == "s":
        scale, prefix = next(((s, p) for s, p in PREFIXES if value >= s), PREFIXES[-1])
        return f"{digits(value / scale)} {prefix}s"
    return f"{digits(value)} {unit}"


def spread(values, show):
    low, high = show(min(values)), show(max(values))
    return low if low == high else f"{low} – {high}"


def line(rows):
    first = rows[0]
    ours = spread([row["ours"] for row in rows], lambda value: figure(value, first["unit"]))
    others = [row["other"] for row in rows if row["other"]]
    other = spread(others, lambda value: figure(value, first["unit"])) if others else "–"
    ratios = [row["ratio"] for row in rows if row["ratio"]]
    ratio = spread(ratios, lambda value: digits(value) + "×") if ratios else "–"
    judged = [row["reached"] for row in rows if "reached" in row]
    goal = f"{first['goal']}: {sum(judged)} of {len(judged)}" if judged else "–"
    return [first["claim"], first["size"], str(first["threads"]), ours, other, ratio, goal]


def main():
    path = Path(sys.argv[1]) if len(sys.argv) > 1 else RESULTS
    groups = {}
    for row in json.loads(path.read_text(encoding="utf-8"))["rows"]:
        if "ours" in row:
            groups.setdefault((row["id"], row["size"], row["threads"]), []).append(row)
    header = ["claim: ours; the alternative", "size", "threads", "ours", "the alternative", "ratio",
              "goal: plans that reach it"]
    print("| " + " | ".join(header) + " |\n|" + " --- |" * len(header))
    for rows in groups.values():
        print("| " + " | ".join(line(rows)) + " |")


if __name__ == "__main__":
    main()
