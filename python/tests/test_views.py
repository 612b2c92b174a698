"""Arrays are views that outlive what they were taken from.

Under the address sanitizer (the test python_views) a view of memory that was given back ends the interpreter: what
`tobytes` copies, the sanitizer sees.
"""
import gc
import unittest

import numpy as np

from common import BOUNDED, SHEAR, FolderCase
from meniscus import Case, Run, Simulation, remesh, volume_mesh

REMESHED = {"interface": {"remesh-every": 1}}


class ViewTest(FolderCase):
    def watch(self, arrays):
        """Takes arrays by name; the answer checks that they are as they were."""
        then = {name: array.tobytes() for name, array in arrays.items()}
        for name, array in arrays.items():
            self.assertFalse(array.flags.owndata or array.flags.writeable, name)
            with self.assertRaises(ValueError):
                array[0] = 0

        def check():
            gc.collect()
            junk = [np.full(1000, np.nan) for _ in range(1000)]  # takes memory that was given back
            for name, array in arrays.items():
                self.assertEqual(array.tobytes(), then[name], name)
            del junk
        return check

    def test_interfaces_outlive_steps_remeshing_and_the_simulation(self):
        simulation = Simulation(Case.from_dict(SHEAR | REMESHED))
        drop = simulation.interfaces[0]
        before = drop.points.copy()
        self.assertTrue(np.shares_memory(drop.points, simulation.interfaces[0].points))
        check = self.watch({"points": drop.points, "triangles": drop.triangles} | drop.fields | drop.face_fields)
        del drop
        simulation.step()
        check()
        simulation.run()
        self.assertFalse(np.array_equal(simulation.interfaces[0].points, before))
        check()
        simulation.close()
        del simulation
        check()

    def test_volume_meshes_outlive_remeshing_and_the_simulation(self):
        simulation = Simulation(Case.from_dict(BOUNDED | REMESHED))
        mesh = simulation.volume_mesh
        before = mesh.points.copy()
        check = self.watch({"points": mesh.points, "tetrahedra": mesh.tetrahedra, "region": mesh.region,
                            "velocity": mesh.velocity, "pressure": mesh.pressure} | mesh.fields)
        del mesh
        simulation.run()
        self.assertFalse(np.array_equal(simulation.volume_mesh.points, before))
        check()
        simulation.close()
        del simulation
        check()

    def test_frames_of_a_folder_outlive_the_run(self):
        with Simulation(Case.from_dict(BOUNDED), self.folder / "run") as simulation:
            simulation.run()
        run = Run(self.folder / "run")
        shape, volume = run.shape(0.0), run.volume(0.0)
        check = self.watch({"points": shape.points, "triangles": shape.triangles, "x": volume.points,
                            "tetrahedra": volume.tetrahedra, "middles": shape.middles} | shape.fields)
        del run, shape, volume
        check()

    def test_made_meshes_outlive_their_objects(self):
        drop = Simulation(Case.from_dict(SHEAR)).interfaces[0]
        ball = remesh(drop.points, drop.triangles, nodes=60)
        mesh = volume_mesh([(ball.points, ball.triangles)], (3.0 * drop.points, drop.triangles))
        check = self.watch({"points": ball.points, "triangles": ball.triangles, "x": mesh.points,
                            "tetrahedra": mesh.tetrahedra, "region": mesh.region})
        del drop, ball, mesh
        check()


if __name__ == "__main__":
    unittest.main()
