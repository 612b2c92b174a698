#include "meniscus/flow/fem/slow_modes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "meniscus/flow/fem/drop_sections.hpp"
#include "meniscus/flow/fem/partition.hpp"
#include "meniscus/flow/fem/region_pressures.hpp"

namespace meniscus::fem {
namespace {

/// From these ratios of viscosities on iterations saved outweigh the products.
constexpr double kStiff = 20.0, kThin = 50.0;
constexpr int kMostSections = 8;

linear::CsrMatrix no_rows(std::size_t num_columns) {
  return {static_cast<std::int32_t>(num_columns), {0}, {}, {}};
}

void add_entry(linear::CsrMatrix& matrix, std::size_t column, double value) {
  matrix.columns.push_back(static_cast<std::int32_t>(column));
  matrix.values.push_back(value);
}

void end_row(linear::CsrMatrix& matrix) {
  matrix.row_start.push_back(static_cast<std::int32_t>(matrix.columns.size()));
}

/// Weights at the nodes: a mid-edge node has the mean of its ends.
Field<NodeId, double> at_nodes(const VertexWeights& weights, const FlowSpace& space) {
  Field<NodeId, double> result(std::vector<double>(weights.begin(), weights.end()));
  for (const auto& [a, b] : space.edges) result.add(0.5 * (weights[a] + weights[b]));
  return result;
}

/// Adds three translations and three turns about the section's middle.
void add_rigid_motions(const StokesProblem& problem, const VertexWeights& section,
                       linear::CsrMatrix& velocities) {
  const Field<NodeId, Vec3>& x = problem.positions.x;
  Field<NodeId, double> weights = at_nodes(section, problem.space);
  Vec3 middle = Vec3::Zero();
  double sum = 0.0;
  for (const NodeId i : weights.ids()) {
    if (problem.constraints.find(i) != nullptr) weights[i] = 0.0;
    middle += weights[i] * x[i];
    sum += weights[i];
  }
  if (sum == 0.0) return;
  middle /= sum;
  for (int motion = 0; motion < 6; ++motion) {
    const Vec3 axis = Vec3::Unit(motion % 3);
    for (const NodeId i : weights.ids()) {
      if (weights[i] == 0.0) continue;
      const Vec3 v = weights[i] * (motion < 3 ? axis : axis.cross(x[i] - middle));
      for (int k = 0; k < 3; ++k)
        if (v[k] != 0.0)
          add_entry(velocities, 3 * static_cast<std::size_t>(i.value) + std::size_t(k), v[k]);
    }
    end_row(velocities);
  }
}

/// Adds the pressure that is the section's weight.
void add_pressure(const PressureSpace& space, RegionId region, const VertexWeights& section,
                  linear::CsrMatrix& pressures) {
  for (std::size_t i = 0; i < space.vertex.size(); ++i)
    if (space.region[i] == region && section[space.vertex[i]] > 0.0)
      add_entry(pressures, i, section[space.vertex[i]]);
  end_row(pressures);
}

/// Adds the products of the section's weight with the three coordinates about its middle.
void add_pressure_slopes(const StokesProblem& problem, RegionId region,
                         const VertexWeights& section, linear::CsrMatrix& pressures) {
  const PressureSpace& space = problem.space.pressure;
  const Field<NodeId, Vec3>& x = problem.positions.x;
  std::vector<std::size_t> columns;
  Vec3 middle = Vec3::Zero();
  double sum = 0.0;
  for (std::size_t i = 0; i < space.vertex.size(); ++i) {
    const TetVertexId v = space.vertex[i];
    if (space.region[i] != region || section[v] == 0.0) continue;
    columns.push_back(i);
    middle += section[v] * x[node_at(v)];
    sum += section[v];
  }
  middle /= sum;
  for (int k = 0; k < 3; ++k) {
    for (const std::size_t i : columns) {
      const TetVertexId v = space.vertex[i];
      add_entry(pressures, i, section[v] * (x[node_at(v)][k] - middle[k]));
    }
    end_row(pressures);
  }
}

/// Whether the matrix's viscosity holds a region in a long implicit stage: ρR²/τ ≤ 10 μ_out for the
/// region and the matrix. R is the radius of the sphere of the region's volume.
bool is_held_by_matrix(const StokesProblem& problem, const TetMesh& mesh, RegionId region) {
  constexpr double kOutweighs = 10.0;
  if (!problem.inertia) return false;
  double volume = 0.0, density = 0.0;
  for (const CellId c : mesh.cells.ids()) {
    if (mesh.region[c] == region) volume += signed_volume(mesh, c);
    if (mesh.region[c] == region || mesh.region[c] == RegionId{0})
      density = std::max(density, problem.inertia->density[c]);
  }
  const double radius = std::cbrt(3.0 / (4.0 * std::numbers::pi) * volume);
  return density * radius * radius <= kOutweighs * problem.inertia->duration;
}

/// The mesh with its vertices where the problem has its nodes: where the preconditioner is made,
/// which may be kept longer than the mesh stays there.
TetMesh mesh_of(const StokesProblem& problem) {
  TetMesh mesh = problem.mesh;
  for (const TetVertexId v : mesh.x.ids()) mesh.x[v] = problem.positions.x[node_at(v)];
  return mesh;
}

/// The entries in owned columns. `item_of` gives the owned items in their order, each of so many
/// columns.
template <class Items>
linear::CsrMatrix owned_columns(const linear::CsrMatrix& global, const Items& item_of,
                                std::int32_t num_owned, std::int32_t columns_each) {
  std::vector<std::int32_t> local(static_cast<std::size_t>(global.num_columns), -1);
  for (std::int32_t i = 0; i < num_owned * columns_each; ++i)
    local[static_cast<std::size_t>(columns_each * item_of(i / columns_each) + i % columns_each)] =
        i;
  linear::CsrMatrix result = no_rows(static_cast<std::size_t>(num_owned * columns_each));
  for (std::size_t row = 0; row + 1 < global.row_start.size(); ++row) {
    for (auto n = static_cast<std::size_t>(global.row_start[row]);
         n < static_cast<std::size_t>(global.row_start[row + 1]); ++n) {
      const std::int32_t column = local[static_cast<std::size_t>(global.columns[n])];
      if (column >= 0) add_entry(result, static_cast<std::size_t>(column), global.values[n]);
    }
    end_row(result);
  }
  return result;
}

}  // namespace

SlowModes slow_modes(const StokesProblem& problem) {
  const FlowSpace& space = problem.space;
  SlowModes modes{no_rows(3 * static_cast<std::size_t>(space.velocity.num_nodes)),
                  no_rows(space.pressure.vertex.size())};
  const Field<RegionId, double> around = viscosities_around(problem);
  const auto is_stiff = [&](RegionId r) { return around[r] * kStiff <= 1.0; };
  const auto is_thin = [&](RegionId r) { return around[r] >= kThin; };
  const auto count = static_cast<int>(
      std::ranges::count_if(around.ids(), [&](RegionId r) { return is_stiff(r) || is_thin(r); }));
  if (count == 0 || count > kMostSections) return modes;
  const TetMesh mesh = mesh_of(problem);
  for (const RegionId region : around.ids()) {
    if (!is_stiff(region) && !is_thin(region)) continue;
    const std::vector<VertexWeights> all = sections(mesh, region, kMostSections / count);
    const bool has_slopes = is_thin(region) && is_held_by_matrix(problem, mesh, region);
    for (const VertexWeights& section : all) {
      if (is_stiff(region)) {
        add_rigid_motions(problem, section, modes.velocities);
      } else if (all.size() > 1) {
        add_pressure(space.pressure, region, section, modes.pressures);
        if (has_slopes) add_pressure_slopes(problem, region, section, modes.pressures);
      }
    }
  }
  return modes;
}

SlowModes local_part(const SlowModes& global, const Partition& partition) {
  return {
      owned_columns(
          global.velocities,
          [&](std::int32_t i) { return partition.global_node[static_cast<std::size_t>(i)].value; },
          partition.owned.num_nodes, 3),
      owned_columns(
          global.pressures,
          [&](std::int32_t i) { return partition.global_pressure[static_cast<std::size_t>(i)]; },
          partition.owned.num_pressures, 1)};
}

}  // namespace meniscus::fem
