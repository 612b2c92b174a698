"""What the tests share: small cases, the program, a folder that is removed."""
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

PROGRAM = os.environ["MENISCUS_PROGRAM"]
ROOT = Path(__file__).resolve().parents[2]

# A drop of the fewest vertices in an unbounded liquid, by boundary integrals: milliseconds a step.
SHEAR = {"title": "Shear", "flow": {"kind": "simple-shear", "capillary-number": 0.2},
         "drop": [{"radius": 1.0, "nodes": 42}],
         "domain": {"shape": "unbounded"}, "solver": {"method": "boundary-integral"},
         "time": {"end": 0.2, "max-step": 0.02},
         "output": {"interval": 0.05, "checkpoint-every": 3}}
# A drop in a sphere, by finite elements.
BOUNDED = {"flow": {"kind": "planar-extension", "capillary-number": 0.1},
           "drop": [{"radius": 1.0, "nodes": 42}], "domain": {"shape": "sphere", "radius": 3.0, "nodes": 60},
           "time": {"end": 0.05, "max-step": 0.01}, "output": {"interval": 0.02, "volume-interval": 0.02}}
# Two drops of unlike liquids that an extension brings together: they must not merge.
UNLIKE = {"flow": {"kind": "planar-extension", "capillary-number": 0.2},
          "drop": [{"center": [0, 0.57, 0], "radius": 0.5, "nodes": 42},
                   {"center": [0, -0.57, 0], "radius": 0.5, "nodes": 42, "viscosity-ratio": 3.0}],
          "interface": {"gap-layers": 0}, "topology": {"breakup-radius": 0.1, "coalescence-gap": 0.125},
          "domain": {"shape": "unbounded"}, "solver": {"method": "boundary-integral"},
          "time": {"end": 0.2, "max-step": 0.05}, "output": {"interval": 0.05}}


def program(*arguments, status=0):
    """Runs the program and returns what it said on standard error."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False)
    if done.returncode != status:
        raise AssertionError(f"status {done.returncode}, not {status}: {done.stderr}{done.stdout}")
    return done.stderr


def enclosed(points, triangles):
    """The volume inside a closed surface."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6.0


class FolderCase(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="meniscus-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def assertSameRun(self, one, other):
        """Tables and checkpoints have the same bytes: nothing in them tells the clock."""
        names = sorted(file.name for file in one.iterdir() if file.suffix == ".h5")
        self.assertTrue(names)
        self.assertEqual(names, sorted(file.name for file in other.iterdir() if file.suffix == ".h5"))
        for name in ["history.csv", "drops.csv", "events.csv", "surface.pvd", *names]:
            self.assertEqual((one / name).read_bytes(), (other / name).read_bytes(), name)
