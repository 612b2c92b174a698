#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "meniscus/flow/bem/face_moments.hpp"
#include "meniscus/flow/bem/near_field.hpp"
#include "tests/flow/bem/drop_scenes.hpp"

namespace meniscus::bem {
namespace {

constexpr double kPi = std::numbers::pi;

/// Smooth densities to integrate over the unit sphere about `kCenter`.
const Vec3 kCenter(0.0, 0.0, 0.0);
double scalar_density(const Vec3& x) { return x.x() * x.z() + 0.5 * x.y() * x.y() * x.z() + x.z(); }
Vec3 vector_density(const Vec3& x) {
  return {x.z() * x.z() - x.x(), x.x() * x.y() + 0.3, 0.7 * x.z() + x.y() * x.z()};
}

struct Layers {
  Vec3 single = Vec3::Zero(), dual = Vec3::Zero();
};

/// Gauss-Legendre with five points on [a, b] of a function of the polar angle.
template <class Function>
void integrate(double a, double b, Function&& add) {
  constexpr std::array<double, 5> x = {-0.9061798459386640, -0.5384693101056831, 0.0,
                                       0.5384693101056831, 0.9061798459386640};
  constexpr std::array<double, 5> w = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                       0.4786286704993665, 0.2369268850561891};
  for (std::size_t i = 0; i < x.size(); ++i)
    add(0.5 * (a + b) + 0.5 * (b - a) * x[i], 0.5 * (b - a) * w[i]);
}

/// The layers of the exact sphere at a point outside it, in polar coordinates about the nearest
/// point: panels in the polar angle that double from an eighth of the gap, 128 azimuths. Relative
/// error below 1e-7, found by halving the panels.
Layers exact_layers(const Vec3& target) {
  Layers sum;
  const Vec3 axis = (target - kCenter).normalized(), e1 = axis.unitOrthogonal(),
             e2 = axis.cross(e1);
  const double gap = (target - kCenter).norm() - 1.0;
  constexpr int kAzimuths = 128;
  const auto ring = [&](double angle, double weight) {
    for (int k = 0; k < kAzimuths; ++k) {
      const double phi = 2.0 * kPi * k / kAzimuths;
      const Vec3 n =
          std::cos(angle) * axis + std::sin(angle) * (std::cos(phi) * e1 + std::sin(phi) * e2);
      const Vec3 y = kCenter + n;
      const LayerKernels kernels =
          layer_kernels(y - target, weight * std::sin(angle) * 2.0 * kPi / kAzimuths * n);
      sum.single += scalar_density(y) * kernels.single;
      sum.dual += kernels.dual * vector_density(y);
    }
  };
  double edge = 0.0, width = 0.125 * gap;
  while (edge < kPi) {
    const double end = std::min({edge + width, edge + 0.1, kPi});
    integrate(edge, end, ring);
    edge = end;
    width *= edge > 2.0 * gap ? 1.25 : 1.0;
  }
  return sum;
}

/// Largest error of the layers of the sphere at the vertices of another sphere `gap` away, over the
/// largest value.
struct LayerErrors {
  double single = 0.0, dual = 0.0;
};
LayerErrors layer_errors(int num_vertices, double gap) {
  Scene scene = test::unbounded_scene(Mat3::Zero());
  test::add_drop(scene, sphere(num_vertices, 1.0, kCenter), 0.1, 1.0);
  test::add_drop(scene, sphere(num_vertices, 1.0, kCenter + (2.0 + gap) * Vec3::UnitZ()), 0.1, 1.0);
  const BoundaryGeometry geometry = make_geometry(scene);
  std::vector<double> q(static_cast<std::size_t>(geometry.size()), 0.0);
  SourceVectors u(geometry.size());
  for (std::int32_t j = 0; j < geometry.surfaces[0].range.end; ++j) {
    const auto at = static_cast<std::size_t>(j);
    q[at] = scalar_density(geometry.points.point(j));
    const Vec3 value = vector_density(geometry.points.point(j));
    u.x[at] = value.x();
    u.y[at] = value.y();
    u.z[at] = value.z();
  }
  const std::vector<NearRow> rows =
      near_rows(geometry, q, {true, true}, SharedPoints(geometry.size()));
  LayerErrors error, size;
  for (std::int32_t i = geometry.surfaces[1].range.begin; i < geometry.size(); ++i) {
    const Vec3 x = geometry.points.point(i);
    if ((x - kCenter).norm() > 2.0) continue;  // the far side says nothing new
    const Layers exact = exact_layers(x);
    const NearRow& row = rows[static_cast<std::size_t>(i)];
    const Vec3 single = single_layer_sum(geometry.points, q, x) + row.single;
    Vec3 dual = double_layer_sum(geometry.points, u, x);
    for (std::size_t c = 0; c < row.columns.size(); ++c) {
      const auto j = static_cast<std::size_t>(row.columns[c]);
      dual += row.dual[c] * Vec3(u.x[j], u.y[j], u.z[j]);
    }
    error.single = std::max(error.single, (single - exact.single).norm());
    error.dual = std::max(error.dual, (dual - exact.dual).norm());
    size.single = std::max(size.single, exact.single.norm());
    size.dual = std::max(size.dual, exact.dual.norm());
  }
  return {error.single / size.single, error.dual / size.dual};
}

// Largest errors measured over all gaps: single 4.5e-4 and 3e-5, double 2.6e-3 and 4e-4 of the
// largest value, at 250 and 1000 vertices. The vertices' own spacing is 0.2 and 0.1.
TEST(NearContact, LayersOfACloseSphereAreAccurateAtAnyGap) {
  for (const double gap : {0.3, 0.03, 0.01, 0.003}) {
    const LayerErrors coarse = layer_errors(250, gap), fine = layer_errors(1000, gap);
    EXPECT_LT(coarse.single, 8e-4) << gap;
    EXPECT_LT(coarse.dual, 5e-3) << gap;
    EXPECT_LT(fine.single, 6e-5) << gap;
    EXPECT_LT(fine.dual, 8e-4) << gap;
  }
}

// Symmetry of an approach that the discretisation does not know of: meshes of the two drops differ.
TEST(NearContact, TwoDropsPushedTogetherMoveAsMirrorImages) {
  constexpr double kGap = 0.02;
  Scene scene = test::unbounded_scene(Vec3(1.0, 1.0, -2.0).asDiagonal());
  SurfaceMesh above = sphere(600, 1.0, (1.0 + 0.5 * kGap) * Vec3::UnitZ()),
              below = sphere(500, 1.0, -(1.0 + 0.5 * kGap) * Vec3::UnitZ());
  test::add_drop(scene, above, 0.3, 5.0);
  test::add_drop(scene, below, 0.3, 5.0);
  const auto u = test::solved(scene).u;
  const auto approach = [&](std::size_t drop) {
    const InterfaceElements elements = make_elements(scene.interfaces[drop].mesh);
    double flux = 0.0, volume = 0.0;
    for (const VertexId v : u[drop].ids()) {
      const Vec3& x = elements.x[v];
      flux += elements.weight[v] * x.z() * elements.n[v].dot(u[drop][v]);
      volume += elements.weight[v] * x.dot(elements.n[v]) / 3.0;
    }
    return flux / volume;  // velocity of the centroid
  };
  EXPECT_LT(approach(0), 0.0);
  EXPECT_NEAR(approach(0), -approach(1), 1e-3 * std::abs(approach(1)));
}

}  // namespace
}  // namespace meniscus::bem
