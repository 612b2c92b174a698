// Lesson 3: one Stokes flow, by both solvers, against theory.
//
//   one_solve
//
// A body force drives a spherical drop of viscosity λ through a liquid of viscosity 1. Hadamard and
// Rybczynski found the flow: the drop moves at U = 2/3 b (1 + λ)/(2 + 3λ) under a force b per
// volume, and stays a sphere. So the velocity is known at every point of it.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/bem/boundary_integral_flow.hpp"
#include "meniscus/flow/fem/finite_element_flow.hpp"
#include "meniscus/mesh/shapes.hpp"
#include "meniscus/scene/scene.hpp"
#include "meniscus/volume/moving_mesh.hpp"

namespace {

using namespace meniscus;

constexpr double kLambda = 4.0, kForce = 1.0, kWallRadius = 4.0;
constexpr double kU = 2.0 / 3.0 * kForce * (1.0 + kLambda) / (2.0 + 3.0 * kLambda);

// The liquid outside: a Stokeslet and a dipole, which add up to n·v = U n·e_x at r = 1.
Vec3 exact_velocity(const Vec3& x) {
  const double r = x.norm(), c = kU / (4.0 * (1.0 + kLambda));
  const Vec3 n = x / r, e = Vec3::UnitX();
  const double en = e.dot(n);
  return c *
         ((2.0 + 3.0 * kLambda) / r * (e + en * n) + kLambda / (r * r * r) * (e - 3.0 * en * n));
}

// The drop as both solvers take it. Lengths are in drop radii, stresses in the matrix's viscosity
// times the rate that the case has for its unit of time: here 1.
Scene drop_alone(int num_vertices) {
  Scene scene;
  scene.Ca = std::numeric_limits<double>::infinity();
  scene.liquids = Field<RegionId, Liquid>(2);
  scene.liquids[RegionId{1}].viscosity = kLambda;
  scene.liquids[RegionId{1}].body_force = Vec3(kForce, 0.0, 0.0);
  Interface drop;
  drop.mesh = sphere(num_vertices);
  drop.inside = RegionId{1};
  drop.outside = RegionId{0};
  drop.tension = 0.0;  // a sphere's tension drives nothing
  scene.interfaces.push_back(drop);
  return scene;
}

// Boundary integrals need the interface and nothing else: the liquid has no end.
FlowSolution by_boundary_integrals(Scene scene) {
  scene.is_unbounded = true;
  return bem::make_boundary_integral_flow({})->solve({.scene = scene}, {});
}

// Finite elements need walls. The exact flow is imposed on them, so that theory holds as it is:
// any function of place and time may stand here. `on_smooth_wall` tells curved elements where the
// wall is between its vertices.
FlowSolution by_finite_elements(Scene scene) {
  scene.boundary.mesh = sphere(300, kWallRadius);
  const auto imposed = [](const Vec3& x, double /*t*/) { return exact_velocity(x); };
  const auto on_wall = [](const Vec3& x) { return Vec3(kWallRadius * x.normalized()); };
  scene.boundary.patches.add({"wall", ImposedVelocity{imposed}, on_wall});
  scene.boundary.patch = FaceField<PatchId>(scene.boundary.mesh.num_faces(), PatchId{0});

  // A MovingMesh makes the tetrahedra, and in a run it moves them. Quadratic elements want small
  // cells around the drop.
  fem::Options options;
  options.elements = fem::Elements::p2_p1;
  MovingMesh mesh({.tetrahedra = fem::suited_volume_mesh(options.elements)});
  if (const MeshChange made = mesh.follow(scene); !made.ok()) throw RunFailure(made.text());
  const std::unique_ptr<FlowSolver> solver = fem::make_finite_element_flow(options);
  return solver->solve({.scene = scene, .mesh = &mesh.tetrahedra()}, {});
}

struct Errors {
  double speed;      ///< of U, relative
  double pointwise;  ///< largest of v at a vertex, over U
};

// Solvers give the velocity of the liquid at the interfaces' vertices. U is what fits n·v = U n·e_x
// best; the largest error at a vertex sees the flow along the surface too.
Errors errors(const SurfaceMesh& drop, const FlowSolution& flow) {
  if (!flow.ok()) throw RunFailure(flow.text());
  double product = 0.0, square = 0.0, largest = 0.0;
  for (const VertexId v : drop.x.ids()) {
    const Vec3 n = drop.x[v].normalized();
    product += n.x() * n.dot(flow.velocity[0][v]);
    square += n.x() * n.x();
    largest = std::max(largest, (flow.velocity[0][v] - exact_velocity(drop.x[v])).norm());
  }
  return {product / square / kU - 1.0, largest / kU};
}

// Errors at two resolutions: those of h and of h/2, for four times as many vertices.
bool converges(const char* name, FlowSolution (*solve)(Scene), double allowed) {
  Errors at[2];
  for (int i = 0; i < 2; ++i) {
    const int num_vertices = i == 0 ? 100 : 400;
    const Scene scene = drop_alone(num_vertices);
    at[i] = errors(scene.interfaces[0].mesh, solve(scene));
    std::printf("%s, %d vertices: U off by %+.1e, v by %.1e at most\n", name, num_vertices,
                at[i].speed, at[i].pointwise);
  }
  return std::abs(at[1].speed) < allowed && at[1].pointwise < allowed &&
         at[1].pointwise < 0.5 * at[0].pointwise;
}

}  // namespace

int main() {
  try {
    std::printf("theory: U = %.6f\n", kU);
    const bool are_right[] = {converges("boundary integrals", by_boundary_integrals, 1e-4),
                              converges("finite elements", by_finite_elements, 1e-3)};
    return are_right[0] && are_right[1] ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "one_solve: %s\n", error.what());
    return 2;
  }
}
