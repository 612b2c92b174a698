#include "tests/flow/fem/sphere_experiments.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <Eigen/Dense>

#include "meniscus/flow/fem/finite_element_flow.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "tests/flow/fem/analytic_middles.hpp"
#include "tests/flow/fem/lamb_mode.hpp"

namespace meniscus::fem {
namespace {

// Walls at 2 to 5 radii are part of the problem: somewhat finer than the size law would have them.
constexpr double wall_vertices = 1.25;

struct Solved {
  MovingMesh mesh;
  FlowSolution flow;
};
Solved solved(const Scene& scene, const Method& method) {
  Options options;
  options.elements = method.elements;
  options.capillary = method.form;
  options.rtol = method.rtol;
  MovingMesh mesh({.tetrahedra = method.volume_mesh});
  if (const MeshChange made = mesh.follow(scene); !made.ok()) throw std::runtime_error(made.text());
  FlowSolution flow =
      make_finite_element_flow(options)->solve({.scene = scene, .mesh = &mesh.tetrahedra()}, {});
  if (!flow.ok()) throw std::runtime_error(flow.text());
  return {std::move(mesh), std::move(flow)};
}

/// Weighted least squares of values at points of the unit sphere by P_0 … P_5 of the angle to the
/// x-axis; returns the amplitude of P_l.
double amplitude(int l, const SurfaceMesh& unit_sphere, const VertexField<double>& values) {
  constexpr int count = 6;
  using Matrix = Eigen::Matrix<double, count, count>;
  using Column = Eigen::Matrix<double, count, 1>;
  Matrix normal = Matrix::Zero();
  Column side = Column::Zero();
  const VertexField<double> weight = vertex_areas(unit_sphere);
  for (const VertexId v : unit_sphere.x.ids()) {
    Column basis;
    for (int k = 0; k < count; ++k) basis[k] = legendre(k, unit_sphere.x[v].normalized().x()).value;
    normal += weight[v] * basis * basis.transpose();
    side += weight[v] * values[v] * basis;
  }
  return normal.ldlt().solve(side)[l];
}

/// d/dt of the P_l part of r = 1 + ε P_l moving with the velocity v:
/// ∂f/∂t = v·r̂ − ε P_l'(c)/r v·(e_x − c r̂), c = cos θ.
double shape_rate(int l, double epsilon, const SurfaceMesh& unit_sphere, const SurfaceMesh& shape,
                  const VertexField<Vec3>& velocity) {
  VertexField<double> rate(unit_sphere.num_vertices(), 0.0);
  for (const VertexId v : rate.ids()) {
    const double r = shape.x[v].norm();
    const Vec3 radial = shape.x[v] / r;
    const double c = radial.x();
    const Vec3 slope = epsilon * legendre(l, c).derivative / r * (Vec3::UnitX() - c * radial);
    rate[v] = velocity[v].dot(radial - slope);
  }
  return amplitude(l, unit_sphere, rate);
}

/// Rate of decay of r = 1 + ε P_l, Ca = 1, the scene being that of the sphere.
double decay(Scene scene, int l, double epsilon, const Method& method) {
  const SurfaceMesh unit_sphere = scene.interfaces[0].mesh;
  SurfaceMesh& shape = scene.interfaces[0].mesh;
  for (Vec3& x : shape.x) x *= 1.0 + epsilon * legendre(l, x.normalized().x()).value;
  if (method.has_analytic_middles) {
    const auto middle = [&](VertexId a, VertexId b) {
      const Vec3 radial = (shape.x[a] + shape.x[b]).normalized();
      return Vec3((1.0 + epsilon * legendre(l, radial.x()).value) * radial);
    };
    return -shape_rate(l, epsilon, unit_sphere, shape,
                       velocity_with_middles(scene, method, middle)) /
           epsilon;
  }
  const FlowSolution flow = solved(scene, method).flow;
  return -shape_rate(l, epsilon, unit_sphere, shape, flow.velocity[0]) / epsilon;
}

/// The rate at ε → 0: odd powers of ε fall out of the mean of ±ε, ε² by extrapolation.
template <class MakeScene>
double extrapolated_decay(MakeScene make_scene, int l, const Method& method) {
  const auto mean = [&](double epsilon) {
    return 0.5 * (decay(make_scene(epsilon), l, epsilon, method) +
                  decay(make_scene(-epsilon), l, -epsilon, method));
  };
  const double epsilon = 0.05;
  return (4.0 * mean(0.5 * epsilon) - mean(epsilon)) / 3.0;
}

}  // namespace

StaticSphere static_sphere(int num_vertices, const Method& method) {
  const Scene scene =
      sphere_in_sphere({.num_vertices = num_vertices, .outer_per_inner = method.outer_per_inner});
  const Solved at_rest = solved(scene, method);
  StaticSphere result;
  for (const Vec3& v : at_rest.flow.bulk->v)
    result.largest_velocity = std::max(result.largest_velocity, v.norm());
  const TetMesh& mesh = at_rest.mesh.tetrahedra();
  const std::vector<double>& pressure = at_rest.flow.bulk->corner_pressure;
  VertexField<std::array<double, 2>> sides(num_vertices, {0.0, 0.0});
  for (const CellId c : mesh.cells.ids())
    for (std::size_t i = 0; i < 4; ++i)
      if (mesh.cells[c][i].value < num_vertices)  // the only interface comes first
        sides[VertexId{mesh.cells[c][i].value}][std::size_t(mesh.region[c].value)] =
            pressure[4 * static_cast<std::size_t>(c.value) + i];
  double sum = 0.0, squares = 0.0;
  for (const auto& [outer, inner] : sides) {
    sum += inner - outer;
    squares += (inner - outer) * (inner - outer);
  }
  const double mean = sum / num_vertices;
  result.jump_error = 0.5 * mean - 1.0;
  result.jump_deviation = std::sqrt(std::max(0.0, squares / num_vertices - mean * mean));
  return result;
}

double measured_relaxation_rate(int num_vertices, const Method& method, int l, double lambda) {
  const LambMode mode(l, lambda);
  const auto make_scene = [&](double epsilon) {
    const double jump = (l - 1) * (l + 2) * epsilon;
    return sphere_in_sphere({.num_vertices = num_vertices,
                             .viscosity_ratio = lambda,
                             .outer_per_inner = method.outer_per_inner,
                             .outer_velocity = [mode, jump](const Vec3& x, double) {
                               return Vec3(jump * mode.velocity(x));
                             }});
  };
  return extrapolated_decay(make_scene, l, method);
}

double measured_stretching(int num_vertices, double lambda, double b, const Method& method) {
  const Mat3 E = Vec3(1.0, -0.5, -0.5).asDiagonal();
  const Scene scene =
      sphere_in_sphere({.num_vertices = num_vertices,
                        .outer_radius = b,
                        .viscosity_ratio = lambda,
                        .Ca = std::numeric_limits<double>::infinity(),
                        .outer_per_inner = wall_vertices,
                        .outer_velocity = [E](const Vec3& x, double) { return Vec3(E * x); },
                        .is_linear_flow = true});
  const FlowSolution flow = solved(scene, method).flow;
  const SurfaceMesh& drop = scene.interfaces[0].mesh;
  return shape_rate(2, 0.0, drop, drop, flow.velocity[0]);
}

double measured_relaxation_in_wall(int num_vertices, double lambda, double b,
                                   const Method& method) {
  const auto make_scene = [&](double) {
    return sphere_in_sphere({.num_vertices = num_vertices,
                             .outer_radius = b,
                             .viscosity_ratio = lambda,
                             .outer_per_inner = wall_vertices});
  };
  return extrapolated_decay(make_scene, 2, method);
}

double exact_stretching(double lambda, double b) {
  const double b2 = b * b, b3 = b2 * b, b5 = b3 * b2, b7 = b5 * b2, b10 = b7 * b3;
  const double L = lambda, L2 = lambda * lambda;
  const double determinant = b10 * (76 * L2 + 178 * L + 96) + b7 * (-475 * L2 + 75 * L + 400) +
                             b5 * (798 * L2 - 126 * L - 672) + b3 * (-475 * L2 + 25 * L + 450) +
                             76 * L2 - 152 * L + 76;
  return 10 * b3 * (b7 * (19 * L + 16) + 21 * b2 * (L - 1) - 40 * L + 40) / determinant;
}

double measured_translation(int num_vertices, double lambda, double b) {
  const double drag = exact_drag(lambda, b);
  Scene scene = sphere_in_sphere({.num_vertices = num_vertices,
                                  .outer_radius = b,
                                  .viscosity_ratio = lambda,
                                  .Ca = std::numeric_limits<double>::infinity(),
                                  .outer_per_inner = wall_vertices});
  const SurfaceMesh& drop = scene.interfaces[0].mesh;
  scene.liquids[RegionId{1}].body_force = Vec3(drag / enclosed_volume(drop), 0.0, 0.0);
  const FlowSolution flow = solved(scene, CapillaryForm::weak).flow;
  return shape_rate(1, 0.0, drop, drop, flow.velocity[0]);
}

double exact_drag(double lambda, double b) {
  const double b2 = b * b, b3 = b2 * b, b5 = b3 * b2, L = lambda;
  return 6.0 * std::numbers::pi * 4.0 * b * ((3 * L + 2) * b5 - 3 * (L - 1)) /
         (3.0 * std::pow(b - 1.0, 3) *
          (4 * (L + 1) * b3 + (3 * L + 6) * b2 + (6 - 3 * L) * b + 4 * (1 - L)));
}

double order_in_h(const std::vector<int>& num_vertices, const std::vector<double>& errors) {
  const auto n = static_cast<double>(errors.size());
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t k = 0; k < errors.size(); ++k) {
    const double log_h = -0.5 * std::log(num_vertices[k]),
                 log_error = std::log(std::abs(errors[k]));
    x += log_h / n;
    y += log_error / n;
    xx += log_h * log_h / n;
    xy += log_h * log_error / n;
  }
  return (xy - x * y) / (xx - x * x);
}

}  // namespace meniscus::fem
