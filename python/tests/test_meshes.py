import os
import subprocess
import sys
import unittest

import numpy as np

from common import BOUNDED, SHEAR, FolderCase, enclosed
from meniscus import Case, Simulation, remesh, volume_mesh
from misfits import WRONG_NUMBERS, WRONG_TEXTS


def sphere(nodes=100, radius=1.0, center=(0.0, 0.0, 0.0)):
    tables = SHEAR | {"drop": [{"nodes": nodes, "radius": 1.0}]}
    drop = Simulation(Case.from_dict(tables)).interfaces[0]
    return drop.points * radius + np.asarray(center), drop.triangles


class RemeshTest(FolderCase):
    @classmethod
    def setUpClass(cls):
        cls.ball = sphere()

    def test_meets_each_target_and_keeps_the_volume(self):
        points, triangles = self.ball
        stretched = points * [1.5, 1.0, 1.0]
        volume = enclosed(stretched, triangles)
        dense = remesh(stretched, triangles, nodes=300)
        self.assertTrue(dense.is_met)
        self.assertAlmostEqual(len(dense.points), 300, delta=6)
        self.assertAlmostEqual(enclosed(dense.points, dense.triangles), volume, delta=1e-6 * volume)
        even = remesh(stretched.tolist(), triangles.tolist(), edge_length=0.2)
        edges = np.linalg.norm(even.points[even.triangles[:, 0]] - even.points[even.triangles[:, 1]], axis=1)
        self.assertAlmostEqual(edges.mean(), 0.2, delta=0.005)
        self.assertLessEqual(remesh(stretched, triangles, chordal_error=0.01).reached, 0.01)

    def test_turns_triangles_and_mends_only_where_asked_to(self):
        points, triangles = sphere(500)
        volume = enclosed(points, triangles)
        sound = remesh(points, triangles, nodes=150)
        self.assertEqual(sound.repairs, "")
        turned = remesh(points, triangles[:, ::-1], nodes=150)
        self.assertIn("turned", turned.repairs)
        self.assertAlmostEqual(enclosed(turned.points, turned.triangles), volume, delta=1e-9 * volume)
        apart = (points[triangles].reshape(-1, 3), np.arange(triangles.size).reshape(-1, 3))
        for given, words in (((points, triangles[1:]), "hole"), (apart, "points"),
                             ((points, np.vstack([triangles, triangles[7]])), "removed")):
            with self.assertRaisesRegex(ValueError, "surface"):
                remesh(*given, nodes=150)
            mended = remesh(*given, nodes=150, repair=True)
            self.assertIn(words, mended.repairs)
            self.assertAlmostEqual(enclosed(mended.points, mended.triangles), volume, delta=0.02 * volume)
        bowl = triangles[points[triangles[:, 0], 2] < 0.5]
        with self.assertRaisesRegex(ValueError, "a hole of"):
            remesh(points, bowl, repair=True)

    def test_refuses_what_is_no_surface(self):
        points, triangles = self.ball
        broken = points.copy()
        broken[7, 1] = np.nan
        for wrong, words in (((points[:, :2], triangles), r"points .*\(n, 3\)"),
                             (("x", triangles), "points"),
                             ((broken, triangles), r"points\[7\].*finite"),
                             ((points, triangles + 1), "names none of the"),
                             ((points, triangles.astype(float)), "whole numbers"),
                             ((points, triangles.ravel()), r"triangles .*\(m, 3\)"),
                             ((points, triangles[1:]), "surface"),
                             ((points[:0], triangles[:0]), "surface")):
            with self.assertRaisesRegex(ValueError, words):
                remesh(*wrong)
        for kind in (complex, object, str, bool, "datetime64[s]"):
            with self.assertRaisesRegex(ValueError, "^points must hold real numbers, not "):
                remesh(points.astype(kind), triangles)
        with self.assertRaisesRegex(ValueError, "^points .* masked"):
            remesh(np.ma.masked_array(points, mask=points > 0.5), triangles)
        for wrong in (None, 3, "x", {}, object(), 10**400):
            with self.assertRaisesRegex(ValueError, r"^points must be .*\(n, 3\), not "):
                remesh(wrong, triangles)
            with self.assertRaisesRegex(ValueError, r"^triangles must be .*\(m, 3\), not "):
                remesh(points, wrong)
        with self.assertRaisesRegex(ValueError, "^points must hold"):
            remesh([[10**400, 0, 0]] * 42, triangles)
        for name in ("nodes", "edge_length", "chordal_error", "edge_floor", "gradation"):
            for wrong in WRONG_NUMBERS:
                if wrong is not None:
                    with self.assertRaisesRegex(ValueError, f"^{name} ", msg=wrong):
                        remesh(points, triangles, **{name: wrong})
        with self.assertRaisesRegex(ValueError, "one of"):
            remesh(points, triangles, nodes=100, edge_length=0.1)
        for arguments, words in (({"nodes": 3}, "nodes = 3"), ({"edge_length": -1}, "edge_length = -1"),
                                 ({"edge_length": float("nan")}, "edge_length"),
                                 ({"nodes": "many"}, "nodes"), ({"gradation": 0}, "gradation = 0"),
                                 ({"repair": "all"}, "repair must be True or False")):
            with self.assertRaisesRegex(ValueError, words):
                remesh(points, triangles, **arguments)


class VolumeMeshTest(FolderCase):
    def test_fills_the_space_around_and_inside_surfaces(self):
        inner, nested = sphere(80, 0.5), sphere(60, 0.2)
        beside = sphere(60, 0.4, (1.2, 0.0, 0.0))
        boundary = sphere(100, 3.0)
        mesh = volume_mesh([inner, nested, beside], boundary)
        edges = mesh.points[mesh.tetrahedra[:, 1:]] - mesh.points[mesh.tetrahedra[:, :1]]
        volumes = np.linalg.det(edges) / 6.0
        self.assertGreater(volumes.min(), 0.0)
        expected = [enclosed(*boundary) - enclosed(*inner) - enclosed(*beside),
                    enclosed(*inner) - enclosed(*nested), enclosed(*nested), enclosed(*beside)]
        filled = [volumes[mesh.region == region].sum() for region in range(4)]
        np.testing.assert_allclose(filled, expected, rtol=1e-10)
        np.testing.assert_array_equal(mesh.points[:len(inner[0])], inner[0])
        self.assertFalse(mesh.points.flags.writeable)

    def test_refuses_unfit_surfaces_and_options(self):
        ball, boundary = sphere(60, 0.5), sphere(60, 2.0)
        apart = sphere(60, 0.5, (0.6, 0.0, 0.0))
        outside = sphere(60, 0.5, (2.0, 0.0, 0.0))
        for surfaces, words in (([ball, apart], r"surfaces\[0\] and surfaces\[1\]"),
                                ([outside], "surfaces"), ([ball[0]], r"surfaces\[0\]"),
                                ([(ball[0], ball[1][1:])], r"surfaces\[0\]"), ([3], r"surfaces\[0\]")):
            with self.assertRaisesRegex(ValueError, words):
                volume_mesh(surfaces, boundary)
        with self.assertRaisesRegex(ValueError, "grading"):
            volume_mesh([ball], boundary, grading="steep")
        with self.assertRaisesRegex(ValueError, "radius_edge"):
            volume_mesh([ball], boundary, radius_edge=0.5)
        for wrong in (None, 3, "x", "", {}, True, object()):
            with self.assertRaisesRegex(ValueError, "^surfaces must be a list of surfaces, not "):
                volume_mesh(wrong, boundary)
            with self.assertRaisesRegex(ValueError, "^boundary must be a pair"):
                volume_mesh([ball], wrong)
        for wrong in WRONG_TEXTS:
            with self.assertRaisesRegex(ValueError, "^grading ", msg=wrong):
                volume_mesh([ball], boundary, grading=wrong)
        for name in ("interior_growth", "radius_edge", "gap_layers", "cell_volume"):
            for wrong in WRONG_NUMBERS:
                with self.assertRaisesRegex(ValueError, f"^{name} ", msg=wrong):
                    volume_mesh([ball], boundary, **{name: wrong})

    def test_a_failed_assertion_of_the_mesher_does_not_end_the_interpreter(self):
        # In this box an assertion of TetGen's fails in the order in which it first inserts the points.
        case = Case.from_dict({"flow": {"kind": "simple-shear", "capillary-number": 0.1},
                               "drop": [{"radius": 1.0, "nodes": 70}],
                               "domain": {"shape": "box", "half-width": 10.0, "nodes": 507},
                               "time": {"end": 1.0}})
        self.assertGreater(len(Simulation(case).volume_mesh.tetrahedra), 1000)

    def test_assertions_of_the_mesher_that_always_fail_are_a_runtime_error(self):
        script = (
            "from meniscus import Case, Simulation, volume_mesh\n"
            f"drop = Simulation(Case.from_dict({SHEAR!r})).interfaces[0]\n"
            "ball = (drop.points, drop.triangles)\n"
            "for use in (lambda: volume_mesh([ball], (3 * drop.points, drop.triangles)),\n"
            f"            lambda: Simulation(Case.from_dict({BOUNDED!r}))):\n"
            "    try:\n"
            "        use()\n"
            "    except RuntimeError as error:\n"
            "        print(error)\n"
            f"print(len(Simulation(Case.from_dict({SHEAR!r})).interfaces))\n")
        preloaded = [*os.environ.get("LD_PRELOAD", "").split(), os.environ["MENISCUS_FAILING_MESHER"]]
        done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False,
                              env=os.environ | {"LD_PRELOAD": " ".join(preloaded)})
        self.assertEqual(done.returncode, 0, done.stderr)
        made, begun, after = done.stdout.splitlines()
        for line in (made, begun):
            self.assertIn("Assertion `in == nullptr' failed", line)
        self.assertEqual(after, "1")


if __name__ == "__main__":
    unittest.main()
