# SPDX-License-Identifier: Apache-2.0
"""A client of semview-server in plain pyzmq, protobuf and numpy.

    import semview

    server = semview.connect("tcp://127.0.0.1:5560")
    flat = server.map("duplex_level1")
    view = flat.views([(3.0, -5.0, 0.0)])[0]      # labels as an array, rows × columns
    names = flat.class_name(view.labels[45, 180])

Metres, radians, frame `map`; panoramas as in docs/conventions.md#panorama. Every failure is a
SemviewError whose `code` is gRPC's name of it.
"""
from .client import (
    MODELS,
    NO_VIEW,
    UNKNOWN,
    HeatMap,
    Job,
    Map,
    Observation,
    Scores,
    Server,
    View,
    connect,
)
from .connection import SemviewError

__all__ = [
    "MODELS",
    "NO_VIEW",
    "UNKNOWN",
    "HeatMap",
    "Job",
    "Map",
    "Observation",
    "Scores",
    "SemviewError",
    "Server",
    "View",
    "connect",
]
