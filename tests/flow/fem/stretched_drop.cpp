#include "tests/flow/fem/stretched_drop.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/boundary_conditions.hpp"
#include "meniscus/flow/fem/capillary_force.hpp"
#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/remesh.hpp"
#include "tests/flow/fem/sphere_scene.hpp"

namespace meniscus::fem {
namespace {

/// Distance from the centre of an oval of Cassini, r² = cos 2θ + (b⁴ − sin² 2θ)^½ with foci at ±1,
/// where the direction makes the cosine c with the axis. Its neck is (b² − 1)^½.
double cassini_radius(double c) {
  constexpr double kNeck = 0.1, kSquare = 1.0 + kNeck * kNeck;
  const double cos2 = 2.0 * c * c - 1.0;
  return std::sqrt(cos2 + std::sqrt(kSquare * kSquare - 1.0 + cos2 * cos2));
}

SurfaceMesh smooth_surface(DropShape shape, int num_vertices) {
  SurfaceMesh mesh = sphere(num_vertices);
  for (Vec3& x : mesh.x) {
    if (shape == DropShape::prolate) x[0] *= 4.0;
    if (shape == DropShape::dumbbell) {
      x *= cassini_radius(x[0]);
      x[0] *= 2.0;
    }
  }
  const double scale = std::cbrt(4.0 / 3.0 * std::numbers::pi / enclosed_volume(mesh));
  for (Vec3& x : mesh.x) x *= scale;
  return mesh;
}

}  // namespace

SurfaceMesh graded_surface(DropShape shape, int N0) {
  // Twice as fine as it will be, so that the curvature is the shape's own.
  SurfaceMesh mesh = smooth_surface(shape, std::max(4 * N0, 4000));
  const RemeshReport report =
      remesh(mesh, {.C0 = N0 / (4.0 * std::numbers::pi), .volume = 4.0 / 3.0 * std::numbers::pi});
  if (!report.ok()) throw RunFailure(report.text());
  return mesh;
}

Scene stretched_drop(DropShape shape, int N0, double lambda) {
  const Mat3 gradient = ImposedFlow::uniaxial_extension();
  Scene scene = sphere_in_sphere(
      {.num_vertices = N0,
       .viscosity_ratio = lambda,
       .Ca = 0.17,
       .outer_per_inner = 1.25,
       .outer_velocity = [gradient](const Vec3& x, double) { return Vec3(gradient * x); },
       .is_linear_flow = true});
  scene.interfaces[0].mesh = graded_surface(shape, N0);
  return scene;
}

StokesProblem instant(const Scene& scene, const TetMesh& mesh, const FlowSpace& space) {
  StokesProblem problem(mesh, space, node_positions(scene, mesh, space));
  for (const CellId c : mesh.cells.ids())
    problem.viscosity[c] = scene.liquids[mesh.region[c]].viscosity;
  problem.constraints =
      boundary_conditions(scene.boundary,
                          face_nodes(space, mesh, scene.boundary.mesh, mesh.boundary),
                          problem.positions, 0.0)
          .constraints;
  add_capillary_force(scene.interfaces[0], CapillaryForm::weak,
                      face_nodes(space, mesh, scene.interfaces[0].mesh, mesh.interfaces[0]),
                      problem.positions, problem.force);
  return problem;
}

}  // namespace meniscus::fem
