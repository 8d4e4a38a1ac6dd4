#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What tools/redraw_plan.py promises of a shipped plan. usage: redraw_plan_test.py SOURCE"""
import csv
import subprocess
import sys
import tempfile
from pathlib import Path

source = Path(sys.argv[1])
sys.path.insert(0, str(source / "tools"))
import redraw_plan  # noqa: E402

TRUE_ROOMS = source / "experiments/paper2017/sketches/duplex_level2_true_rooms.csv"


def rooms_of(path):
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    return {line["room"]: [float(line[key]) for key in list(line)[1:]] for line in csv.DictReader(lines)}


with tempfile.TemporaryDirectory() as folder:
    outs = [Path(folder) / name for name in ("one", "same", "other")]
    for out, seed in zip(outs, ("1", "1", "2")):
        subprocess.run([sys.executable, "-B", str(source / "tools/redraw_plan.py"),
                        str(source / "maps/duplex_level2"), str(TRUE_ROOMS), seed, str(out)], check=True)
    one, same, other = ((out / "labels.png").read_bytes() for out in outs)
    assert one == same, "equal seeds: equal sketches"
    assert one != other, "other seeds: other sketches"
    before, after = rooms_of(TRUE_ROOMS), rooms_of(outs[0] / "rooms.csv")
    assert list(before) == list(after)
    for name, (x0, y0, x1, y1) in before.items():
        u0, v0, u1, v1 = after[name]
        for factor in ((u1 - u0) / (x1 - x0), (v1 - v0) / (y1 - y0)):
            assert 0.69 < factor < 1.41, (name, factor)
    colors = set(redraw_plan.classes_of((outs[0] / "map.yaml").read_text()).values())
    drawn = {pixel for row in redraw_plan.read_png(outs[0] / "labels.png") for pixel in row}
    assert drawn <= colors | {(0, 0, 0)}, "no colour that is no class's"
