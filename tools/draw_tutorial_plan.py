#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws maps/tutorial/labels.png, the plan of docs/tutorial.md, as one would in a paint program.

usage: draw_tutorial_plan.py [OUT.png]
"""
import struct
import sys
import zlib
from pathlib import Path

RESOLUTION_M = 0.02
MARGIN_M = 0.2  # outside, around the house
WIDTH_M, HEIGHT_M = 8.0, 6.0

COLORS = {
    "outside": (0, 0, 0),
    "floor": (80, 50, 50),
    "rug": (150, 60, 90),
    "wall": (120, 120, 120),
    "door": (8, 255, 51),
    "windowpane": (230, 230, 230),
    "table": (255, 150, 50),
    "chair": (204, 70, 3),
    "sofa": (11, 102, 255),
    "bed": (204, 5, 255),
    "cabinet": (110, 60, 150),
    "bookcase": (0, 255, 245),
    "refrigerator": (140, 200, 255),
}

# (class, left, bottom, right, top) in metres from the house's lower-left corner, bottom layer first.
RECTANGLES = [
    ("wall", 0.0, 0.0, 8.0, 6.0),
    # Living room, kitchen, bedroom.
    ("floor", 0.2, 0.2, 4.6, 5.8),
    ("floor", 4.7, 0.2, 7.8, 3.2),
    ("floor", 4.7, 3.3, 7.8, 5.8),
    # Doors: the house's own, to the kitchen, to the bedroom.
    ("door", 0.9, 0.0, 1.8, 0.2),
    ("door", 4.6, 1.7, 4.7, 2.6),
    ("door", 4.6, 3.6, 4.7, 4.5),
    # Windows.
    ("windowpane", 1.2, 5.8, 3.2, 6.0),
    ("windowpane", 7.8, 0.9, 8.0, 2.3),
    ("windowpane", 7.8, 4.2, 8.0, 5.4),
    ("windowpane", 0.0, 2.2, 0.2, 3.0),
    # Living room.
    ("rug", 0.9, 3.5, 2.9, 5.2),
    ("sofa", 0.2, 3.6, 1.1, 5.5),
    ("table", 1.6, 4.0, 2.2, 5.0),
    ("bookcase", 3.4, 5.5, 4.6, 5.8),
    ("table", 2.5, 0.9, 3.9, 1.8),
    ("chair", 2.6, 0.4, 3.0, 0.8),
    ("chair", 3.3, 0.4, 3.7, 0.8),
    ("chair", 2.6, 1.9, 3.0, 2.3),
    ("chair", 3.3, 1.9, 3.7, 2.3),
    # Kitchen.
    ("cabinet", 5.4, 0.2, 7.8, 0.8),
    ("refrigerator", 4.7, 0.2, 5.4, 0.8),
    ("table", 6.6, 2.4, 7.4, 3.2),
    ("chair", 6.1, 2.6, 6.5, 3.0),
    # Bedroom.
    ("bed", 6.0, 3.7, 7.6, 5.8),
    ("cabinet", 4.7, 5.2, 5.7, 5.8),
]


def paint():
    columns = round((WIDTH_M + 2 * MARGIN_M) / RESOLUTION_M)
    rows = round((HEIGHT_M + 2 * MARGIN_M) / RESOLUTION_M)
    pixels = [[COLORS["outside"]] * columns for _ in range(rows)]
    for name, left, bottom, right, top in RECTANGLES:
        x0, x1 = (round((x + MARGIN_M) / RESOLUTION_M) for x in (left, right))
        y0, y1 = (round((y + MARGIN_M) / RESOLUTION_M) for y in (bottom, top))
        for row in range(rows - y1, rows - y0):
            pixels[row][x0:x1] = [COLORS[name]] * (x1 - x0)
    return pixels


def png(pixels):
    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    header = struct.pack(">IIBBBBB", len(pixels[0]), len(pixels), 8, 2, 0, 0, 0)
    raw = b"".join(b"\0" + bytes(value for pixel in row for value in pixel) for row in pixels)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(raw, 9))
            + chunk(b"IEND", b""))


def main():
    default = Path(__file__).resolve().parent.parent / "maps/tutorial/labels.png"
    out = Path(sys.argv[1]) if len(sys.argv) > 1 else default
    out.write_bytes(png(paint()))
    print(out)


if __name__ == "__main__":
    main()
