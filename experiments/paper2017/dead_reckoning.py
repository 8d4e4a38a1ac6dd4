#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""dead_reckoning.py INPUT OUT: a method for `--estimates`, as short as one can be. It knows where it starts."""
import cmath, csv, pathlib, sys

def poses(file):  # stamp, place as x + iy, heading as a complex number of length 1
    rows = [list(map(float, line.split())) for line in open(file) if not line.startswith("#")]
    return [(row[0], complex(row[1], row[2]), complex(row[7], row[6]) ** 2) for row in rows]

given, out = map(pathlib.Path, sys.argv[1:])
for drive in csv.DictReader(open(given / "list.csv")):
    [(_, start, heading)], odometry = poses(given / drive["start"]), poses(given / drive["log"] / "odometry.txt")
    turn = heading / odometry[0][2]
    (out / drive["estimate"]).parent.mkdir(parents=True, exist_ok=True)
    with open(out / drive["estimate"], "w") as file:
        for stamp, place, yaw in odometry:
            at, half = start + turn * (place - odometry[0][1]), cmath.sqrt(turn * yaw)
            print(stamp, at.real, at.imag, 0, 0, 0, half.imag, half.real, file=file)
