// Lesson 2: a scene, and the tetrahedra that fill it.
//
//   mesh_scene [N0]     # vertices on the drop; writes scene.vtu for ParaView
//
// A drop of radius 1 lies off the centre of a box. Tetrahedra fill both liquids, and every triangle
// of the drop is a facet of one tetrahedron inside and one outside.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include "meniscus/core/error.hpp"
#include "meniscus/io/vtk_file.hpp"
#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/scene/scene.hpp"
#include "meniscus/volume/quality.hpp"
#include "meniscus/volume/tetrahedralize.hpp"

namespace {

using namespace meniscus;

const Vec3 kHalfWidths(4.0, 3.0, 3.0);
constexpr RegionId kMatrix{0}, kDrop{1};

// A scene holds all that a flow solver is to know at one instant: liquids, interfaces, walls. The
// matrix is region 0; what interface i encloses is region i + 1.
Scene drop_in_a_box(int drop_vertices) {
  Scene scene;
  scene.liquids = Field<RegionId, Liquid>(2);
  scene.liquids[kDrop].viscosity = 5.0;

  Interface drop;
  drop.mesh = sphere(drop_vertices, 1.0, Vec3(0.8, 0.0, 0.3));
  drop.inside = kDrop;
  drop.outside = kMatrix;
  scene.interfaces.push_back(drop);

  // The walls are a surface as well. Its faces are divided in patches, one condition each. The
  // tags 0 … 5 of a box are its sides −x, +x, −y, +y, −z, +z.
  const TaggedSurface walls = box(200, kHalfWidths);
  scene.boundary.mesh = walls.mesh;
  for (const char* name : {"x-", "x+", "y-", "y+", "z-", "z+"})
    scene.boundary.patches.add({name, NoPenetration{}});
  for (const int tag : walls.tag) scene.boundary.patch.add(PatchId{tag});
  return scene;
}

// Volumes by region. Ids are iterated, and index what lives on their kind of element.
std::array<double, 2> volumes(const TetMesh& mesh) {
  std::array<double, 2> sum{};
  for (const CellId c : mesh.cells.ids())
    sum[static_cast<std::size_t>(mesh.region[c].value)] += signed_volume(mesh, c);
  return sum;
}

// A flat tetrahedron spoils a flow. Its smallest dihedral angle shows it: 70.5° if regular.
void print_angles(const CellField<double>& angle) {
  std::array<int, 8> count{};
  for (const double a : angle) ++count[static_cast<std::size_t>(a / 10.0)];
  std::printf("smallest dihedral angle of the cells:\n");
  for (std::size_t i = 0; i < count.size(); ++i)
    std::printf("  %2zu to %2zu degrees %6d\n", 10 * i, 10 * i + 10, count[i]);
}

// Arrays on cells are flat lists of numbers with a name. ParaView colours by them; its filter Clip
// shows the drop inside.
void write(const TetMesh& mesh, const CellField<double>& angle) {
  io::NamedArray region{.name = "region", .components = 1, .values = {}};
  io::NamedArray smallest{.name = "smallest_dihedral_deg", .components = 1, .values = {}};
  for (const CellId c : mesh.cells.ids()) {
    region.values.push_back(mesh.region[c].value);
    smallest.values.push_back(angle[c]);
  }
  io::write_vtu("scene.vtu", mesh, {.on_vertices = {}, .on_cells = {region, smallest}}, 0.0);
}

bool lesson(int drop_vertices) {
  const Scene scene = drop_in_a_box(drop_vertices);
  // Drops that touch or stick out of the walls are found before the mesher meets them.
  if (const auto fault = find_conflict(scene)) reject_input("{}", fault->text);

  // What can fail without anyone's mistake returns a report. `mesh` is written when all is well.
  TetMesh mesh;
  const VolumeMeshReport report = tetrahedralize(scene, VolumeMeshOptions{}, mesh);
  if (!report.ok()) throw RunFailure(report.text());
  std::printf("%d vertices, %d tetrahedra\n", mesh.num_vertices(), mesh.num_cells());

  const auto [outside, inside] = volumes(mesh);
  const double drop = enclosed_volume(scene.interfaces[0].mesh);
  const double all = 8.0 * kHalfWidths.prod(), ball = 4.0 * std::numbers::pi / 3.0;
  std::printf("drop: its faces enclose %.9f, its cells hold %.9f\n", drop, inside);
  std::printf("box:  %.9f, all cells hold %.9f\n", all, inside + outside);
  std::printf("a ball has %.6f: flat faces lack %.2f %%\n", ball, 100.0 * (1.0 - drop / ball));

  const MeshQuality q = quality(mesh);
  print_angles(min_dihedral_deg(mesh));
  std::printf("from %.1f to %.1f degrees, smallest volume %.2e\n", q.min_dihedral_deg,
              q.max_dihedral_deg, q.min_volume);
  write(mesh, min_dihedral_deg(mesh));

  // What is written can be read again: here to see that nothing was lost.
  const io::VolumeFrame frame = io::read_vtu("scene.vtu");
  const bool is_kept = frame.cells.size() == static_cast<std::size_t>(mesh.num_cells());

  // Sums of some thousand volumes agree to round-off. Faces of N vertices on the unit sphere lack
  // √3π/N of its volume, by a fifth more where they are not equilateral.
  const double lacking = std::sqrt(3.0) * std::numbers::pi / drop_vertices;
  return is_kept && std::abs(inside / drop - 1.0) < 1e-12 &&
         std::abs((inside + outside) / all - 1.0) < 1e-12 && q.min_volume > 0.0 &&
         std::abs((1.0 - drop / ball) / lacking - 1.0) < 0.2;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return lesson(argc > 1 ? std::atoi(argv[1]) : 200) ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "mesh_scene: %s\n", error.what());
    return 2;
  }
}
