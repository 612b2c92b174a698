#include "tests/flow/fem/stage_from_rest.hpp"

#include <cmath>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/instant_problem.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus::fem {
namespace {

constexpr double kSmall = 1e-8;

}  // namespace

SphereScene pushed_drop(int num_vertices) {
  return {.num_vertices = num_vertices,
          .Ca = 1.0 / kSmall,
          .outer_per_inner = 1.25,
          .drop_force = Vec3(0.0, kSmall, 0.0)};
}

SphereScene extended_drop(int num_vertices) {
  return {.num_vertices = num_vertices,
          .Ca = 0.17 / kSmall,
          .outer_per_inner = 1.25,
          .outer_velocity = [](const Vec3& x, double) -> Vec3 {
            return kSmall * Vec3(x.x(), -0.5 * x.y(), -0.5 * x.z());
          },
          .is_linear_flow = true};
}

StageFromRest::StageFromRest(const SphereScene& options, DropShape shape, Elements elements)
    : scene_(sphere_in_sphere(options)) {
  if (shape != DropShape::sphere)
    scene_.interfaces[0].mesh = graded_surface(shape, options.num_vertices);
  if (const VolumeMeshReport report = tetrahedralize(scene_, suited_volume_mesh(elements), mesh_);
      !report.ok())
    throw RunFailure(report.text());
  space_ = flow_space(mesh_, elements);
}

StokesProblem StageFromRest::problem(const StageLiquids& liquids, double duration) {
  Liquid &matrix = scene_.liquids[RegionId{0}], &drop = scene_.liquids[RegionId{1}];
  drop.viscosity = liquids.viscosity_ratio;
  matrix.density = liquids.density;
  drop.density = liquids.density * liquids.density_ratio;
  const NodePositions positions = node_positions(scene_, mesh_, space_);
  const FlowDomain domain{scene_, &mesh_};
  if (std::isinf(duration))
    return instant_problem(domain, space_, positions, CapillaryForm::weak, 0.0).stokes;
  const ImplicitStage stage = stage_at_rest(scene_, duration, positions.x);
  return instant_problem(with_stage(domain, stage), space_, positions, CapillaryForm::weak, 0.0)
      .stokes;
}

StokesReport StageFromRest::solve(const StageLiquids& liquids, double duration) {
  Options options;
  options.elements = space_.elements;
  StokesSolver solver(space_, options);
  StokesState state = solver.state_at_rest();
  PhaseTimes ignored;
  return solver.solve(problem(liquids, duration), state, linear::Preconditioner::fresh, ignored);
}

double StageFromRest::duration_of(double s, double density) const {
  const SurfaceMesh& surface = scene_.interfaces[0].mesh;
  // Of equilateral triangles, two for each vertex.
  const double edge =
      std::sqrt(surface_area(surface) / surface.num_vertices() * 2.0 / std::sqrt(3.0));
  return s * density * edge * edge;
}

}  // namespace meniscus::fem
