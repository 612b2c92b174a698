#include "meniscus/transport/bulk/scalar_measures.hpp"

#include <algorithm>
#include <cmath>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/face_elements.hpp"
#include "meniscus/transport/bulk/cell_kernel.hpp"

namespace meniscus::bulk {
namespace {

std::vector<ScalarContent> contents(const MassMatrix& mass, std::span<const double> values) {
  const std::vector<double> amounts = region_amounts(mass, values);
  std::vector<ScalarContent> result(amounts.size());
  for (std::size_t r = 0; r < result.size(); ++r) {
    result[r].volume = mass.volumes[r];
    result[r].amount = amounts[r];
  }
  return result;
}

/// The barycentric coordinates in a cell of a point of one of its faces.
std::array<double, 4> in_cell(const ScalarSpace& space, CellId c, std::span<const NodeId> face,
                              const std::array<double, 3>& b) {
  const auto nodes = space.elements.velocity.of(c);
  std::array<double, 4> result{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto found = std::ranges::find(nodes.first(4), face[i].value);
    MENISCUS_ASSERT(found != nodes.begin() + 4, "a face is not of cell {}", c.value);
    result[static_cast<std::size_t>(found - nodes.begin())] = b[i];
  }
  return result;
}

/// −∮k∇T·n dS of an interface, k∇T being the mean of both sides.
double outflow(const Scene& scene, const TetMesh& mesh, const ScalarSpace& space,
               const NodePositions& positions, std::size_t k, std::span<const double> values,
               std::size_t i) {
  const fem::FaceNodeTable& faces = space.interfaces[i];
  double result = 0.0;
  for (const FaceId f : faces.faces()) {
    const auto nodes = faces.of(f);
    const fem::FacePoints points = fem::face_points(positions.x, nodes);
    for (std::size_t q = 0; q < points.size(); ++q) {
      const auto flux = [&](CellId c) -> Vec3 {
        const auto b = in_cell(space, c, nodes, kTriangleRule6[q].barycentric);
        return scene.liquids[mesh.region[c]].scalars[k].conductivity *
               value_at(space, positions, c, b, values).gradient;
      };
      const auto [inside, outside] = mesh.interfaces[i].sides[f];
      result -= 0.5 * (flux(inside) + flux(outside)).dot(points[q].area);
    }
  }
  return result;
}

/// The area of an interface, and the mean on its outer side.
ScalarExchange outer_side(const Scene& scene, const ScalarSpace& space,
                          const NodePositions& positions, std::size_t k,
                          std::span<const double> values, std::size_t i) {
  const ScalarLiquid& outside = scene.liquids[scene.interfaces[i].outside].scalars[k];
  const double unit = scene.scalars[k].is_species ? outside.capacity : 1.0;
  const fem::FaceNodeTable& faces = space.interfaces[i];
  ScalarExchange result;
  for (const FaceId f : faces.faces()) {
    const auto nodes = faces.of(f);
    for (const fem::FacePoint& point : fem::face_points(positions.x, nodes)) {
      const double area = point.area.norm();
      double value = 0.0;
      for (std::size_t j = 0; j < nodes.size(); ++j)
        value += point.value[j] * values[static_cast<std::size_t>(nodes[j].value)];
      result.area += area;
      result.mean_outside += area * unit * value;
    }
  }
  result.mean_outside /= result.area;
  return result;
}

/// What leaves an interface per time: the loss of the regions within it, and their sources.
double loss_within(const Scene& scene, std::size_t interface, std::size_t k,
                   std::span<const double> region_loss, std::span<const ScalarContent> regions) {
  const auto add = [&](auto&& self, RegionId region) -> double {
    const auto r = static_cast<std::size_t>(region.value);
    double loss = region_loss[r] + scene.liquids[region].scalars[k].source * regions[r].volume;
    for (const Interface& inner : scene.interfaces)
      if (inner.outside == region) loss += self(self, inner.inside);
    return loss;
  };
  return add(add, scene.interfaces[interface].inside);
}

/// The mean over the patches with a given value; none where there are none.
std::optional<double> given_mean(const Scene& scene, const ScalarSpace& space,
                                 const NodePositions& positions, std::size_t k,
                                 std::span<const double> values) {
  double total = 0.0, area = 0.0;
  for (const FaceId f : space.boundary.faces()) {
    if (scene.boundary.patches[scene.boundary.patch[f]].scalars[k].kind !=
        ScalarCondition::Kind::value)
      continue;
    const auto nodes = space.boundary.of(f);
    for (const fem::FacePoint& point : fem::face_points(positions.x, nodes))
      for (std::size_t j = 0; j < nodes.size(); ++j) {
        const double share = point.value[j] * point.area.norm();
        total += share * values[static_cast<std::size_t>(nodes[j].value)];
        area += share;
      }
  }
  if (area == 0.0) return {};
  return total / area;
}

}  // namespace

ScalarMeasures scalar_measures(const Scene& scene, const TetMesh& mesh, const ScalarSpace& space,
                               const NodePositions& positions, const MassMatrix& mass,
                               std::size_t k, const BulkScalar& scalar) {
  const std::span<const double> values = scalar.values;
  ScalarMeasures result;
  result.regions = contents(mass, values);
  for (std::size_t i = 0; i < space.interfaces.size(); ++i) {
    ScalarExchange& here =
        result.interfaces.emplace_back(outer_side(scene, space, positions, k, values, i));
    if (scalar.region_loss.empty())
      here.outflow = outflow(scene, mesh, space, positions, k, values, i);
    else
      here.outflow = loss_within(scene, i, k, scalar.region_loss, result.regions) *
                     (std::isinf(scene.scalars[k].peclet) ? 0.0 : scene.scalars[k].peclet);
  }
  const auto [least, largest] = std::ranges::minmax(values);
  result.least = least;
  result.largest = largest;
  result.reference = given_mean(scene, space, positions, k, values)
                         .value_or(result.regions[0].amount / result.regions[0].volume);
  return result;
}

}  // namespace meniscus::bulk
