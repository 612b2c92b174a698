#!/usr/bin/env python3
"""The layer check finds each kind of fault in a small tree, and none in a sound one."""
import tempfile
import unittest
from pathlib import Path

import check_layers

SOUND = {
    "core/vec.hpp": "#include <Eigen/Core>\n",
    "mesh/surface_mesh.hpp": '#include "meniscus/core/vec.hpp"\n',
    "linear/solver.cpp": "#include <petscksp.h>\n",
    "flow/fem/flow.cpp": '#include "meniscus/flow/flow_solver.hpp"\n',
    "flow/flow_solver.hpp": '#include "meniscus/mesh/surface_mesh.hpp"\n',
}


def faults(files):
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for name, text in files.items():
            file = root / "meniscus" / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, encoding="utf-8")
        return list(check_layers.faults_of_tree(root))


class Layers(unittest.TestCase):
    def rejects(self, name, line, reason):
        found = faults(SOUND | {name: "#pragma once\n" + line + "\n"})
        self.assertEqual(len(found), 1, found)
        self.assertIn(f"{name}:2:", found[0])
        self.assertIn(reason, found[0])

    def test_sound_tree(self):
        self.assertEqual(faults(SOUND), [])

    def test_every_room_uses_only_rooms_above_it_in_the_table(self):
        rooms = list(check_layers.USES)
        for i, room in enumerate(rooms):
            self.assertLessEqual(set(check_layers.USES[room]), set(rooms[:i]), room)

    def test_include_that_goes_up(self):
        self.rejects("mesh/a.hpp", '#include "meniscus/surface/remesh.hpp"', "mesh may use only")

    def test_flow_does_not_include_its_solvers(self):
        self.rejects("flow/a.hpp", '#include "meniscus/flow/fem/options.hpp"', "flow may use only")

    def test_rooms_of_equal_height(self):
        self.rejects("flow/bem/a.cpp", '#include "meniscus/flow/fem/options.hpp"', "may use only")
        self.rejects("report/a.cpp", '#include "meniscus/case/case.hpp"', "report may use only")

    def test_evolution_knows_no_files(self):
        self.rejects("evolve/a.cpp", '#include "meniscus/io/table.hpp"', "evolve may use only")

    def test_linear_algebra_knows_no_meshes(self):
        self.rejects("linear/a.cpp", '#include "meniscus/mesh/surface_mesh.hpp"', "linear may use")

    def test_remeshing_knows_no_tetrahedra(self):
        self.rejects("surface/a.cpp", '#include "meniscus/mesh/tet_mesh.hpp"', "is closed to")

    def test_libraries_stay_in_their_rooms(self):
        self.rejects("flow/fem/a.cpp", "#include <petscmat.h>", "PETSc belongs to linear")
        self.rejects("evolve/a.cpp", "  #  include <vtkPolyData.h>", "VTK belongs to io")
        self.rejects("mesh/a.cpp", "#include <tetgen.h>", "TetGen belongs to volume")

    def test_file_without_a_room(self):
        self.assertIn("lies in no room", faults(SOUND | {"utils/a.hpp": ""})[0])
        self.rejects("mesh/a.hpp", '#include "meniscus/utils/a.hpp"', "lies in no room")

    def test_include_past_the_root(self):
        self.rejects("mesh/a.hpp", '#include "tet_mesh.hpp"', "quoted includes")


if __name__ == "__main__":
    unittest.main()
