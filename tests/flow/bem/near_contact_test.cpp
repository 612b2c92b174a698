#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "meniscus/flow/bem/face_moments.hpp"
#include "meniscus/flow/bem/near_field.hpp"
#include "meniscus/geometry/quadrature.hpp"
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
  Vec3 single = Vec3::Zero(), double_layer = Vec3::Zero();
};

/// Gauss-Legendre with five points on [a, b] of a function of the polar angle.
template <class Function>
void integrate(double a, double b, Function&& add) {
  static const std::vector<GaussPoint> kPoints = gauss_legendre(5);
  for (const auto& [x, weight] : kPoints) add(a + (b - a) * x, (b - a) * weight);
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
      sum.double_layer += kernels.double_layer * vector_density(y);
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

/// The layers of densities given at the nodes, at a point, by the plain sums and the near rows.
Layers layers_by_rows(const BoundaryGeometry& geometry, const std::vector<double>& q,
                      const SourceVectors& u, const std::vector<NearRow>& rows, std::int32_t i) {
  const Vec3 x = geometry.nodes.point(i);
  const NearRow& row = rows[static_cast<std::size_t>(i)];
  Layers sum{.single = single_layer_sum(geometry.nodes, q, x) + row.single,
             .double_layer = double_layer_sum(geometry.nodes, u, x)};
  for (std::size_t c = 0; c < row.columns.size(); ++c)
    sum.double_layer += row.double_layer[c] * u.at(row.columns[c]);
  return sum;
}

/// Largest error of the layers of the sphere at the vertices of another sphere `gap` away, over the
/// largest value.
struct LayerErrors {
  double single = 0.0, double_layer = 0.0;
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
    q[at] = scalar_density(geometry.nodes.point(j));
    u.set(j, vector_density(geometry.nodes.point(j)));
  }
  q = geometry.at_nodes(q);
  u = geometry.at_nodes(u);
  const std::vector<NearRow> rows =
      near_rows(geometry, q, {true, true}, SharedPoints(geometry.size()));
  LayerErrors error, size;
  for (std::int32_t i = geometry.surfaces[1].range.begin; i < geometry.size(); ++i) {
    const Vec3 x = geometry.nodes.point(i);
    if ((x - kCenter).norm() > 2.0) continue;  // the far side says nothing new
    const Layers exact = exact_layers(x);
    const Layers given = layers_by_rows(geometry, q, u, rows, i);
    error.single = std::max(error.single, (given.single - exact.single).norm());
    error.double_layer =
        std::max(error.double_layer, (given.double_layer - exact.double_layer).norm());
    size.single = std::max(size.single, exact.single.norm());
    size.double_layer = std::max(size.double_layer, exact.double_layer.norm());
  }
  return {error.single / size.single, error.double_layer / size.double_layer};
}

// Largest errors measured over all gaps: single 2.4e-4 and 1.5e-5, double 2.5e-3 and 1.6e-4 of the
// largest value, at 250 and 1000 vertices. The vertices' own spacing is 0.2 and 0.1.
TEST(NearContact, LayersOfACloseSphereAreAccurateAtAnyGap) {
  for (const double gap : {0.3, 0.03, 0.01, 0.003}) {
    const LayerErrors coarse = layer_errors(250, gap), fine = layer_errors(1000, gap);
    EXPECT_LT(coarse.single, 5e-4) << gap;
    EXPECT_LT(coarse.double_layer, 5e-3) << gap;
    EXPECT_LT(fine.single, 3e-5) << gap;
    EXPECT_LT(fine.double_layer, 4e-4) << gap;
  }
}

/// A disc of radius 1.2 and thickness 0.4, folded about the y-axis until its halves are 0.4 apart:
/// z goes through the disc, and its middle plane winds around a half circle of radius 0.4.
Vec3 folded(const Vec3& on_sphere) {
  constexpr double kRadius = 0.4, kEnd = 0.5 * kPi * kRadius;
  const double along = 1.2 * on_sphere.x(), out = kRadius + 0.2 * on_sphere.z();
  const double bend = std::clamp(along, -kEnd, kEnd), rest = along - bend;
  const Vec3 tangent(std::cos(bend / kRadius), 0.0, -std::sin(bend / kRadius));
  return out * Vec3(-tangent.z(), 0.0, tangent.x()) + Vec3(0.0, 1.2 * on_sphere.y(), 0.0) +
         rest * tangent;
}

/// The layers of densities given at the nodes of a surface, at its point i: every face by the rule
/// of near ones, and what a constant density misses subtracted as near_rows does.
Layers layers_by_near_rule(const BoundaryGeometry& geometry, const std::vector<double>& q,
                           const SourceVectors& u, std::int32_t i) {
  const InterfaceElements& elements = geometry.surfaces[0].elements;
  const Vec3 x = geometry.nodes.point(i), u_here = u.at(i);
  const double q_here = q[static_cast<std::size_t>(i)];
  Layers sum;
  for (const FaceId f : elements.faces.ids()) {
    const InterfaceElements::Face& face = elements.faces[f];
    const auto own = std::ranges::find(elements.corners[f], VertexId{i});
    const auto corner = static_cast<std::size_t>(own - elements.corners[f].begin());
    NodeValues rest = geometry.on_face(0, f, q);
    for (double& value : rest) value -= q_here;
    const FaceMoments moments = face_moments(face, corner, x, rest, true);
    sum.single += moments.single;
    const auto nodes = geometry.nodes_of(0, f);
    for (std::size_t a = 0; a < nodes.size(); ++a)
      sum.double_layer += moments.double_layer[a] * (u.at(nodes[a]) - u_here);
  }
  sum.double_layer += 2.0 * kPi / 3.0 * u_here;
  return sum;
}

/// Largest error of the layers, over their largest value, at points in the folded drop's film, away
/// from fold and rim. The density differs between sheets.
LayerErrors errors_in_own_film(int num_vertices) {
  SurfaceMesh mesh = sphere(num_vertices);
  const VertexField<Vec3> parameter = mesh.x;
  for (Vec3& x : mesh.x) x = folded(x);
  Scene scene = test::unbounded_scene(Mat3::Zero());
  test::add_drop(scene, mesh, 0.1, 1.0);
  const BoundaryGeometry geometry = make_geometry(scene);
  std::vector<double> q;
  SourceVectors u(geometry.size());
  for (const VertexId v : parameter.ids()) {
    q.push_back(scalar_density(parameter[v]));
    u.set(v.value, vector_density(parameter[v]));
  }
  q = geometry.at_nodes(q);
  u = geometry.at_nodes(u);
  const std::vector<NearRow> rows = near_rows(geometry, q, {true}, SharedPoints(geometry.size()));
  LayerErrors error, size;
  for (std::int32_t i = 0; i < geometry.size(); ++i) {
    if (const Vec3& at = parameter[VertexId{i}]; at.z() > -0.5 || std::abs(at.x()) < 0.5) continue;
    const Layers exact = layers_by_near_rule(geometry, q, u, i);
    const Layers given = layers_by_rows(geometry, q, u, rows, i);
    error.single = std::max(error.single, (given.single - exact.single).norm());
    error.double_layer =
        std::max(error.double_layer, (given.double_layer - exact.double_layer).norm());
    size.single = std::max(size.single, exact.single.norm());
    size.double_layer = std::max(size.double_layer, exact.double_layer.norm());
  }
  return {error.single / size.single, error.double_layer / size.double_layer};
}

// Across the film the point's own surface comes back as another sheet, 2.5 and 3.5 edges away.
// Largest errors measured with 500 and 1000 vertices: single 1.3e-4 and 6.5e-5, double 5.4e-4 and
// 2.0e-4.
TEST(NearContact, LayersInADropsOwnFilmAreThoseOfAFinerRule) {
  struct Expected {
    int num_vertices;
    double single, double_layer;
  };
  for (const auto& [num_vertices, single, double_layer] :
       {Expected{500, 3e-4, 1.1e-3}, Expected{1000, 1.3e-4, 4e-4}}) {
    const LayerErrors errors = errors_in_own_film(num_vertices);
    EXPECT_LT(errors.single, single) << num_vertices;
    EXPECT_LT(errors.double_layer, double_layer) << num_vertices;
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
