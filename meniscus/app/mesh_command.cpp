#include <filesystem>
#include <numbers>

#include <fmt/format.h>

#include "meniscus/app/commands.hpp"
#include "meniscus/app/frames.hpp"
#include "meniscus/app/output_file.hpp"
#include "meniscus/app/wording.hpp"
#include "meniscus/case/case.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/evolve/evolution.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/volume/quality.hpp"

namespace meniscus {
namespace {

void print_surface(const std::string& name, const SurfaceMesh& mesh) {
  fmt::print("{:<10} {:>8} {:>8} {:>10.4g} {:>10.4g} {:>9.1f} {:>12.6g}\n", name,
             mesh.num_vertices(), mesh.num_faces(), shortest_edge(mesh), mean_edge(mesh),
             smallest_angle_deg(mesh), enclosed_volume(mesh));
}

void print_surfaces(const Scene& scene) {
  fmt::print("{:<10} {:>8} {:>8} {:>10} {:>10} {:>9} {:>12}\n", "surface", "vertices", "faces",
             "min edge", "mean edge", "min angle", "volume");
  for (const Interface& interface : scene.interfaces)
    print_surface(fmt::format("drop {}", interface.drop), interface.mesh);
  if (!scene.is_unbounded) print_surface("boundary", scene.boundary.mesh);
}

void print_quality(const TetMesh& mesh) {
  const MeshQuality q = quality(mesh);
  fmt::print("\nvolume mesh: {} vertices, {} tetrahedra\n", mesh.num_vertices(), mesh.num_cells());
  fmt::print("dihedral angles {:.1f} to {:.1f} degrees, {:.3f} % of the tetrahedra below 10\n",
             q.min_dihedral_deg, q.max_dihedral_deg, 100.0 * q.below_10_deg);
  fmt::print("smallest radius ratio {:.3f}, smallest volume {:.3g} R0^3\n", q.min_radius_ratio,
             q.min_volume);
}

}  // namespace

int mesh_command(const MeshArguments& arguments) {
  if (!arguments.output.empty()) {
    if (std::filesystem::path(arguments.output).extension() != ".vtu")
      reject_input("-o {}: the mesh is written as .vtu", arguments.output);
    require_writable(arguments.output);
  }
  const Case c = read_case(arguments.case_file, arguments.overrides);
  if (c.method == FlowMethod::boundary_integral && !arguments.output.empty())
    reject_input("--output {}: boundary integrals need no volume mesh", arguments.output);
  CaseSolvers solvers = make_solvers(c);
  Evolution evolution(build_scene(c), c.evolution, std::move(solvers.flow), make_moving_mesh(c),
                      std::move(solvers.scalars));
  evolution.set_listener(log_notice);
  if (const Report prepared = evolution.prepare(); !prepared.ok())
    throw RunFailure(fmt::format("{}: the mesh could not be made: {}",
                                 source_of_surface(c, evolution.scene(), prepared.fault->position),
                                 prepared.text()));
  print_surfaces(evolution.scene());
  if (evolution.state().mesh) print_quality(evolution.state().mesh->tetrahedra());
  if (!arguments.output.empty()) write_volume_frame(arguments.output, evolution);
  return 0;
}

}  // namespace meniscus
