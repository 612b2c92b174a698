// Instantaneous growth rate of the wave on a thread, from one solve: thread_growth SURFACE K
// [LAMBDA]. The surface is one of cases/pinching-filament/make_surface.py --wavenumber K.
#include <cmath>
#include <cstdlib>
#include <numbers>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "meniscus/evolve/interface_motion.hpp"
#include "meniscus/flow/bem/boundary_integral_flow.hpp"
#include "meniscus/io/surface_file.hpp"
#include "meniscus/mesh/surface_measures.hpp"

using namespace meniscus;

namespace {

/// s = (1 − k²){I1 K1 + (k/2)[I1 K0 − I0 K1]} for λ = 1 (Stone and Brenner 1996).
double growth_rate(double k) {
  const double I0 = std::cyl_bessel_i(0.0, k), I1 = std::cyl_bessel_i(1.0, k),
               K0 = std::cyl_bessel_k(0.0, k), K1 = std::cyl_bessel_k(1.0, k);
  return (1.0 - k * k) * (I1 * K1 + 0.5 * k * (I1 * K0 - I0 * K1));
}

/// The coefficient of cos kx in the least-squares fit a + b cos kx + c sin kx of values at the
/// vertices of the middle wavelength, each with its area.
double amplitude(const SurfaceMesh& mesh, const VertexField<double>& values, double k) {
  const VertexField<double> areas = vertex_areas(mesh);
  Mat3 normal = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  for (const VertexId v : mesh.x.ids()) {
    const double phase = k * mesh.x[v].x();
    if (std::abs(phase) > std::numbers::pi) continue;
    const Vec3 basis(1.0, std::cos(phase), std::sin(phase));
    normal += areas[v] * basis * basis.transpose();
    right += areas[v] * values[v] * basis;
  }
  return normal.ldlt().solve(right)[1];
}

Scene scene_of(SurfaceMesh mesh, double lambda) {
  Scene scene;
  scene.is_unbounded = true;
  scene.liquids.add({});
  scene.liquids.add({.viscosity = lambda});
  Interface thread;
  thread.mesh = std::move(mesh);
  thread.inside = RegionId{1};
  thread.outside = RegionId{0};
  thread.volume = thread.initial_volume = enclosed_volume(thread.mesh);
  scene.interfaces.push_back(std::move(thread));
  return scene;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print("thread_growth SURFACE WAVENUMBER [LAMBDA]\n");
    return 2;
  }
  const double k = std::atof(argv[2]), lambda = argc > 3 ? std::atof(argv[3]) : 1.0;
  const Scene scene = scene_of(io::read_surface(argv[1]).mesh, lambda);
  const SurfaceMesh& mesh = scene.interfaces[0].mesh;
  const FlowSolution flow = bem::make_boundary_integral_flow({.threads = 2})->solve({scene}, {});
  if (!flow.ok()) return 1;
  const InterfaceMotion motion = normal_motion(scene, flow.velocity, MotionNormal::area_vector);
  VertexField<double> radius(mesh.num_vertices()), rate(mesh.num_vertices());
  for (const VertexId v : mesh.x.ids()) {
    const Vec3 across(0.0, mesh.x[v].y(), mesh.x[v].z());
    radius[v] = across.norm();
    // The rate of the radius at fixed x: w/(n·e) for normal motion w n.
    const Vec3& w = motion[0][v];
    rate[v] = radius[v] > 0.0 && w.norm() > 0.0 ? w.squaredNorm() / w.dot(across) * radius[v] : 0.0;
  }
  const double s = amplitude(mesh, rate, k) / amplitude(mesh, radius, k);
  fmt::print("k {:g}  vertices {}  wave {:.6f}  growth rate {:.6f}", k, mesh.num_vertices(),
             amplitude(mesh, radius, k), s);
  if (lambda == 1.0)
    fmt::print("  exact {:.6f}  error {:+.2f} %", growth_rate(k),
               100.0 * (s / growth_rate(k) - 1.0));
  fmt::print("\n");
  return 0;
}
