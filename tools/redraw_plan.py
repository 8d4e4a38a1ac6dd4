#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Redraws a map's plan as somebody with a mouse would, from its rooms: a sketch to localize on.

usage: redraw_plan.py MAP ROOMS.csv SEED OUT

MAP is a drawn map folder, ROOMS.csv its rooms (docs/localization.md, "On a sketch"). OUT becomes a
map folder with rooms.csv beside it. Strips between the borders of rooms, across the whole plan, are
stretched by a factor of 0.7 to 1.4 each, along x and along y; strips thinner than 0.6 m, which are
walls, stay as they are. Of the walls between rooms one in ten is not drawn, the others are 0.3 to
0.8 m too long or too short at one end. A third of the furniture is missing or drawn as another kind.
"""
import csv
import random
import re
import shutil
import struct
import sys
import zlib
from pathlib import Path

WALL_M = 0.6  # strips up to this width are walls
DOOR_M = 0.06  # how far doors stand out of their walls
FACTORS = (0.7, 1.4)
ENDS_M = (0.3, 0.8)
MISSING_WALLS = 0.1
MISSING_FURNITURE = SWAPPED_FURNITURE = 1 / 6
FIXED = {"floor", "wall", "door", "window", "windowpane", "stairs", "railing", "ceiling"}


def read_png(path):
    """Rows of (r, g, b) of an 8-bit RGB picture that is not interlaced."""
    data = path.read_bytes()
    width, height, depth, kind, _, _, interlaced = struct.unpack(">IIBBBBB", data[16:29])
    if (depth, kind, interlaced) != (8, 2, 0):
        sys.exit(f"{path}: expected 8-bit RGB, not interlaced")
    packed, at = b"", 8
    while at < len(data):
        (length,) = struct.unpack(">I", data[at:at + 4])
        if data[at + 4:at + 8] == b"IDAT":
            packed += data[at + 8:at + 8 + length]
        at += 12 + length
    raw, stride = zlib.decompress(packed), 3 * width
    before, rows = bytearray(stride), []
    for y in range(height):
        method = raw[y * (stride + 1)]
        line = bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride):
            left = line[i - 3] if i >= 3 else 0
            up, corner = before[i], before[i - 3] if i >= 3 else 0
            if method == 1:
                guess = left
            elif method == 2:
                guess = up
            elif method == 3:
                guess = (left + up) // 2
            elif method == 4:
                guess = min((left, up, corner), key=lambda one: abs(left + up - corner - one))
            else:
                break
            line[i] = (line[i] + guess) & 255
        rows.append([tuple(line[3 * x:3 * x + 3]) for x in range(width)])
        before = line
    return rows


def write_png(path, rows):
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    raw = b"".join(b"\0" + bytes(value for pixel in row for value in pixel) for row in rows)
    head = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) +
                     chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b""))


class Strips:
    """One axis in pixels, cut at the borders of rooms and stretched piece by piece."""

    def __init__(self, borders, length, resolution_m, rng):
        self.knots = [0.0] + sorted({b for b in borders if 0.0 < b < length}) + [float(length)]
        self.moved = [0.0]
        outside = {0, len(self.knots) - 2}
        for i, (low, high) in enumerate(zip(self.knots, self.knots[1:])):
            wide = (high - low) * resolution_m > WALL_M and i not in outside
            self.moved.append(self.moved[-1] + (high - low) * (rng.uniform(*FACTORS) if wide else 1.0))

    @staticmethod
    def _along(value, start, end):
        for i in range(len(start) - 1):
            if value <= start[i + 1] or i == len(start) - 2:
                return end[i] + (value - start[i]) / (start[i + 1] - start[i]) * (end[i + 1] - end[i])
        raise AssertionError

    def forth(self, value):
        return self._along(value, self.knots, self.moved)

    def back(self, value):
        return self._along(value, self.moved, self.knots)


def classes_of(yaml):
    """Colours by name."""
    found = re.findall(r"name:\s*([^,}]+),\s*color:\s*\[(\d+),\s*(\d+),\s*(\d+)\]", yaml)
    return {name.strip(): tuple(map(int, color)) for name, *color in found}


def redraw_walls(rows, rooms, colors, resolution_m, rng):
    """Walls between two rooms side by side; `rooms` in pixels, (left, top, right, bottom)."""
    solid = {colors[name] for name in ("wall", "door") if name in colors}

    def fill(box, color, only):
        for y in range(max(0, box[1]), min(len(rows), box[3])):
            for x in range(max(0, box[0]), min(len(rows[0]), box[2])):
                if rows[y][x] in only:
                    rows[y][x] = color

    for along_y in (True, False):
        for one in rooms:
            for other in rooms:
                # (gap low, gap high) across the wall, (low, high) along it.
                a, b = (0, 1) if along_y else (1, 0)
                across = (one[a + 2], other[a])
                along = (max(one[b], other[b]), min(one[b + 2], other[b + 2]))
                gap_m = (across[1] - across[0]) * resolution_m
                if not 0.05 < gap_m <= WALL_M or (along[1] - along[0]) * resolution_m < 1.0:
                    continue
                middle = (across[0] + across[1]) // 2
                line = [rows[i][middle] if along_y else rows[middle][i] for i in range(*along)]
                if sum(pixel in solid for pixel in line) * 2 < len(line):
                    continue  # no wall there

                def box(low, high, more=0):
                    first, last = across[0] - more, across[1] + more
                    return (first, low, last, high) if along_y else (low, first, high, last)

                more = round(DOOR_M / resolution_m)
                off = round(rng.uniform(*ENDS_M) / resolution_m)
                at_end, longer = rng.random() < 0.5, rng.random() < 0.5
                if rng.random() < MISSING_WALLS:
                    fill(box(*along, more), colors["floor"], solid)
                elif longer:
                    end = box(along[1], along[1] + off) if at_end else box(along[0] - off, along[0])
                    fill(end, colors["wall"], {colors["floor"]})
                else:
                    end = (box(along[1] - off, along[1], more) if at_end
                           else box(along[0], along[0] + off, more))
                    fill(end, colors["floor"], solid)


def redraw_furniture(rows, colors, rng):
    kinds = {color: name for name, color in colors.items() if name not in FIXED}
    done = set()
    for y, row in enumerate(rows):
        for x, color in enumerate(row):
            if color not in kinds or (y, x) in done:
                continue
            piece, todo = [], [(y, x)]
            done.add((y, x))
            while todo:
                v, u = todo.pop()
                piece.append((v, u))
                for step in ((v + 1, u), (v - 1, u), (v, u + 1), (v, u - 1)):
                    inside = 0 <= step[0] < len(rows) and 0 <= step[1] < len(row)
                    if inside and step not in done and rows[step[0]][step[1]] == color:
                        done.add(step)
                        todo.append(step)
            draw = rng.random()
            others = sorted(one for one in kinds if one != color)
            other = rng.choice(others) if others else colors["floor"]
            if draw < MISSING_FURNITURE + SWAPPED_FURNITURE:
                for v, u in piece:
                    rows[v][u] = colors["floor"] if draw < MISSING_FURNITURE else other
    return rows


def main(map_folder, rooms_csv, seed, out):
    rng = random.Random(f"sketch {seed}")
    yaml = (map_folder / "map.yaml").read_text()
    resolution_m = float(re.search(r"^resolution:\s*(\S+)", yaml, re.M).group(1))
    left_m, bottom_m = map(float, re.search(r"^origin:\s*\[([^,]+),\s*([^,]+)", yaml, re.M).groups())
    rows = read_png(map_folder / re.search(r"^  labels:\s*(\S+)", yaml, re.M).group(1))
    height = len(rows)
    lines = [line for line in rooms_csv.read_text().splitlines() if line and line[0] != "#"]
    names, rooms = [], []
    for line in csv.DictReader(lines):
        box = [float(line[key]) for key in ("min_x_m", "max_y_m", "max_x_m", "min_y_m")]
        names.append(line["room"])
        rooms.append([(box[0] - left_m) / resolution_m, height - (box[1] - bottom_m) / resolution_m,
                      (box[2] - left_m) / resolution_m, height - (box[3] - bottom_m) / resolution_m])
    strips_x = Strips([room[i] for room in rooms for i in (0, 2)], len(rows[0]), resolution_m, rng)
    strips_y = Strips([room[i] for room in rooms for i in (1, 3)], height, resolution_m, rng)
    columns = [min(int(strips_x.back(x + 0.5)), len(rows[0]) - 1)
               for x in range(int(strips_x.moved[-1]))]
    drawn = [[rows[min(int(strips_y.back(y + 0.5)), height - 1)][x] for x in columns]
             for y in range(int(strips_y.moved[-1]))]
    moved = [(strips_x.forth(room[0]), strips_y.forth(room[1]),
              strips_x.forth(room[2]), strips_y.forth(room[3])) for room in rooms]
    colors = classes_of(yaml)
    redraw_walls(drawn, [tuple(map(round, room)) for room in moved], colors, resolution_m, rng)
    redraw_furniture(drawn, colors, rng)

    out.mkdir(parents=True, exist_ok=True)
    write_png(out / "labels.png", drawn)
    yaml = re.sub(r"^  labels:.*", "  labels: labels.png", yaml, flags=re.M)
    yaml = re.sub(r"^  name:.*", lambda name: name.group(0) + " (sketch)", yaml, flags=re.M)
    (out / "map.yaml").write_text(yaml)
    for beside in ("weights.csv", "ATTRIBUTION.md"):
        if (map_folder / beside).exists():
            shutil.copy(map_folder / beside, out / beside)
    with (out / "rooms.csv").open("w") as file:
        file.write("room,min_x_m,min_y_m,max_x_m,max_y_m\n")
        for name, (low_x, low_y, high_x, high_y) in zip(names, moved):
            file.write(f"{name},{left_m + low_x * resolution_m:.3f},"
                       f"{bottom_m + (len(drawn) - high_y) * resolution_m:.3f},"
                       f"{left_m + high_x * resolution_m:.3f},"
                       f"{bottom_m + (len(drawn) - low_y) * resolution_m:.3f}\n")


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    main(Path(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3]), Path(sys.argv[4]))
