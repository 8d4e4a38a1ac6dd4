# SPDX-License-Identifier: Apache-2.0
"""Asks the server at argv[1] for a view of the duplex and looks whether it is one."""
import sys

import numpy as np

import semview

server = semview.connect(sys.argv[1])
duplex = server.map("duplex_level1")
labels = duplex.views([(2.35, -3.05, 0.0)])[0].labels
assert labels.shape == (90, 360), labels.shape
seen = {duplex.class_name(label) for label in np.unique(labels)}
assert {"wall", "floor", "ceiling", "door"} <= seen, seen
print(f"a view of {labels.shape[1]} x {labels.shape[0]} pixels with {', '.join(sorted(seen))}")
