#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The 2017 paper's projection of a labelled point cloud with numpy, as a peer of `semview bench`.

point_projection.py POINTS COLUMNS ROWS EYES ROUNDS

POINTS holds x, y, z and the label of each point as four arrays of float32, one after the other; EYES
is x,y,z;x,y,z;… Elevations reach from -45 to 45 degrees. Prints the seconds of the processor of each round, one a
line, then the labels of the first eye's picture in hexadecimal digits.
"""
import sys
import time

import numpy as np


def project(points, eye, columns, rows):
    """The class of the nearest point that falls into each pixel; 0 for a pixel without points."""
    x, y, z, labels = points
    dx, dy, dz = x - eye[0], y - eye[1], z - eye[2]
    level = dx * dx + dy * dy
    row = np.floor((np.pi / 4 - np.arctan2(dz, np.sqrt(level))) * (rows / (np.pi / 2)))
    column = np.floor((np.pi - np.arctan2(dy, dx)) * (columns / (2 * np.pi)))
    seen = (row >= 0) & (row < rows)
    pixel = row[seen].astype(np.int32) * columns + np.clip(column[seen], 0, columns - 1).astype(np.int32)
    # Written from far to near: the nearest point stays.
    order = np.argsort(-(level + dz * dz)[seen], kind="stable")
    picture = np.zeros(rows * columns, np.uint8)
    picture[pixel[order]] = labels[seen][order]
    return picture


def main():
    file, columns, rows, eyes, rounds = sys.argv[1:]
    columns, rows = int(columns), int(rows)
    points = np.fromfile(file, np.float32).reshape(4, -1)
    points = (*points[:3], points[3].astype(np.uint8))
    eyes = [np.array(eye.split(","), np.float32) for eye in eyes.split(";")]
    for _ in range(int(rounds)):
        start = time.thread_time()
        pictures = [project(points, eye, columns, rows) for eye in eyes]
        print((time.thread_time() - start) / len(eyes))
    print(pictures[0].tobytes().hex())


if __name__ == "__main__":
    main()
