// The program `meniscus` with two passive scalars on every run that it begins: a dye on the
// interfaces' faces and one in the cells, both conserved and a cosine of position at first.
//
//   passive_scalar run examples/shear-subcritical.toml -o dyed
//   meniscus resume dyed
//
// A further scalar is a further line here. Transport, events, checkpoints and frames carry whatever
// the state does, and `meniscus` itself goes on with such a run.
#include <cmath>

#include "meniscus/app/command_line.hpp"
#include "meniscus/core/memory.hpp"
#include "meniscus/evolve/evolution.hpp"

namespace {

using namespace meniscus;

double dye(const Vec3& x) { return 2.0 + std::cos(2.0 * x.x() + x.y()); }

SurfaceFields on_faces(const SurfaceMesh& mesh) {
  FaceField<double> values;
  for (const FaceVertices& f : mesh.faces)
    values.add(dye((mesh.x[f[0]] + mesh.x[f[1]] + mesh.x[f[2]]) / 3.0));
  return {{}, {{"surface_dye", "", FieldTransfer::conserved, values}}};
}

VolumeFields in_cells(const TetMesh& mesh) {
  CellField<double> values;
  for (const CellVertices& c : mesh.cells)
    values.add(dye(0.25 * (mesh.x[c[0]] + mesh.x[c[1]] + mesh.x[c[2]] + mesh.x[c[3]])));
  return {{}, {{"bulk_dye", "", FieldTransfer::conserved, values}}};
}

void put_dyes(Evolution& evolution) {
  std::vector<SurfaceFields> fields;
  for (const Interface& interface : evolution.scene().interfaces)
    fields.push_back(on_faces(interface.mesh));
  evolution.set_interface_fields(std::move(fields));
  // Boundary integrals have no mesh in the bulk.
  if (evolution.state().mesh)
    evolution.set_bulk_fields(in_cells(evolution.state().mesh->tetrahedra()));
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();
  return run_command_line(argc, argv, put_dyes);
}
