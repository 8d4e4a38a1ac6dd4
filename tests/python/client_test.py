# SPDX-License-Identifier: Apache-2.0
"""python/semview, and the raw examples of the documentation, against the real server process.

Needs in the environment: PYTHONPATH (build/<preset>/python), SEMVIEW_SERVER, SEMVIEW_SOURCE_DIR,
SEMVIEW_PROTOC.
"""
import contextlib
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np

import semview
from semview import views
from semview.v1 import views_pb2

SOURCE = Path(os.environ["SEMVIEW_SOURCE_DIR"])
MAP = "duplex_level1"


class RunningServer:
    """semview-server on a free port, with a cache directory of its own."""

    def __init__(self, *arguments):
        self.folder = tempfile.TemporaryDirectory()
        self.arguments = arguments
        self.endpoint = "tcp://127.0.0.1:*"
        self.start()

    def start(self):
        self.process = subprocess.Popen(
            [
                os.environ["SEMVIEW_SERVER"],
                "--map",
                str(SOURCE / "maps" / MAP),
                "--bind",
                self.endpoint,
                "--cache",
                self.folder.name,
                *self.arguments,
            ],
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
        line = self.process.stdout.readline()
        assert line.startswith("listening on "), line
        self.endpoint = line.split()[-1]

    def stop(self):
        self.process.send_signal(signal.SIGTERM)
        code = self.process.wait(timeout=60)
        self.process.stdout.close()
        return code

    def close(self):
        code = self.stop()
        self.folder.cleanup()
        return code


class ClientTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.running = RunningServer()
        cls.server = semview.connect(cls.running.endpoint, timeout_s=60)
        cls.map = cls.server.map(MAP)
        # A free cell somewhere in the middle of the list, and its centre.
        ix, iy = cls.map.free_cells[len(cls.map.free_cells) // 2]
        cls.pose = ((ix + 0.5) * 0.1, (iy + 0.5) * 0.1, 0.0)

    @classmethod
    def tearDownClass(cls):
        cls.server.close()
        assert cls.running.close() == 0

    def region(self, reach=0.3):
        x, y, _ = self.pose
        return (x - reach, y - reach, x + reach, y + reach)

    def test_maps_are_listed_and_described(self):
        self.assertEqual(self.server.maps(), [MAP])
        self.assertIn("wall", self.map.classes)
        self.assertEqual(self.map.class_name(self.map.classes.index("wall") + 1), "wall")
        self.assertEqual((self.map.rows, self.map.columns), (90, 360))
        self.assertEqual(len(self.map.fingerprint), 32)
        self.assertEqual(self.map.glb()[:4], b"glTF")

    def test_grid_and_exact_views_agree_at_a_cells_centre(self):
        (grid,) = self.map.views([self.pose])
        (exact,) = self.map.views([self.pose], ranges=True)
        self.assertEqual(grid.labels.shape, (90, 360))
        self.assertEqual(grid.labels.dtype, np.uint8)
        np.testing.assert_array_equal(grid.labels, exact.labels)
        self.assertEqual(exact.ranges_m.dtype, np.float32)
        self.assertTrue((exact.ranges_m[exact.labels > 0] < 100.0).all())

    def test_a_heading_is_a_shift_of_columns(self):
        x, y, _ = self.pose
        ahead, left = self.map.views([(x, y, 0.0), (x, y, np.pi / 2)])
        np.testing.assert_array_equal(left.labels, np.roll(ahead.labels, 90, axis=1))

    def test_views_are_the_same_in_every_encoding(self):
        (view,) = self.map.views([self.pose])
        request = views_pb2.GetViewsRequest(map_id=MAP)
        for field, number in zip(("x_m", "y_m", "yaw_rad"), self.pose):
            getattr(request.poses, field).append(number)
        for encoding in (views_pb2.VIEW_ENCODING_RUNS, views_pb2.VIEW_ENCODING_PIXELS):
            request.encoding = encoding
            reply = self.server.connection.call("GetViews", request, views_pb2.GetViewsReply)
            self.assertEqual(reply.views[0].runs.packed, b"")
            labels = views.view_of(reply.views[0], reply.rows, reply.columns).labels
            np.testing.assert_array_equal(labels, view.labels)

    def test_planes_become_ranges(self):
        wire = views_pb2.View()
        wire.runs.runs_in_column.extend([2, 1])
        wire.runs.end_rows.extend([1, 3, 3])
        wire.runs.labels = bytes([2, 1, 0])
        wire.runs.planes = np.array([0.5, 0, 0, -0.8, 0, 0], "<f4").tobytes()
        view = views.view_of(wire, 3, 2, (-0.6, 0.6))
        np.testing.assert_array_equal(view.labels, [[2, 0], [1, 0], [1, 0]])
        expected = [2.0 / np.cos(0.4), np.inf, 1.25 / np.sin(0.4)]
        np.testing.assert_allclose(view.ranges_m[:, 0], expected, rtol=1e-6)
        self.assertTrue(np.isinf(view.ranges_m[:, 1]).all())
        self.assertEqual(view.ranges_m.dtype, np.float32)

    def test_a_pose_far_away_has_no_view(self):
        (view,) = self.map.views([(500.0, 500.0, 0.0)])
        self.assertIsNone(view.labels)

    def test_a_pinhole_looks_along_the_heading(self):
        (view,) = self.map.pinhole_views([self.pose], 5, 3, 50.0, 50.0, 2.5, 1.5, depths=True)
        self.assertEqual(view.labels.shape, (3, 5))
        (panorama,) = self.map.views([self.pose], ranges=True)
        middle = panorama.ranges_m[44:46, 179:181]
        self.assertGreaterEqual(view.ranges_m[1, 2], middle.min() - 0.05)
        self.assertLessEqual(view.ranges_m[1, 2], middle.max() + 0.05)

    def test_an_observation_scores_best_where_it_was_made(self):
        (view,) = self.map.views([self.pose])
        observation = self.map.set_observation(view.labels)
        self.assertEqual(observation.observed_pixels, int((view.labels > 0).sum()))
        x, y, _ = self.pose
        scores = observation.score([self.pose, (x + 1.0, y, 0.0), (500.0, 500.0, 0.0)])
        self.assertAlmostEqual(scores.similarity[0], 1.0)
        self.assertLess(scores.similarity[1], 1.0)
        self.assertEqual(scores.sums[2], semview.NO_VIEW)
        self.assertTrue(np.isnan(scores.similarity[2]))

    def test_depth_scores_best_where_it_was_seen(self):
        camera = (80, 60, 70.0, 70.0, 40.0, 30.0)
        x, y, yaw = pose = (3.0, -5.0, 0.0)
        (view,) = self.map.pinhole_views([pose], *camera, eye_height_m=1.2, depths=True)
        mounting = np.eye(4)
        mounting[:3, :3] = [[0, 0, 1], [-1, 0, 0], [0, -1, 0]]
        mounting[2, 3] = 1.2
        observation = self.map.set_depth(
            view.ranges_m, camera[2:4], camera[4:], mounting, labels=view.labels
        )
        self.assertGreater(observation.observed_voxels, 50)
        poses = [pose, (x + 0.5, y, yaw), (x, y, yaw + 1.0)]
        for model in (None, "sdf", "sem", "sdf_sem"):
            similarity = observation.score(poses, model=model).similarity
            self.assertGreater(similarity[0], similarity[1])
            self.assertGreater(similarity[0], similarity[2])
            self.assertLessEqual(similarity[0], 0.0)
        region = (x - 0.3, y - 0.3, x + 0.3, y + 0.3)
        heat = observation.heat_map(region, headings=20, model="sem")
        self.assertGreater(np.nanmax(heat.similarity), -0.1)
        with self.assertRaises(semview.SemviewError) as raised:
            observation.score(poses, model="views")
        self.assertEqual(raised.exception.code, "FAILED_PRECONDITION")
        self.assertEqual(raised.exception.field, "model")
        with self.assertRaises(ValueError):
            observation.score(poses, model="sonar")

    def test_labels_that_are_no_ids_of_the_classes_are_refused(self):
        (view,) = self.map.views([self.pose])
        beyond = len(self.map.classes) + 1
        for wrong in (257, 1000, -1, beyond, 254):
            labels = view.labels.astype(np.int64)
            labels[3, 5] = wrong
            with self.assertRaisesRegex(ValueError, f"label {wrong} at row 3, column 5"):
                self.map.set_observation(labels)
        with self.assertRaisesRegex(ValueError, "float64; expected integers"):
            self.map.set_observation(view.labels + 0.5)
        with self.assertRaisesRegex(ValueError, "bool; expected integers"):
            self.map.set_observation(view.labels > 0)
        with self.assertRaisesRegex(ValueError, "label 2 at row"):
            self.map.set_observation(np.full(view.labels.shape, 2), classes=["wall"])
        labels = view.labels.astype(np.int64)
        labels[3, 5] = semview.UNKNOWN
        self.assertGreater(self.map.set_observation(labels).observed_pixels, 0)

    def test_the_score_is_the_share_of_equal_pixels(self):
        """Equation (1) with the identity as weights, written out."""
        x, y, _ = self.pose
        (seen,) = self.map.views([self.pose])
        other = (x + 0.5, y, 0.0)
        (there,) = self.map.views([other])
        observation = self.map.set_observation(seen.labels)
        scored = seen.labels > 0
        expected = (seen.labels[scored] == there.labels[scored]).mean()
        self.assertAlmostEqual(observation.score([other]).similarity[0], expected, places=12)

    def test_the_compass_finds_the_heading(self):
        x, y, _ = self.pose
        (view,) = self.map.views([(x, y, np.deg2rad(42.0))])
        observation = self.map.set_observation(view.labels)
        scores = observation.score([self.pose], compass=True, curve=True)
        self.assertAlmostEqual(np.rad2deg(scores.best_yaw_rad[0]), 42.0)
        self.assertEqual(scores.curve.shape, (1, 120))
        self.assertEqual(int(np.argmax(scores.curve[0])), 14)

    def test_a_map_taken_to_be_distorted_scores_otherwise(self):
        (view,) = self.map.views([self.pose])
        observation = self.map.set_observation(view.labels)
        poses = [self.pose] * 3
        scores = observation.score(poses, affines=[(1, 1, 0), (1.004, 1, 0), (1.3, 0.8, 0.2)])
        self.assertAlmostEqual(scores.similarity[0], 1.0)
        self.assertEqual(scores.sums[1], scores.sums[0])
        self.assertLess(scores.similarity[2], 0.99)

    def test_the_heat_map_is_hottest_where_it_was_made(self):
        (view,) = self.map.views([self.pose])
        observation = self.map.set_observation(view.labels)
        heat = observation.heat_map(region=self.region())
        x, y, yaw = heat.best()
        self.assertAlmostEqual(x, self.pose[0])
        self.assertAlmostEqual(y, self.pose[1])
        self.assertAlmostEqual(yaw, 0.0)

    def test_a_posterior_is_the_weights_of_all_headings_over_their_sum(self):
        (view,) = self.map.views([self.pose])
        observation = self.map.set_observation(view.labels)
        self.assertIsNone(observation.heat_map(region=self.region()).probability)
        for name, weigh in (
            ("power", lambda s: np.maximum(s, 0.0) ** 3.0),
            ("kappa", lambda s: np.exp(3.0 * s)),
        ):
            heat = observation.heat_map(region=self.region(), posterior=True, **{name: 3.0})
            rows, columns = np.nonzero(~np.isnan(heat.similarity))
            poses = [
                (heat.x_m + (column + 0.5) * 0.1, heat.y_m + (row + 0.5) * 0.1, 0.0)
                for row, column in zip(rows, columns)
            ]
            weights = weigh(observation.score(poses, compass=True, curve=True).curve)
            np.testing.assert_allclose(
                heat.probability[rows, columns], weights.sum(axis=1) / weights.sum(), rtol=1e-5
            )
            self.assertEqual(np.isnan(heat.probability).sum(), np.isnan(heat.similarity).sum())
        with self.assertRaisesRegex(ValueError, "expected one of them"):
            observation.heat_map(posterior=True, power=1.0, kappa=1.0)

    def test_precompute_tells_its_progress(self):
        job = self.map.precompute(region=self.region(0.5))
        statuses = list(job.progress(interval_s=0.02))
        last = statuses[-1]
        self.assertEqual(last.found_cells + last.cast_cells, last.total_cells)
        self.assertGreater(last.total_cells, 0)
        (view,) = self.map.views([self.pose])
        self.assertIsNotNone(view.labels)
        stats = self.server.stats()
        self.assertGreater(stats.latency_by_method["GetMap"].count, 0)
        self.assertGreater(stats.latency_by_method["GetMap"].p99_ms, 0.0)
        self.assertGreater(stats.requests, 0)
        self.assertGreaterEqual(stats.disk.stored, last.cast_cells)
        self.assertEqual((stats.disk.damaged, stats.disk.storing), (0, True))

    def test_errors_name_code_and_field(self):
        with self.assertRaises(semview.SemviewError) as caught:
            self.server.map("attic")
        self.assertEqual((caught.exception.code, caught.exception.field), ("NOT_FOUND", "map_id"))
        with self.assertRaises(semview.SemviewError) as caught:
            self.map.views([(float("nan"), 0.0, 0.0)])
        self.assertEqual(caught.exception.field, "poses.x_m")
        with self.assertRaises(ValueError):
            self.map.views([(0.0, 0.0)])

    def test_no_poses_have_no_views_and_no_scores(self):
        self.assertEqual(self.map.views([]), [])
        self.assertEqual(self.map.views(np.zeros((0, 3)), ranges=True), [])
        self.assertEqual(self.map.pinhole_views([], 5, 3, 50.0, 50.0, 2.5, 1.5), [])
        (view,) = self.map.views([self.pose])
        with self.assertRaisesRegex(ValueError, "no poses"):
            self.map.set_observation(view.labels).score([])
        with self.assertRaisesRegex(ValueError, r"affines of shape \(2, 3\); expected \(1, 3\)"):
            self.map.set_observation(view.labels).score([self.pose], affines=[(1, 1, 0)] * 2)
        with self.assertRaisesRegex(ValueError, "out of range"):
            self.map.set_observation(view.labels).score([self.pose], affines=[(9, 1, 0)])

    def test_class_names_are_those_of_ids(self):
        self.assertEqual(self.map.class_name(0), "none")
        self.assertEqual(self.map.class_name(1), self.map.classes[0])
        self.assertEqual(self.map.class_name(semview.UNKNOWN), "unknown")
        with self.assertRaisesRegex(ValueError, "class id -1"):
            self.map.class_name(-1)


class OtherServersTest(unittest.TestCase):
    def test_nobody_there_is_told_soon_whatever_later_calls_may_take(self):
        start = time.monotonic()
        with self.assertRaises(semview.SemviewError) as caught:
            semview.connect("tcp://127.0.0.1:1", timeout_s=600, connect_timeout_s=0.2)
        self.assertLess(time.monotonic() - start, 60)
        self.assertEqual(caught.exception.code, "UNAVAILABLE")
        self.assertIn("nothing answered at tcp://127.0.0.1:1", str(caught.exception))

    def test_what_is_no_endpoint_is_told_with_an_example(self):
        for endpoint in ("localhost:5560", "tcp://127.0.0.1", "tcp://127.0.0.1:port", "", None):
            with self.assertRaises(semview.SemviewError) as caught:
                semview.connect(endpoint)
            self.assertEqual(caught.exception.code, "INVALID_ARGUMENT")
            self.assertIn("tcp://127.0.0.1:5560", str(caught.exception))

    def test_an_observation_survives_a_restart(self):
        running = RunningServer("--eye-height", "1.0")
        try:
            server = semview.connect(running.endpoint, timeout_s=60)
            flat = server.map(MAP)
            ix, iy = flat.free_cells[0]
            pose = ((ix + 0.5) * 0.1, (iy + 0.5) * 0.1, 0.0)
            observation = flat.set_observation(flat.views([pose])[0].labels)
            before = observation.score([pose], compass=True)
            self.assertEqual(running.stop(), 0)
            running.start()
            after = observation.score([pose], compass=True)
            np.testing.assert_array_equal(before.sums, after.sums)
            server.close()
        finally:
            self.assertEqual(running.close(), 0)


class ExamplesTest(unittest.TestCase):
    """The examples of the documentation, as they stand there, against the real server."""

    @classmethod
    def setUpClass(cls):
        cls.running = RunningServer()
        cls.messages = tempfile.TemporaryDirectory()
        protos = [str(path) for path in (SOURCE / "proto/semview/v1").glob("*.proto")]
        subprocess.run(
            [os.environ["SEMVIEW_PROTOC"], "-I", SOURCE / "proto"]
            + [f"--python_out={cls.messages.name}"]
            + protos,
            check=True,
        )

    @classmethod
    def tearDownClass(cls):
        cls.messages.cleanup()
        assert cls.running.close() == 0

    def run_example(self, page, mark, python_path):
        """What the page's one block of Python that holds `mark` prints."""
        blocks = re.findall(r"```python\n(.*?)```", (SOURCE / page).read_text(), re.DOTALL)
        marked = [block for block in blocks if mark in block]
        self.assertEqual(len(marked), 1, f"{page}: blocks of Python with {mark}")
        self.assertIn("tcp://127.0.0.1:5560", marked[0])
        done = subprocess.run(
            [sys.executable, "-B", "-c", marked[0].replace("tcp://127.0.0.1:5560", self.running.endpoint)],
            env={**os.environ, "PYTHONPATH": python_path},
            capture_output=True,
            text=True,
            timeout=60,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def raw_example_lists_the_map(self, page):
        with contextlib.closing(semview.connect(self.running.endpoint)) as server:
            flat = server.map(MAP)
        printed = self.run_example(page, "_pb2", self.messages.name)
        self.assertEqual(printed, f"{flat.id} {flat.name} {flat.fingerprint}\n")

    def test_the_readme_sees_a_class_of_the_map_straight_ahead(self):
        printed = self.run_example("README.md", "semview.connect", os.environ["PYTHONPATH"])
        with contextlib.closing(semview.connect(self.running.endpoint)) as server:
            self.assertIn(printed.strip(), server.map(MAP).classes)

    def test_the_readme_lists_the_maps_without_our_library(self):
        self.raw_example_lists_the_map("README.md")

    def test_the_protocol_page_lists_the_maps_without_our_library(self):
        self.raw_example_lists_the_map("docs/protocol.md")


if __name__ == "__main__":
    unittest.main(verbosity=2)
