// A tension that varies along the surface, against the exact migration of a drop in a sphere.
#include <cmath>

#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/scene/interface_tension.hpp"
#include "meniscus/surface/reconstructed_surface.hpp"
#include "tests/flow/fem/sphere_scene.hpp"
#include "tests/flow/meshed_flow.hpp"

namespace meniscus::fem {
namespace {

constexpr double kGradient = 0.3, kElasticity = 0.5;

/// A drop of σ = 1 + s cos θ at the centre of a sphere of radius 3, s = `kGradient`.
Scene migrating_drop(int num_vertices, double lambda) {
  Scene scene = sphere_in_sphere(
      {.num_vertices = num_vertices, .outer_radius = 3.0, .viscosity_ratio = lambda});
  Interface& drop = scene.interfaces[0];
  drop.surfactant = Surfactant{LinearState{kElasticity}, 0.0};
  VertexField<double> concentration;
  for (const Vec3& x : drop.mesh.x) concentration.add(1.0 - kGradient * x.z() / kElasticity);
  drop.fields.on_vertices.push_back({.name = kSurfactantField,
                                     .unit = "",
                                     .transfer = FieldTransfer::conserved,
                                     .values = std::move(concentration)});
  return scene;
}

/// −s (b − 1)²(2b³ + 4b² + 6b + 3)/(3[(2 + 3λ)b⁵ + 3(1 − λ)]), b = 3.
double exact_speed(double lambda) {
  const double b = 3.0, b2 = b * b, b3 = b * b2;
  return -kGradient * (b - 1.0) * (b - 1.0) * (2.0 * b3 + 4.0 * b2 + 6.0 * b + 3.0) /
         (3.0 * ((2.0 + 3.0 * lambda) * b2 * b3 + 3.0 * (1.0 - lambda)));
}

Options exact_options(Elements elements) {
  Options options;
  options.elements = elements;
  options.rtol = 1e-8;
  return options;
}

double error(int num_vertices, double lambda, Elements elements) {
  const Scene scene = migrating_drop(num_vertices, lambda);
  const FlowSolution flow =
      test::flow_in(scene, exact_options(elements), {.tetrahedra = suited_volume_mesh(elements)});
  const SurfaceMesh& mesh = scene.interfaces[0].mesh;
  const VertexField<Vec3> area = vertex_area_vectors(mesh);
  double with_mode = 0.0, of_mode = 0.0;
  for (const VertexId v : mesh.x.ids()) {
    with_mode += area[v].dot(flow.velocity[0][v]) * mesh.x[v].z();
    of_mode += area[v].z() * mesh.x[v].z();
  }
  return std::abs(with_mode / of_mode / exact_speed(lambda) - 1.0);
}

TEST(Marangoni, MovesADropWithQuadraticElements) {
  for (const double lambda : {0.1, 1.0, 10.0}) {
    const double found = error(200, lambda, Elements::p2_p1);
    RecordProperty("lambda " + std::to_string(lambda), std::to_string(found));
    EXPECT_LT(found, 0.005) << lambda;
  }
}

TEST(Marangoni, MovesADropWithLinearElements) {
  const double coarse = error(440, 1.0, Elements::p1_p1), fine = error(1760, 1.0, Elements::p1_p1);
  EXPECT_LT(fine, 0.03) << coarse;
  EXPECT_GT(std::log2(coarse / fine), 0.7) << coarse << ' ' << fine;  // of first order
}

// The liquid spends ∮σ div_s u dS against tension: power in is none, and all is dissipated.
TEST(Marangoni, SpendsWhatIsDissipated) {
  const Scene scene = migrating_drop(200, 1.0);
  const FlowSolution flow = test::flow_in(scene, exact_options(Elements::p2_p1),
                                          {.tetrahedra = suited_volume_mesh(Elements::p2_p1)});
  ASSERT_TRUE(flow.power);
  const ReconstructedSurface faces(scene.interfaces[0].mesh, SurfaceShape::splined);
  const double spent = faces.tension_power(vertex_tension(scene.interfaces[0]), flow.velocity[0]);
  EXPECT_NEAR(spent / flow.power->dissipation, -1.0, 0.01);
}

}  // namespace
}  // namespace meniscus::fem
