#include "meniscus/flow/bem/integral_equation.hpp"

#include <algorithm>
#include <numbers>
#include <numeric>
#include <optional>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/bem/marangoni_layer.hpp"
#include "meniscus/flow/bem/tension_balance.hpp"
#include "meniscus/linear/collective.hpp"
#include "meniscus/scene/interface_tension.hpp"

namespace meniscus::bem {
namespace {

constexpr double kPi = std::numbers::pi;
/// 1/4π ∮ u·T·n dS over ∮ r (r·u)(r·n)/r⁵ dS.
constexpr double kDoubleFactor = -6.0 / (4.0 * kPi);

/// The jump of traction along n, less its mean over each interface, which drives no flow.
std::vector<double> traction_jump(const Scene& scene, const BoundaryGeometry& geometry) {
  const std::vector<double> tension = tension_at_points(scene);
  std::vector<double> q;
  for (std::size_t m = 0; m < scene.interfaces.size(); ++m) {
    const Interface& interface = scene.interfaces[m];
    const InterfaceElements& elements = geometry.surfaces[m].elements;
    const Vec3 buoyancy =
        scene.liquids[interface.inside].body_force - scene.liquids[interface.outside].body_force;
    double total = 0.0, area = 0.0;
    for (const VertexId v : elements.x.ids()) {
      q.push_back(tension[q.size()] * elements.kappa[v] - buoyancy.dot(elements.x[v]));
      total += elements.weight[v] * q.back();
      area += elements.weight[v];
    }
    const std::size_t first = q.size() - static_cast<std::size_t>(elements.x.size());
    for (std::size_t i = first; i < q.size(); ++i) q[i] -= total / area;
  }
  return q;
}

std::vector<bool> nonzero(const std::vector<double>& values) {
  std::vector<bool> result;
  result.reserve(values.size());
  for (const double value : values) result.push_back(value != 0.0);
  return result;
}

}  // namespace

IntegralEquation::IntegralEquation(const Scene& scene, double t, const Options& options)
    : geometry_(make_geometry(scene)),
      shared_(geometry_.size(), linear::Communicator::of(options.processes), options.threads) {
  for (const std::vector<double>* x : {&geometry_.nodes.x, &geometry_.nodes.y, &geometry_.nodes.z})
    if (!linear::agree(shared_.communicator(), std::span<const double>(*x)))
      throw RunFailure("the ranks have made different interfaces: do their machines differ?");
  std::vector<double> differences;
  for (const Interface& interface : scene.interfaces) {
    const double inner = scene.liquids[interface.inside].viscosity,
                 outer = scene.liquids[interface.outside].viscosity;
    contrast_.push_back({0.5 * (inner + outer), 0.5 * (outer - inner), outer});
    differences.push_back(contrast_.back().difference);
    rigid_.emplace_back(interface.mesh);
  }
  const std::vector<double> q = geometry_.at_nodes(traction_jump(scene, geometry_));
  rows_ = near_rows(geometry_, q, nonzero(differences), shared_);
  set_right_hand_side(scene, t, q);
}

bool IntegralEquation::has_double_layer() const {
  return std::ranges::any_of(contrast_, [](const Contrast& c) { return c.difference != 0.0; });
}

void IntegralEquation::set_right_hand_side(const Scene& scene, double t,
                                           const std::vector<double>& q) {
  const double matrix_viscosity = scene.liquids[RegionId{0}].viscosity;
  const Mat3 gradient = scene.flow.gradient(t);
  const TensionBalance balance(scene, geometry_);
  std::optional<MarangoniLayer> marangoni;
  if (has_surfactant(scene)) marangoni.emplace(scene, geometry_);
  right_hand_side_.resize(num_unknowns());
  shared_.for_own([&](std::int32_t begin, std::int32_t end) {
    for (std::int32_t i = begin; i < end; ++i) {
      const Vec3 x = geometry_.nodes.point(i);
      Vec3 layer = single_layer_sum(geometry_.nodes, q, x) +
                   rows_[static_cast<std::size_t>(i)].single + balance(x);
      if (marangoni) layer -= (*marangoni)(i);
      set(right_hand_side_, i,
          (matrix_viscosity * (gradient * x) - layer / (8.0 * kPi)) /
              contrast_[surface_of(i)].mean);
    }
  });
  shared_.gather(right_hand_side_);
}

std::size_t IntegralEquation::surface_of(std::int32_t i) const {
  return static_cast<std::size_t>(geometry_.surface_of[static_cast<std::size_t>(i)]);
}

void IntegralEquation::set(std::span<double> w, std::int32_t i, const Vec3& value) const {
  for (std::size_t k = 0; k < 3; ++k)
    w[k * rows_.size() + static_cast<std::size_t>(i)] = value[static_cast<Eigen::Index>(k)];
}

Vec3 IntegralEquation::at(std::span<const double> w, std::int32_t i) const {
  const auto row = static_cast<std::size_t>(i);
  return {w[row], w[rows_.size() + row], w[2 * rows_.size() + row]};
}

std::vector<RigidMotion> IntegralEquation::rigid_parts(std::span<const double> w) const {
  std::vector<RigidMotion> parts;
  for (std::size_t m = 0; m < rigid_.size(); ++m)
    parts.push_back(rigid_[m]([&](VertexId v) { return at(w, geometry_.index(m, v)); }));
  return parts;
}

SourceVectors IntegralEquation::deformation(std::span<const double> w) const {
  const std::vector<RigidMotion> rigid = rigid_parts(w);
  SourceVectors rest(geometry_.size());
  for (std::int32_t j = 0; j < geometry_.size(); ++j)
    rest.set(j, at(w, j) - rigid[surface_of(j)].at(geometry_.nodes.point(j)));
  return rest;
}

double IntegralEquation::mean_normal_component(std::size_t m, const SourceVectors& v) const {
  const InterfaceElements& elements = geometry_.surfaces[m].elements;
  double flux = 0.0, area = 0.0;
  for (const VertexId i : elements.x.ids()) {
    flux += elements.weight[i] * elements.n[i].dot(v.at(geometry_.index(m, i)));
    area += elements.weight[i];
  }
  MENISCUS_ASSERT(area > 0.0, "surface {}", m);
  return flux / area;
}

/// Σ_m d_m K_m of a velocity without rigid parts, `density` being d times it at all nodes, at point
/// i.
Vec3 IntegralEquation::double_layer(const SourceVectors& density, std::int32_t i) const {
  Vec3 sum = double_layer_sum(geometry_.nodes, density, geometry_.nodes.point(i));
  const NearRow& near = rows_[static_cast<std::size_t>(i)];
  for (std::size_t c = 0; c < near.columns.size(); ++c)
    sum += near.double_layer[c] * density.at(near.columns[c]);
  return kDoubleFactor * sum;
}

void IntegralEquation::apply(std::span<const double> w, std::span<double> result) const {
  SourceVectors density = deformation(w);
  // Rigid motions carry no flux, but the quadrature would see some.
  std::vector<double> mean_normal;
  for (std::size_t m = 0; m < contrast_.size(); ++m)
    mean_normal.push_back(mean_normal_component(m, density));
  for (std::int32_t j = 0; j < geometry_.size(); ++j)
    density.set(j, contrast_[surface_of(j)].difference * density.at(j));
  density = geometry_.at_nodes(density);
  shared_.for_own([&](std::int32_t begin, std::int32_t end) {
    for (std::int32_t i = begin; i < end; ++i) {
      const std::size_t m = surface_of(i);
      const Contrast& contrast = contrast_[m];
      const BoundaryGeometry::Surface& surface = geometry_.surfaces[m];
      const Vec3& n = surface.elements.n[VertexId{i - surface.range.begin}];
      set(result, i,
          at(w, i) + (contrast.difference * mean_normal[m] * n - double_layer(density, i)) /
                         contrast.mean);
    }
  });
  shared_.gather(result);
}

std::vector<std::size_t> IntegralEquation::outermost_first() const {
  std::vector<std::size_t> order(rigid_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t k) {
    return std::ranges::count(geometry_.surfaces[k].is_inside_of, true);
  });
  return order;
}

std::vector<VertexField<Vec3>> IntegralEquation::velocity(std::span<const double> w) const {
  const std::vector<RigidMotion> rigid = rigid_parts(w);
  std::vector<VertexField<Vec3>> u(rigid.size());
  std::vector<RigidMotion> around(rigid.begin(), rigid.end());  // P_m w + R_m is P_m u
  for (const std::size_t k : outermost_first()) {
    const InterfaceElements& elements = geometry_.surfaces[k].elements;
    const Contrast& contrast = contrast_[k];
    MENISCUS_ASSERT(contrast.outer > 0.0, "surface {}", k);
    u[k].resize(elements.x.size());
    for (const VertexId v : u[k].ids()) {
      const Vec3& x = elements.x[v];
      Vec3 sum = contrast.difference * rigid[k].at(x);
      for (std::size_t m = 0; m < rigid.size(); ++m)
        if (geometry_.surfaces[k].is_inside_of[m])
          sum += 2.0 * contrast_[m].difference * around[m].at(x);
      u[k][v] = at(w, geometry_.index(k, v)) - sum / contrast.outer;
    }
    around[k] = rigid_[k]([&](VertexId v) { return u[k][v]; });
  }
  return u;
}

std::vector<double> IntegralEquation::unknowns(std::span<const VertexField<Vec3>> u) const {
  // The recovery with P w = P u − R: s R = −d P u − 2 Σ d_m P u_m, as μ_out − d = s.
  std::vector<RigidMotion> rigid;
  for (std::size_t m = 0; m < rigid_.size(); ++m)
    rigid.push_back(rigid_[m]([&](VertexId v) { return u[m][v]; }));
  std::vector<double> w(num_unknowns());
  for (std::size_t k = 0; k < rigid.size(); ++k)
    for (const VertexId v : u[k].ids()) {
      const std::int32_t i = geometry_.index(k, v);
      const Vec3 x = geometry_.nodes.point(i);
      Vec3 sum = contrast_[k].difference * rigid[k].at(x);
      for (std::size_t m = 0; m < rigid.size(); ++m)
        if (geometry_.surfaces[k].is_inside_of[m])
          sum += 2.0 * contrast_[m].difference * rigid[m].at(x);
      set(w, i, u[k][v] + sum / contrast_[k].mean);
    }
  return w;
}

}  // namespace meniscus::bem
