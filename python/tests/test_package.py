"""Types, help, pictures, ranks."""
import json
import os
import pydoc
import subprocess
import sys
import unittest
from pathlib import Path

import numpy as np

import meniscus
from common import SHEAR, FolderCase
from meniscus import Case, Run, Simulation

MPIEXEC = os.environ["MENISCUS_MPIEXEC"]


class RunFolderTest(FolderCase):
    def setUp(self):
        super().setUp()
        with Simulation(Case.from_dict(SHEAR), self.folder / "run") as simulation:
            simulation.run()

    def test_reads_what_a_run_wrote(self):
        run = Run(self.folder / "run")
        self.assertEqual(run.status, "done")
        self.assertEqual(run.case["drop"][0]["nodes"], 42)
        self.assertEqual(len(run.events()["kind"]), 0)
        self.assertGreater(run.timing()["solve"].sum(), 0.0)
        self.assertEqual(run.history()["step_bound"].dtype.kind, "U")
        times = run.shape_times
        shape = run.shape(times[2] + 1e-3)
        self.assertEqual(shape.t, times[2])
        points, triangles = shape.drop(0)
        np.testing.assert_array_equal(points[triangles], shape.points[shape.triangles])
        with self.assertRaisesRegex(ValueError, "drop 3"):
            shape.drop(3)
        with self.assertRaisesRegex(ValueError, "volume"):
            run.volume(0.0)
        with self.assertRaisesRegex(ValueError, "finite"):
            run.shape(float("nan"))
        with self.assertRaisesRegex(ValueError, "not the folder"):
            Run(self.folder / "none")
        with self.assertRaisesRegex(ValueError, "holds no run"):
            Run(self.folder)

    def test_draws(self):
        import matplotlib
        matplotlib.use("Agg")
        from meniscus import plot
        run = Run(self.folder / "run")
        ax = plot.interface(run, color="curvature")
        ax.figure.savefig(self.folder / "interface.png")
        self.assertIn("t = ", ax.get_title())
        ax = plot.history(run, ["L", "B"])
        self.assertEqual([line.get_label() for line in ax.lines], ["L", "B"])
        np.testing.assert_array_equal(ax.lines[0].get_ydata(), run.drops()["L"])
        ax.figure.savefig(self.folder / "history.png")
        plot.interface(meniscus.remesh(*run.shape(0.0).drop(0), nodes=60))
        for draw in (lambda: plot.history(run, "colour"), lambda: plot.interface(run, color="colour"),
                     lambda: plot.interface(run, color="velocity")):
            with self.assertRaises(ValueError):
                draw()


class PackageTest(FolderCase):
    def test_every_public_name_is_explained(self):
        for name in meniscus.__all__:
            thing = getattr(meniscus, name)
            self.assertTrue(thing.__doc__, name)
            for member, value in vars(thing).items() if isinstance(thing, type) else ():
                if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                    self.assertTrue(value.__doc__ or member in ("is_closed",), f"{name}.{member}")
        page = pydoc.render_doc(meniscus, renderer=pydoc.plaintext)
        for word in ("Simulation", "R0", "ValueError"):
            self.assertIn(word, page)

    def test_types_hold(self):
        folder = Path(meniscus.__file__).parent
        environment = os.environ | {"MYPYPATH": str(folder.parent)}
        common = ["--cache-dir", str(self.folder)]
        done = subprocess.run([sys.executable, "-m", "mypy", *common, "--strict", "--allow-any-generics",
                               "--ignore-missing-imports", "-p", "meniscus"], env=environment,
                              cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_the_stub_names_all_that_is_compiled(self):
        import ast
        stub = ast.parse((Path(meniscus.__file__).parent / "_core.pyi").read_text(encoding="utf-8"))
        from meniscus import _core

        def public(names):
            return {name for name in names if not name.startswith("_")}
        declared = {}
        for node in stub.body:
            if isinstance(node, ast.ClassDef):
                declared[node.name] = public(member.name for member in node.body)
            elif isinstance(node, ast.FunctionDef):
                declared[node.name] = None
            elif isinstance(node, ast.AnnAssign):
                declared[node.target.id] = None
        self.assertEqual(set(declared), public(vars(_core)))
        for name, members in declared.items():
            if members is not None:
                self.assertEqual(members, public(vars(getattr(_core, name))), name)

    def test_ranks_share_a_run(self):
        script = self.folder / "script.py"
        script.write_text(
            "import os, sys, meniscus\n"
            f"case = meniscus.Case.from_dict({SHEAR!r})\n"
            "said = open(f'said-{os.getpid()}', 'w')\n"
            "with meniscus.Simulation(case, sys.argv[1]) as simulation:\n"
            "    simulation.run(until=0.1)\n"
            "    assert len(simulation.history()['t']) == simulation.step_number + 1\n"
            "    print(repr(simulation.drops()['D'][-1]), file=said)\n"
            "try:\n"
            "    meniscus.Simulation(case, sys.argv[1])\n"
            "except ValueError as error:\n"
            "    print('refused', error, file=said)\n", encoding="utf-8")
        command = [MPIEXEC, "-n", "2", sys.executable, str(script), str(self.folder / "run")]
        # Without what MPI, once begun in this process, adds to its environment.
        done = subprocess.run(command, env=dict(os.environ), cwd=self.folder, capture_output=True,
                              text=True, timeout=120, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        said = [file.read_text().splitlines() for file in self.folder.glob("said-*")]
        self.assertEqual(len(said), 2)
        self.assertEqual(said[0], said[1])
        self.assertIn("holds a run already", said[0][1])
        record = json.loads((self.folder / "run/run.json").read_text(encoding="utf-8"))
        self.assertEqual((record["ranks"], record["status"]), (2, "stopped"))
        alone = Simulation(Case.from_dict(SHEAR))
        alone.run(until=0.1)
        self.assertAlmostEqual(float(said[0][0]), alone.drops()["D"][-1], delta=1e-6)


if __name__ == "__main__":
    unittest.main()
