# SPDX-License-Identifier: Apache-2.0
"""Maps, views, scores and jobs as Python objects and numpy arrays."""
import time
from dataclasses import dataclass
from typing import List, Optional

import numpy as np

from .connection import Connection, SemviewError
from .v1 import envelope_pb2, jobs_pb2, maps_pb2, scores_pb2, views_pb2
from .views import View, view_of

NO_VIEW = -(2**31)  # the sum of a pose that has no view
UNKNOWN = 255  # in observations: not seen or undecided, never scored
HEADINGS = 120
MODELS = ("views", "sdf", "sem", "sdf_sem")  # views of labels; distances of depth
AFFINE_STEP = 0.02  # of ln a, ln b and k: how finely distortions of a map are told apart


def connect(
    endpoint="tcp://127.0.0.1:5560", timeout_s=30.0, client_name="python", connect_timeout_s=5.0
):
    """A Server; raises SemviewError if none answers within `connect_timeout_s`.

    timeout_s is how long later calls may take, which can be long work.
    """
    server = Server(Connection(endpoint, timeout_s, client_name))
    try:
        server.hello(min(connect_timeout_s, timeout_s))
    except SemviewError:
        server.close()
        raise
    return server


@dataclass
class Scores:
    """sums: int32, one a pose, or NO_VIEW. similarity: float64, NaN where there is no view.
    best_yaw_rad: compass only. curve: similarity of all 120 headings, compass with `curve`."""

    sums: np.ndarray
    similarity: np.ndarray
    best_yaw_rad: Optional[np.ndarray]
    curve: Optional[np.ndarray]
    origins: dict


@dataclass
class HeatMap:
    """similarity: float32, row 0 = lowest y, NaN = not free. Cell (row 0, column 0) has its
    lower left corner at (x_m, y_m); cells are `step_m` apart."""

    similarity: np.ndarray
    best_yaw_rad: np.ndarray
    x_m: float
    y_m: float
    step_m: float = 0.1
    probability: Optional[np.ndarray] = None  # as similarity; 1 over all cells; if asked for

    def best(self):
        """(x, y, yaw) at the centre of the cell of the highest probability, where probabilities were
        asked for, else of the highest similarity."""
        values = self.similarity if self.probability is None else self.probability
        row, column = np.unravel_index(np.nanargmax(values), values.shape)
        return (
            self.x_m + (column + 0.5) * self.step_m,
            self.y_m + (row + 0.5) * self.step_m,
            float(self.best_yaw_rad[row, column]),
        )


def _poses(poses):
    """Packed lists of an (n, 3) array of x, y, yaw."""
    array = np.asarray(poses, dtype=np.float64)
    if array.size == 0:
        raise ValueError("no poses; expected at least one of x, y, yaw")
    array = np.atleast_2d(array)
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"poses of shape {array.shape}; expected (n, 3): x, y, yaw")
    return views_pb2.Poses(x_m=array[:, 0], y_m=array[:, 1], yaw_rad=array[:, 2])


def _affine_steps(affines, poses):
    """Packed lists of an (n, 3) array of a, b, k."""
    array = np.atleast_2d(np.asarray(affines, dtype=np.float64))
    if array.shape != (poses, 3):
        raise ValueError(f"affines of shape {array.shape}; expected ({poses}, 3): a, b, k")
    scales = array[:, :2]
    if not (np.all(scales >= 0.2) and np.all(scales <= 5.0) and np.all(np.abs(array[:, 2]) <= 2.0)):
        raise ValueError("an affine is out of range; expected a and b of 0.2 to 5, k of -2 to 2")
    a, b = np.clip(np.rint(np.log(scales) / AFFINE_STEP), -80, 80).astype(int).T
    k = np.rint(array[:, 2] / AFFINE_STEP).astype(int)
    return scores_pb2.AffineSteps(a=a, b=b, k=k)


def _labels(labels, classes):
    """Class ids as uint8; what numpy would turn into another id without a word is refused."""
    array = np.asarray(labels)
    if array.dtype.kind not in "iu":
        raise ValueError(f"labels of type {array.dtype}; expected integers, class ids")
    known = (array >= 0) & (array <= len(classes)) | (array == UNKNOWN)
    if not known.all():
        row, column = np.argwhere(~known)[0]
        raise ValueError(
            f"label {array[row, column]} at row {row}, column {column}; expected 0, an id of the "
            f"{len(classes)} classes (1 to {len(classes)}), or {UNKNOWN} for unknown"
        )
    return np.ascontiguousarray(array, dtype=np.uint8)


def _similarity(sums, scale, pixels):
    similarity = sums / (float(scale) * float(pixels))
    similarity[sums == NO_VIEW] = np.nan
    return similarity


class Server:
    """A running semview-server."""

    def __init__(self, connection):
        self.connection = connection

    def hello(self, timeout_s=None):
        """Version, methods and limits, as the message HelloReply."""
        return self.connection.call(
            "Hello", envelope_pb2.HelloRequest(), envelope_pb2.HelloReply, timeout_s
        )

    def maps(self) -> List[str]:
        """The ids of the maps."""
        reply = self.connection.call(
            "ListMaps", maps_pb2.ListMapsRequest(), maps_pb2.ListMapsReply
        )
        return [entry.id for entry in reply.maps]

    def map(self, map_id) -> "Map":
        return Map(self.connection, map_id)

    def stats(self):
        """Counts since the server's start, as the message GetStatsReply: its `memory` and `disk` tell
        of the tiers of the view cache, damaged records and whether it still stores among them; its
        `latency_by_method["Score"].p99_ms` and the like of how long requests took."""
        return self.connection.call("GetStats", jobs_pb2.GetStatsRequest(), jobs_pb2.GetStatsReply)

    def close(self):
        self.connection.close()


class Map:
    """One map of a server.

    id, name, fingerprint (hex), classes (names, the first has id 1), rows and columns of a view,
    elevation_min_rad, elevation_max_rad, eye_height_m, ranges (views of cells have them), engine and engine_reason (what casts and why), free_cells: (n, 2) int32 of ix, iy.
    """

    def __init__(self, connection, map_id):
        self._connection = connection
        reply = connection.call("GetMap", maps_pb2.GetMapRequest(map_id=map_id), maps_pb2.GetMapReply)
        self._fingerprint = reply.summary.fingerprint
        self.id = reply.summary.id
        self.name = reply.summary.name
        self.fingerprint = reply.summary.fingerprint.hex()
        self.classes = [entry.name for entry in reply.classes]
        self.colors = [tuple(entry.color_rgb) or None for entry in reply.classes]
        self.rows = reply.profile.rows
        self.columns = reply.profile.columns
        self.elevation_min_rad = reply.profile.elevation_min_rad
        self.elevation_max_rad = reply.profile.elevation_max_rad
        self.eye_height_m = reply.profile.eye_height_m
        self.ranges = reply.profile.ranges
        self.ground_height_m = reply.ground_height_m
        self.engine = reply.engine
        self.engine_reason = reply.engine_reason
        runs = reply.free_cells
        self.free_cells = np.array(
            [
                (ix + k, iy)
                for iy, ix, length in zip(runs.iy, runs.ix, runs.length)
                for k in range(length)
            ],
            dtype=np.int32,
        ).reshape(-1, 2)

    def class_name(self, class_id):
        """The name of an id of a view's labels; "none" for 0, "unknown" for ids of no class."""
        if not 0 <= class_id <= 255:
            raise ValueError(f"class id {class_id}; expected 0 to 255")
        if class_id == 0:
            return "none"
        return self.classes[class_id - 1] if class_id <= len(self.classes) else "unknown"

    def glb(self) -> bytes:
        """The map's mesh as binary glTF."""
        request = maps_pb2.GetMapRequest(map_id=self.id, with_glb=True)
        return self._connection.call("GetMap", request, maps_pb2.GetMapReply).glb

    def views(self, poses, exact=False, ranges=False) -> List[View]:
        """The panorama at each pose (x, y, yaw); no poses, no views.

        exact   cast at the pose itself; otherwise the stored view of its 10 cm cell, turned to
                its heading on the 3° grid
        ranges  also metres along each ray; implies `exact` unless the server keeps ranges
        """
        if len(poses) == 0:
            return []
        request = views_pb2.GetViewsRequest(map_id=self.id, fingerprint=self._fingerprint)
        if exact or (ranges and not self.ranges):
            request.panoramas.poses.CopyFrom(_poses(poses))
        else:
            request.poses.CopyFrom(_poses(poses))
        return self._views(request, ranges)

    def pinhole_views(
        self, poses, columns, rows, fx_px, fy_px, cx_px, cy_px, eye_height_m=0.0, depths=False
    ) -> List[View]:
        """What a level pinhole camera sees at each pose, looking along its yaw."""
        if len(poses) == 0:
            return []
        request = views_pb2.GetViewsRequest(map_id=self.id, fingerprint=self._fingerprint)
        request.pinholes.CopyFrom(
            views_pb2.ExactPinholes(
                poses=_poses(poses),
                columns=columns,
                rows=rows,
                fx_px=fx_px,
                fy_px=fy_px,
                cx_px=cx_px,
                cy_px=cy_px,
                eye_height_m=eye_height_m,
            )
        )
        return self._views(request, depths)

    def _views(self, request, ranges):
        request.with_ranges = ranges
        request.packed_runs = True
        reply = self._connection.call("GetViews", request, views_pb2.GetViewsReply)
        elevation_rad = (self.elevation_min_rad, self.elevation_max_rad)
        return [view_of(view, reply.rows, reply.columns, elevation_rad) for view in reply.views]

    def set_observation(self, labels, classes=None, weights_csv="") -> "Observation":
        """What a camera saw, to score poses against.

        labels       (rows, columns) integers, ids of `classes`; UNKNOWN and 0 are not scored
        classes      the observer's class names, the first has id 1; None: the map's own
        weights_csv  a weight matrix (docs/formats/weights.md); "" gives 1 for equal names, else 0
        """
        if np.shape(labels) != (self.rows, self.columns):
            raise ValueError(
                f"labels of shape {np.shape(labels)}; expected {(self.rows, self.columns)}"
            )
        classes = self.classes if classes is None else classes
        request = scores_pb2.SetObservationRequest(
            class_names=classes,
            rows=self.rows,
            columns=self.columns,
            labels=_labels(labels, classes).tobytes(),
            weights_csv=weights_csv,
        )
        return Observation(self, request, "views")

    def set_depth(
        self,
        depth_m,
        focal_px,
        center_px,
        base_from_camera,
        labels=None,
        classes=None,
        voxel_m=0.05,
        max_depth_m=5.0,
    ) -> "Observation":
        """What a depth camera saw, to score poses against.

        depth_m           (rows, columns), along the optical axis; 0 or not finite = not measured
        focal_px          (fx, fy)
        center_px         (cx, cy); pixel (row r, column c) has its centre at (c + 0.5, r + 0.5)
        base_from_camera  4 x 4: from the camera (x right, y down, z forward) to the robot (x forward,
                          y left, z up from the ground)
        labels            (rows, columns) integers, ids of `classes`; None: all unknown
        """
        depth_mm = np.nan_to_num(np.asarray(depth_m, dtype=np.float64) * 1000.0, posinf=0.0)
        if depth_mm.ndim != 2:
            raise ValueError(f"depth of shape {depth_mm.shape}; expected (rows, columns)")
        depth_mm = np.where((depth_mm < 0.0) | (depth_mm > 65535.0), 0.0, np.rint(depth_mm))
        mounting = np.asarray(base_from_camera, dtype=np.float64)
        if mounting.shape != (4, 4):
            raise ValueError(f"base_from_camera of shape {mounting.shape}; expected (4, 4)")
        classes = self.classes if classes is None else classes
        if labels is not None and np.shape(labels) != depth_mm.shape:
            raise ValueError(f"labels of shape {np.shape(labels)}; expected {depth_mm.shape}")
        image = scores_pb2.DepthImage(
            rows=depth_mm.shape[0],
            columns=depth_mm.shape[1],
            depth_mm=depth_mm.astype("<u2").tobytes(),
            labels=b"" if labels is None else _labels(labels, classes).tobytes(),
            fx_px=focal_px[0],
            fy_px=focal_px[1],
            cx_px=center_px[0],
            cy_px=center_px[1],
            base_from_camera=mounting[:3].ravel(),
            voxel_m=voxel_m,
            max_depth_m=max_depth_m,
        )
        request = scores_pb2.SetObservationRequest(class_names=classes, depth=image)
        return Observation(self, request, "sdf_sem")

    def precompute(self, region=None, reachable_from=None) -> "Job":
        """Starts to cast and store the views of all free cells, or of a part.

        region          (x_min, y_min, x_max, y_max)
        reachable_from  (x, y)
        """
        request = jobs_pb2.StartPrecomputeRequest(map_id=self.id, fingerprint=self._fingerprint)
        if region is not None:
            x_min, y_min, x_max, y_max = region
            request.region.CopyFrom(
                scores_pb2.Region(x_min_m=x_min, y_min_m=y_min, x_max_m=x_max, y_max_m=y_max)
            )
        if reachable_from is not None:
            request.reachable_from.x_m, request.reachable_from.y_m = reachable_from
        reply = self._connection.call(
            "StartPrecompute", request, jobs_pb2.StartPrecomputeReply
        )
        return Job(self._connection, reply.job_id)


class Observation:
    """An observation that the server holds; sent again by itself when the server has lost it."""

    def __init__(self, of_map, request, model):
        self._map = of_map
        self._model = model  # unless a call names another
        self._request = request
        self._request.map_id = of_map.id
        self._request.fingerprint = of_map._fingerprint
        self._send()

    def _send(self):
        reply = self._map._connection.call(
            "SetObservation", self._request, scores_pb2.SetObservationReply
        )
        self._id = reply.observation_id
        self.observed_pixels = reply.observed_pixels
        self.observed_voxels = reply.observed_voxels

    def _of_model(self, model):
        model = self._model if model is None else model
        if model not in MODELS:
            raise ValueError(f"model {model!r}; expected one of {', '.join(MODELS)}")
        return scores_pb2.Model.Value(f"MODEL_{model.upper()}")

    def _call(self, method, request, reply_type, timeout_s=None):
        request.map_id = self._map.id
        request.fingerprint = self._map._fingerprint
        request.observation_id = self._id
        try:
            return self._map._connection.call(method, request, reply_type, timeout_s)
        except SemviewError as error:
            if error.code != "NOT_FOUND" or error.field != "observation_id":
                raise
        self._send()
        request.observation_id = self._id
        return self._map._connection.call(method, request, reply_type, timeout_s)

    def score(self, poses, compass=False, curve=False, affines=None, model=None) -> Scores:
        """The similarity at each pose (x, y, yaw); `compass` tries all 120 headings.

        model    one of MODELS; None: "views" of labels, "sdf_sem" of depth, whose similarity is the
                 mean over pixels of the logarithm of the likelihood
        affines  (n, 3) of a, b, k, one a pose: score as if the plan were drawn distorted by
                 [[a, 0], [k, b]], taken to the nearest step of 0.02
        """
        mode = scores_pb2.HEADING_MODE_COMPASS if compass else scores_pb2.HEADING_MODE_AS_GIVEN
        request = scores_pb2.ScoreRequest(
            poses=_poses(poses), mode=mode, whole_curve=curve, model=self._of_model(model)
        )
        if affines is not None:
            request.affines.CopyFrom(_affine_steps(affines, len(request.poses.x_m)))
        reply = self._call("Score", request, scores_pb2.ScoreReply)
        sums = np.array(reply.sums, dtype=np.int32)
        scale = (reply.weight_scale, reply.observed_pixels)
        headings = np.frombuffer(reply.best_headings, np.uint8)
        return Scores(
            sums=sums,
            similarity=_similarity(sums, *scale),
            best_yaw_rad=np.deg2rad(headings * 3.0) if compass else None,
            curve=_similarity(np.array(reply.curve, dtype=np.int32), *scale).reshape(-1, HEADINGS)
            if curve
            else None,
            origins={name: getattr(reply.origins, name) for name in ("memory", "disk", "cast")},
        )

    def heat_map(
        self,
        region=None,
        headings=HEADINGS,
        timeout_s=600.0,
        posterior=False,
        power=None,
        kappa=None,
        model=None,
    ) -> HeatMap:
        """The best similarity of each free cell of the map, or of a region.

        posterior     also the probability of each of these cells, whatever the heading, with the
                      weights that a filter gives
        power, kappa  one of them: weight = max(similarity, 0) ** power, or exp(kappa * similarity);
                      none: the filter's default
        model         as of `score`; of depth there is only kappa
        """
        request = scores_pb2.HeatmapRequest(headings=headings, model=self._of_model(model))
        if (power is not None or kappa is not None) and not posterior:
            raise ValueError("power and kappa are weights of a posterior; expected posterior=True")
        if power is not None and kappa is not None:
            raise ValueError("both power and kappa; expected one of them")
        if posterior:
            request.posterior.CopyFrom(scores_pb2.Weighting(power=power, kappa=kappa))
        if region is not None:
            x_min, y_min, x_max, y_max = region
            request.region.CopyFrom(
                scores_pb2.Region(x_min_m=x_min, y_min_m=y_min, x_max_m=x_max, y_max_m=y_max)
            )
        reply = self._call("Heatmap", request, scores_pb2.HeatmapReply, timeout_s)
        shape = (reply.rows, reply.columns)
        best = np.frombuffer(reply.best_headings, np.uint8).reshape(shape)
        return HeatMap(
            similarity=np.array(reply.similarity, dtype=np.float32).reshape(shape),
            best_yaw_rad=np.where(best == 255, np.nan, np.deg2rad(best * 3.0)),
            x_m=reply.origin_ix * 0.1,
            y_m=reply.origin_iy * 0.1,
            probability=np.array(reply.probability, dtype=np.float32).reshape(shape)
            if posterior
            else None,
        )


class Job:
    """A long job of the server."""

    def __init__(self, connection, job_id):
        self._connection = connection
        self.id = job_id

    def status(self):
        """How far it is, as the message JobStatusReply."""
        request = jobs_pb2.JobStatusRequest(job_id=self.id)
        return self._connection.call("JobStatus", request, jobs_pb2.JobStatusReply)

    def progress(self, interval_s=0.2):
        """Yields statuses until the job has ended, the last one included; raises if it failed."""
        while True:
            status = self.status()
            yield status
            if status.state == jobs_pb2.JOB_STATE_FAILED:
                raise SemviewError("ABORTED", status.error.message, hint=status.error.hint)
            if status.state in (jobs_pb2.JOB_STATE_DONE, jobs_pb2.JOB_STATE_CANCELLED):
                return
            time.sleep(interval_s)

    def cancel(self):
        request = jobs_pb2.CancelJobRequest(job_id=self.id)
        self._connection.call("CancelJob", request, jobs_pb2.CancelJobReply)
