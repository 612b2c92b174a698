#include "tests/surface/smooth_shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/isotropic_remesh.hpp"

namespace meniscus::test {
namespace {

Vec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  return Vec3(x, y, z).normalized();
}

double legendre(int degree, double x) {
  double before = 1.0, p = x;
  for (int l = 1; l < degree; ++l) {
    const double next = ((2 * l + 1) * x * p - l * before) / (l + 1);
    before = p;
    p = next;
  }
  return p;
}

double softplus(double x) { return std::max(x, 0.0) + std::log1p(std::exp(-std::abs(x))); }

struct Capsule {
  Vec3 a, b;
  double radius;
  [[nodiscard]] double distance(const Vec3& x) const {
    // Place along the axis, 0 to 1 as a clamp but smooth, over the length of a radius: where a
    // cylinder met a hemisphere the curvature would jump.
    const Vec3 axis = b - a;
    const double sharpness = 3.0 * axis.norm() / radius;
    const double t = (x - a).dot(axis) / axis.squaredNorm();
    const double s = (softplus(sharpness * t) - softplus(sharpness * (t - 1.0))) / sharpness;
    return (x - a - s * axis).norm() - radius;
  }
};

Vec3 gradient_at(const std::function<double(const Vec3&)>& level, const Vec3& x, double h) {
  Vec3 g;
  for (int i = 0; i < 3; ++i)
    g[i] = (level(x + h * Vec3::Unit(i)) - level(x - h * Vec3::Unit(i))) / (2.0 * h);
  return g;
}

/// Newton steps along the gradient to the zero level.
Vec3 on_level(const std::function<double(const Vec3&)>& level, Vec3 x) {
  for (int i = 0; i < 4; ++i) {
    const Vec3 g = gradient_at(level, x, 1e-5);
    x -= level(x) / g.squaredNorm() * g;
  }
  return x;
}

/// The zero level where it crosses the edges of tetrahedra, six to each cube of a grid.
class MarchingTetrahedra {
 public:
  MarchingTetrahedra(const std::function<double(const Vec3&)>& level, const Vec3& center,
                     double reach, double h)
      : origin_(center - Vec3::Constant(reach)),
        h_(h),
        n_(static_cast<int>(std::ceil(2.0 * reach / h)) + 1),
        values_(static_cast<std::size_t>(n_ * n_ * n_)) {
    for (int p = 0; p < n_ * n_ * n_; ++p) values_[static_cast<std::size_t>(p)] = level(at(p));
    for (int k = 0; k + 1 < n_; ++k)
      for (int j = 0; j + 1 < n_; ++j)
        for (int i = 0; i + 1 < n_; ++i) cut_cube(i + n_ * (j + n_ * k));
  }
  SurfaceMesh mesh;

 private:
  [[nodiscard]] Vec3 at(int p) const {
    return origin_ + h_ * Vec3(p % n_, p / n_ % n_, p / n_ / n_);
  }
  [[nodiscard]] double value(int p) const { return values_[static_cast<std::size_t>(p)]; }

  /// The six tetrahedra go along the edges from corner 0 to corner 7, one axis after another.
  void cut_cube(int p) {
    const std::array<int, 3> step{1, n_, n_ * n_};
    for (const auto& [a, b] : {std::pair(0, 1), {1, 2}, {2, 0}, {1, 0}, {2, 1}, {0, 2}}) {
      const int q = p + step[static_cast<std::size_t>(a)];
      cut({p, q, q + step[static_cast<std::size_t>(b)], p + step[0] + step[1] + step[2]});
    }
  }
  void cut(std::array<int, 4> corner) {
    std::ranges::sort(corner, {}, [&](int p) { return value(p) >= 0.0; });  // the inner ones first
    const auto inner = std::ranges::count_if(corner, [&](int p) { return value(p) < 0.0; });
    const auto [a, b, c, d] = corner;
    if (inner == 1) add({crossing(a, b), crossing(a, c), crossing(a, d)}, at(a));
    if (inner == 3) add({crossing(a, d), crossing(b, d), crossing(c, d)}, at(a));
    if (inner == 2) {
      const VertexId ac = crossing(a, c), ad = crossing(a, d), bc = crossing(b, c),
                     bd = crossing(b, d);
      add({ac, ad, bd}, at(a));
      add({ac, bd, bc}, at(a));
    }
  }
  /// The new vertices lie well within their edges, so that no face degenerates.
  VertexId crossing(int p, int q) {
    const auto [entry, is_new] = crossings_.try_emplace(std::minmax(p, q));
    if (is_new) {
      const double s = std::clamp(value(p) / (value(p) - value(q)), 0.1, 0.9);
      entry->second = mesh.x.add(at(p) + s * (at(q) - at(p)));
    }
    return entry->second;
  }
  /// `inside` lies within; the face is turned away from it.
  void add(FaceVertices face, const Vec3& inside) {
    const Vec3 &a = mesh.x[face[0]], area = (mesh.x[face[1]] - a).cross(mesh.x[face[2]] - a);
    if (area.dot(a - inside) < 0.0) std::swap(face[1], face[2]);
    mesh.faces.add(face);
  }

  Vec3 origin_;
  double h_;
  int n_;
  std::vector<double> values_;
  std::map<std::pair<int, int>, VertexId> crossings_;
};

/// The zero level by even triangles of edges about `edge`.
SurfaceMesh meshed_level(const std::function<double(const Vec3&)>& level, const Vec3& center,
                         double reach, double edge) {
  SurfaceMesh mesh = MarchingTetrahedra(level, center, reach, 0.7 * edge).mesh;
  for (Vec3& x : mesh.x) x = on_level(level, x);
  // In one of two hundred shapes evening leaves a needle, which the way to the level folds over:
  // the next pass is not to take it for a crease.
  constexpr double kEvenAngleDeg = 20.0, kNoCreasesDeg = 180.0;
  constexpr int kMostPasses = 5;
  for (int pass = 0; pass < kMostPasses; ++pass) {
    mesh = pass == 0 ? isotropic_remesh(mesh, edge) : isotropic_remesh(mesh, edge, kNoCreasesDeg);
    for (Vec3& x : mesh.x) x = on_level(level, x);
    if (smallest_angle_deg(mesh) > kEvenAngleDeg) break;
  }
  return mesh;
}

Mat3 hessian_at(const std::function<double(const Vec3&)>& level, const Vec3& x, double h) {
  Mat3 hessian;
  const double here = level(x);
  for (int i = 0; i < 3; ++i) {
    const Vec3 p = h * Vec3::Unit(i);
    hessian(i, i) = (level(x + p) - 2.0 * here + level(x - p)) / (h * h);
    for (int j = 0; j < i; ++j) {
      const Vec3 q = h * Vec3::Unit(j);
      hessian(i, j) = hessian(j, i) =
          (level(x + p + q) - level(x + p - q) - level(x - p + q) + level(x - p - q)) /
          (4.0 * h * h);
    }
  }
  return hessian;
}

}  // namespace

SmoothShape random_star(std::mt19937& random, int num_vertices, double amplitude) {
  constexpr int kWaves = 8;
  struct Wave {
    Vec3 axis;
    int degree;
    double size;
  };
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<Wave> waves;
  double total = 0.0;
  for (int k = 0; k < kWaves; ++k) {
    const Vec3 axis = random_direction(random);
    const int degree = 2 + k % 4;
    // Equal slopes: the higher harmonics are the smaller ones.
    waves.push_back({axis, degree, uniform(random) / degree});
    total += std::abs(waves.back().size);
  }
  for (Wave& wave : waves) wave.size *= amplitude / total;
  const auto radius = [waves](const Vec3& direction) {
    double r = 1.0;
    for (const Wave& wave : waves) r += wave.size * legendre(wave.degree, wave.axis.dot(direction));
    return r;
  };
  SmoothShape shape;
  shape.level = [radius](const Vec3& x) { return x.norm() - radius(x.normalized()); };
  shape.mesh = sphere(num_vertices);
  for (Vec3& x : shape.mesh.x) x *= radius(x);
  return shape;
}

SmoothShape random_chain(std::mt19937& random, int num_vertices) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Capsule> chain;
  const int count = 2 + static_cast<int>(3.0 * uniform(random));
  Vec3 end = Vec3::Zero(), direction = random_direction(random);
  for (int k = 0; k < count; ++k) {
    const double length = 0.6 + 0.8 * uniform(random), radius = 0.25 + 0.35 * uniform(random);
    chain.push_back({end, end + length * direction, radius});
    end = chain.back().b;
    direction = (direction + 0.8 * random_direction(random)).normalized();
  }
  constexpr double kSharpness = 4.0;  // of the joints: radii of about 1/4 of the unit
  SmoothShape shape;
  shape.level = [chain](const Vec3& x) {
    double sum = 0.0;
    for (const Capsule& capsule : chain) sum += std::exp(-kSharpness * capsule.distance(x));
    return -std::log(sum) / kSharpness;
  };
  Vec3 center = Vec3::Zero();
  for (const Capsule& c : chain) center += 0.5 * (c.a + c.b) / count;
  double area = 0.0, reach = 0.0;
  for (const Capsule& c : chain) {
    area += 2.0 * std::numbers::pi * c.radius * ((c.b - c.a).norm() + c.radius);
    for (const Vec3& end_point : {c.a, c.b})
      reach = std::max(reach, (end_point - center).cwiseAbs().maxCoeff() + c.radius + 0.2);
  }
  // Even triangles of edge h leave each vertex √3/2 h² of the area.
  const double edge = std::sqrt(area / num_vertices / 0.866);
  shape.mesh = meshed_level(shape.level, center, reach, edge);
  return shape;
}

SmoothShape refined(const SmoothShape& shape) {
  SmoothShape result{shape.level, {}};
  result.mesh.x = shape.mesh.x;
  std::map<std::pair<VertexId, VertexId>, VertexId> middles;
  const auto middle = [&](VertexId a, VertexId b) {
    const auto [entry, is_new] = middles.try_emplace(std::minmax(a, b));
    if (is_new)
      entry->second =
          result.mesh.x.add(on_level(shape.level, 0.5 * (shape.mesh.x[a] + shape.mesh.x[b])));
    return entry->second;
  };
  for (const FaceVertices& v : shape.mesh.faces) {
    const VertexId a = middle(v[0], v[1]), b = middle(v[1], v[2]), c = middle(v[2], v[0]);
    result.mesh.faces.add({v[0], a, c});
    result.mesh.faces.add({v[1], b, a});
    result.mesh.faces.add({v[2], c, b});
    result.mesh.faces.add({a, b, c});
  }
  return result;
}

SmoothShape affine_image(const SmoothShape& shape, const Mat3& map, const Vec3& shift) {
  SmoothShape result = shape;
  const Mat3 back = map.inverse();
  result.level = [level = shape.level, back, shift](const Vec3& x) {
    return level(back * (x - shift));
  };
  for (Vec3& x : result.mesh.x) x = map * x + shift;
  return result;
}

LevelCurvature::LevelCurvature(const SmoothShape& shape)
    : gradient_(shape.mesh.num_vertices()), hessian_(shape.mesh.num_vertices()) {
  constexpr double kStep = 1e-3;
  for (const VertexId v : shape.mesh.x.ids()) {
    gradient_[v] = gradient_at(shape.level, shape.mesh.x[v], kStep);
    hessian_[v] = hessian_at(shape.level, shape.mesh.x[v], kStep);
  }
}

VertexField<double> LevelCurvature::squared_rms(const Mat3& map) const {
  const Mat3 back = map.inverse();
  VertexField<double> result(gradient_.size());
  for (const VertexId v : result.ids()) {
    const Vec3 g = back.transpose() * gradient_[v];
    const Vec3 n = g.normalized();
    const Mat3 tangent = Mat3::Identity() - n * n.transpose();
    const Mat3 shape = tangent * (back.transpose() * hessian_[v] * back) * tangent / g.norm();
    result[v] = 0.5 * shape.squaredNorm();
  }
  return result;
}

VertexField<double> smooth_vertex_areas(const SurfaceMesh& mesh) {
  VertexField<Vec3> normals = vertex_area_vectors(mesh);
  for (Vec3& n : normals) n.normalize();
  VertexField<double> areas(mesh.num_vertices(), 0.0);
  for (const FaceId f : mesh.faces.ids()) {
    const FaceVertices& v = mesh.faces[f];
    double turning = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
      turning += (normals[v[k]] - normals[v[(k + 1) % 3]]).squaredNorm();
    const double third = face_area_vector(mesh, f).norm() * (1.0 + turning / 24.0) / 3.0;
    for (const VertexId w : v) areas[w] += third;
  }
  return areas;
}

}  // namespace meniscus::test
