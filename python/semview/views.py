# SPDX-License-Identifier: Apache-2.0
"""Views as numpy arrays: what docs/protocol.md says of runs, packed runs and planes."""
from dataclasses import dataclass
from typing import Optional

import numpy as np


@dataclass
class View:
    """labels: uint8 class ids, rows × columns. 0 = the ray met no surface: it left the building, or
    there is no ceiling. None = there is no view: outside the building, more than 0.5 m from where an
    eye can be (exact views are cast from anywhere; docs/conventions.md#view-of-a-cell).
    ranges_m: float32 of the same shape (pinholes: depth), +inf where labels are 0; None unless asked.
    """

    labels: Optional[np.ndarray]
    ranges_m: Optional[np.ndarray] = None


def _expand_packed_runs(packed, planes, rows, columns):
    """docs/protocol.md#packed-runs; a column without runs of its own is the one before.

    Returns labels and, if there are planes, a and b of each pixel (else None)."""
    number = np.dtype("u1" if rows <= 255 else "<u2")
    counts = np.frombuffer(packed, number, columns).astype(np.int64)
    runs = int(counts.sum())
    ends = np.frombuffer(packed, number, runs, columns * number.itemsize).astype(np.int64)
    labels = np.frombuffer(packed, np.uint8, runs, (columns + runs) * number.itemsize)
    starts = np.r_[0, ends[:-1]] % rows
    own_column = np.cumsum(counts > 0) - 1

    def pixels(of_runs):
        return np.ascontiguousarray(
            np.repeat(of_runs, ends - starts).reshape(-1, rows)[own_column].T
        )

    return pixels(labels), _pixels_of_planes(planes, pixels)


def _pixels_of_planes(planes, pixels):
    if not planes:
        return None
    a, b = np.frombuffer(planes, "<f4").reshape(-1, 2).T
    return pixels(a), pixels(b)


def _ranges_of_planes(planes, elevation_min_rad, elevation_max_rad):
    """docs/protocol.md#planes: 1/range = a cos e + b sin e."""
    a, b = planes
    rows = a.shape[0]
    step = (elevation_max_rad - elevation_min_rad) / rows
    elevation = (elevation_max_rad - (np.arange(rows) + 0.5) * step)[:, np.newaxis]
    inverse = a * np.cos(elevation) + b * np.sin(elevation)
    with np.errstate(divide="ignore"):
        return np.where(inverse > 0.0, 1.0 / inverse, np.inf).astype(np.float32)


def _expand_runs(runs, rows, columns):
    """Runs stand column by column: repeating each label by its run's length gives the transpose."""
    ends = np.fromiter(runs.end_rows, np.int64, len(runs.end_rows))
    starts = np.empty_like(ends)
    starts[1:] = ends[:-1]
    starts[:1] = 0
    starts[starts == rows] = 0

    def pixels(of_runs):
        return np.ascontiguousarray(np.repeat(of_runs, ends - starts).reshape(columns, rows).T)

    labels = pixels(np.frombuffer(runs.labels, np.uint8))
    return labels, _pixels_of_planes(runs.planes, pixels)


def view_of(wire, rows, columns, elevation_rad=None):
    """`elevation_rad`: lowest and highest, of panoramas that may come as planes."""
    if wire.no_view:
        return View(None)
    planes = None
    if wire.runs.packed:
        labels, planes = _expand_packed_runs(wire.runs.packed, wire.runs.planes, rows, columns)
    elif wire.HasField("runs"):
        labels, planes = _expand_runs(wire.runs, rows, columns)
    else:
        labels = np.frombuffer(wire.labels, np.uint8).reshape(rows, columns)
    ranges = None
    if planes is not None:
        ranges = _ranges_of_planes(planes, *elevation_rad)
    elif wire.ranges_m:
        ranges = np.fromiter(wire.ranges_m, np.float32, rows * columns).reshape(rows, columns)
    return View(labels, ranges)
