#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Carries measured figures to a campus and a city: writes docs/scaling.md.

scaling.py            writes the page from bench/results.json, which `semview bench --json` wrote
scaling.py --check    exit 1 if the page is not what it would write
"""
import json
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
RESULTS = ROOT / "bench/results.json"
PAGE = ROOT / "docs/scaling.md"
CELLS_A_M2 = 100
POSTERIOR_CELLS = 100_000  # those of the row "posterior": 12 M poses

# What, square metres, how they come about.
PLACES = [
    ("floor", 1_000, "one storey of 40 × 25 m"),
    ("hectare", 10_000, "a large hall, or ten such storeys"),
    ("campus", 200_000, "20 buildings of 5 storeys of 2000 m²"),
    ("city", 40_000_000, "10 000 buildings of 4 storeys of 1000 m²"),
]

TEXT = """# From a floor to a city

What the measured figures come to at other sizes. Written by `tools/scaling.py` from
[bench/results.json](../bench/results.json), which `semview bench --json` wrote; do not edit it by hand. All is
arithmetic: nothing on this page was run at the size of a city.

Every square metre is taken to be free, {cells} cells of 10 cm: real floors have a third less. Buildings are independent,
so all of it divides by as many machines as there are; a robot needs the map that it is on and no other.

Measured on {plan}, 360 × 90 pixels, one thread:

| | |
|---|---|
{measured}

| place | area | cells | on disk | in memory, all views | cast by columns | cast by Embree | one image against every cell and heading |
|---|---|---|---|---|---|---|---|
{places}

{where}

- **Disk** is the payload of the records as coded; keys, checksums and pages of the store come on top
  ([cache record](formats/cache_record.md)).
- **Cast** is casting alone; coding and storing a view add some 14 µs of a thread's time ([RESULTS.md](../bench/RESULTS.md)).
- **Memory** is what the scorer reads without decoding. A server needs the part that its robots are on: the tier forgets
  what was not used for longest, and a view that is missing is cast again in the time of the first row.
- **One image against every cell and heading** is the dense posterior, views in memory, for a robot that knows nothing: the
  probability of {headings} headings a cell, asked once; a robot that is tracked asks for some hundred cells.
"""


def find(rows, identity, plan=None):
    for row in rows:
        if row["id"] == identity and row["threads"] == 1 and "ours" in row and plan in (None, row["plan"]):
            return row
    sys.exit(f"scaling.py: {RESULTS.name} has no row {identity} on one thread; "
             f"run semview bench --json with it")


def number(value):
    """Three digits, thousands apart: 1 230 000."""
    if value >= 100:
        return f"{value:,.0f}".replace(",", " ")
    return f"{value:.3g}"


def of_units(value, units):
    """The value in the largest of (factor, name) that leaves at least 1."""
    for factor, name in units:
        if value >= factor:
            break
    return f"{number(value / factor)} {name}"


def size(value):
    return of_units(value, [(1e15, "PB"), (1e12, "TB"), (1e9, "GB"), (1e6, "MB"), (1e3, "kB"), (1, "B")])


def duration(seconds):
    return of_units(seconds, [(3600, "core-hours"), (60, "core-minutes"), (1, "core-seconds"), (1e-3, "ms"), (1e-6, "µs")])


def page():
    rows = json.loads(RESULTS.read_text())["rows"]
    labels = find(rows, "labels")
    plan = labels["plan"]
    bytes_a_view = find(rows, "bytes", plan)["ours"]
    held = find(rows, "held", plan)["ours"]
    # Two rows time the same packets; the least is nearest to what they can.
    packets = min(labels["other"], find(rows, "columns", plan)["other"])
    compass = find(rows, "compass", plan)["ours"]
    posterior = find(rows, "posterior", plan)["ours"] / POSTERIOR_CELLS
    measured = [
        ("a view cast by columns", duration(labels["ours"])),
        ("cast by Embree packets", duration(packets)),
        ("compared at 120 headings, alone", duration(compass)),
        ("the same as a cell of the dense posterior", duration(posterior)),
        ("stored", size(bytes_a_view)),
        ("held in memory", size(held)),
    ]
    lines = []
    for name, area_m2, _ in PLACES:
        cells = area_m2 * CELLS_A_M2
        lines.append([name, f"{number(area_m2)} m²", number(cells), size(cells * bytes_a_view),
                      size(cells * held), duration(cells * labels["ours"]),
                      duration(cells * packets), duration(cells * posterior)])
    return TEXT.format(
        cells=CELLS_A_M2,
        plan=plan,
        headings=120,
        measured="\n".join(f"| {name} | {value} |" for name, value in measured),
        places="\n".join("| " + " | ".join(line) + " |" for line in lines),
        where="\n".join(f"- **{name}**: {text}" for name, _, text in PLACES))


def main():
    text = page()
    if sys.argv[1:] == ["--check"]:
        if not PAGE.exists() or PAGE.read_text() != text:
            sys.exit(f"{PAGE.relative_to(ROOT)} is not what tools/scaling.py writes from "
                     f"{RESULTS.relative_to(ROOT)}: run tools/scaling.py")
        return
    PAGE.write_text(text)


if __name__ == "__main__":
    main()
