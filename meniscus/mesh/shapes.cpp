#include "meniscus/mesh/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>
#include <Eigen/Geometry>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Outward triangulation of points in convex position, in their given order.
FaceField<FaceVertices> convex_hull_faces(const VertexField<Vec3>& x) {
  using Point = Kernel::Point_3;
  std::vector<Point> points;
  std::map<Point, VertexId> point_to_vertex;
  for (const VertexId v : x.ids()) {
    points.emplace_back(x[v].x(), x[v].y(), x[v].z());
    point_to_vertex.emplace(points.back(), v);
  }
  CGAL::Surface_mesh<Point> hull;
  CGAL::convex_hull_3(points.begin(), points.end(), hull);
  std::vector<FaceVertices> faces;
  for (const auto face : hull.faces()) {
    FaceVertices f;
    std::size_t k = 0;
    for (const auto v : hull.vertices_around_face(hull.halfedge(face))) {
      MENISCUS_ASSERT(k < 3, "hull facet with more than three vertices");
      f[k++] = point_to_vertex.at(hull.point(v));
    }
    std::ranges::rotate(f, std::ranges::min_element(f));
    faces.push_back(f);
  }
  std::ranges::sort(faces);
  return FaceField<FaceVertices>(std::move(faces));
}

/// Points of equal area along a spiral from pole to pole.
VertexField<Vec3> spiral_points(int count) {
  VertexField<Vec3> x;
  const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count, r = std::sqrt(1.0 - z * z);
    x.add(Vec3(r * std::cos(golden_angle * i), r * std::sin(golden_angle * i), z));
  }
  return x;
}

/// Moves each vertex to the centroid of the faces around it, back on the unit sphere.
void lloyd_sweep(SurfaceMesh& mesh) {
  VertexField<Vec3> moment(mesh.num_vertices(), Vec3::Zero());
  for (const FaceId f : mesh.faces.ids()) {
    const FaceVertices& v = mesh.faces[f];
    const Vec3 weighted =
        face_area_vector(mesh, f).norm() * (mesh.x[v[0]] + mesh.x[v[1]] + mesh.x[v[2]]);
    for (const VertexId k : v) moment[k] += weighted;
  }
  for (const VertexId v : mesh.x.ids()) mesh.x[v] = moment[v].normalized();
  mesh.faces = convex_hull_faces(mesh.x);
}

constexpr int kLloydSweeps = 10;  // spacing varies by under 10 % afterwards; more changes little

/// Collects faces whose corners are given as points; points closer than `tolerance` are one vertex.
class PatchBuilder {
 public:
  explicit PatchBuilder(double tolerance) : tolerance_(tolerance) {}

  VertexId vertex(const Vec3& p) {
    const std::array<std::int64_t, 3> key{std::llround(p.x() / tolerance_),
                                          std::llround(p.y() / tolerance_),
                                          std::llround(p.z() / tolerance_)};
    const auto [entry, is_new] = key_to_vertex_.try_emplace(key, VertexId{surface_.mesh.x.size()});
    if (is_new) surface_.mesh.x.add(p);
    return entry->second;
  }
  void triangle(const Vec3& a, const Vec3& b, const Vec3& c, int tag) {
    surface_.mesh.faces.add({vertex(a), vertex(b), vertex(c)});
    surface_.tag.add(tag);
  }
  /// Quadrilateral a b c d, counter-clockwise from outside, cut along the diagonal that `parity`
  /// picks.
  void quadrilateral(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, int tag,
                     bool parity) {
    if (parity) {
      triangle(a, b, c, tag);
      triangle(a, c, d, tag);
    } else {
      triangle(a, b, d, tag);
      triangle(b, c, d, tag);
    }
  }
  TaggedSurface take() { return std::move(surface_); }

 private:
  double tolerance_;
  TaggedSurface surface_;
  std::map<std::array<std::int64_t, 3>, VertexId> key_to_vertex_;
};

/// Points at equal angles about the x axis; one point where the radius is zero.
struct Ring {
  double x, radius;
  int count;

  [[nodiscard]] Vec3 point(int k) const {
    const double angle = 2.0 * std::numbers::pi * (k % count) / count;
    return {x, radius * std::cos(angle), radius * std::sin(angle)};
  }
};

void add_cylinder_side(PatchBuilder& builder, double radius, double half_length, int around,
                       int along) {
  const auto ring = [&](int i) {
    return Ring{half_length * (2.0 * i / along - 1.0), radius, around};
  };
  for (int i = 0; i < along; ++i)
    for (int k = 0; k < around; ++k)
      builder.quadrilateral(ring(i).point(k), ring(i).point(k + 1), ring(i + 1).point(k + 1),
                            ring(i + 1).point(k), 0, (i + k) % 2 == 0);
}

/// Fills the annulus between two rings of one end (0: lower x, 1: upper) with triangles: the ring
/// that lags behind advances.
void stitch_rings(PatchBuilder& builder, const Ring& inner, const Ring& outer, int end) {
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    end == 1 ? builder.triangle(a, b, c, 2) : builder.triangle(a, c, b, 1);
  };
  int i = 0, j = 0;
  while (j < outer.count || (inner.count > 1 && i < inner.count)) {
    const bool advance_outer =
        inner.count == 1 || i == inner.count ||
        (j < outer.count && double(j + 1) / outer.count <= double(i + 1) / inner.count);
    if (advance_outer) {
      add(inner.point(i), outer.point(j), outer.point(j + 1));
      ++j;
    } else {
      add(inner.point(i), outer.point(j), inner.point(i + 1));
      ++i;
    }
  }
}

}  // namespace

SurfaceMesh sphere(int num_vertices, double radius, const Vec3& center) {
  return stretched_sphere(num_vertices, Vec3::Constant(radius), center);
}

SurfaceMesh stretched_sphere(int num_vertices, const Vec3& axes, const Vec3& center) {
  if (num_vertices < 12) reject_input("a sphere needs at least 12 vertices, not {}", num_vertices);
  SurfaceMesh mesh;
  mesh.x = spiral_points(num_vertices);
  mesh.faces = convex_hull_faces(mesh.x);
  for (int sweep = 0; sweep < kLloydSweeps; ++sweep) lloyd_sweep(mesh);
  for (Vec3& x : mesh.x) x = center + axes.cwiseProduct(x);
  return mesh;
}

TaggedSurface box(int num_vertices, const Vec3& half_widths) {
  // A structured box with n quads along the mean edge has 6n² + 2 vertices.
  const double mean = std::cbrt(half_widths.prod());
  const double per_edge = std::sqrt(std::max(6.0, num_vertices - 2.0) / 6.0);
  std::array<int, 3> n;
  for (int k = 0; k < 3; ++k)
    n[static_cast<std::size_t>(k)] =
        std::max(1, static_cast<int>(std::lround(per_edge * half_widths[k] / mean)));
  PatchBuilder builder(1e-9 * half_widths.minCoeff());
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const int nu = n[static_cast<std::size_t>(u)], nv = n[static_cast<std::size_t>(v)];
    for (int side = 0; side < 2; ++side)
      for (int i = 0; i < nu; ++i)
        for (int j = 0; j < nv; ++j) {
          const auto point = [&](int a, int b) {
            Vec3 p;
            p[axis] = side == 0 ? -half_widths[axis] : half_widths[axis];
            p[u] = half_widths[u] * (2.0 * a / nu - 1.0);
            p[v] = half_widths[v] * (2.0 * b / nv - 1.0);
            return p;
          };
          const int tag = 2 * axis + side;
          if (side == 1)
            builder.quadrilateral(point(i, j), point(i + 1, j), point(i + 1, j + 1),
                                  point(i, j + 1), tag, (i + j) % 2 == 0);
          else
            builder.quadrilateral(point(i, j), point(i, j + 1), point(i + 1, j + 1),
                                  point(i + 1, j), tag, (i + j) % 2 == 0);
        }
  }
  return builder.take();
}

TaggedSurface cylinder(int num_vertices, double radius, double half_length) {
  // Edge length h of equilateral faces that give this many vertices on the whole area.
  const double area = 2.0 * std::numbers::pi * radius * (2.0 * half_length + radius);
  const double h = std::sqrt(2.0 * area / (std::sqrt(3.0) * num_vertices));
  const int around =
      std::max(8, static_cast<int>(std::lround(2.0 * std::numbers::pi * radius / h)));
  const int along = std::max(2, static_cast<int>(std::lround(2.0 * half_length / h)));
  const int rings = std::max(1, static_cast<int>(std::lround(radius / h)));
  PatchBuilder builder(1e-9 * std::min(radius, half_length));
  add_cylinder_side(builder, radius, half_length, around, along);
  for (int end = 0; end < 2; ++end) {
    const double x = end == 0 ? -half_length : half_length;
    const auto ring = [&](int number) {
      const int count =
          number == rings ? around
          : number == 0
              ? 1
              : std::max(5, static_cast<int>(std::lround(double(around) * number / rings)));
      return Ring{x, radius * number / rings, count};
    };
    for (int number = 0; number < rings; ++number)
      stitch_rings(builder, ring(number), ring(number + 1), end);
  }
  return builder.take();
}

}  // namespace meniscus
