#include "meniscus/flow/fem/region_motions.hpp"

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/curved_maps.hpp"
#include "meniscus/flow/fem/elements.hpp"

namespace meniscus::fem {
namespace {

/// ∫v dV, ½∫v² dV and ∫|v| dV of one cell.
struct CellMotion {
  Vec3 flux = Vec3::Zero();
  double energy = 0.0, gross = 0.0, volume = 0.0;
};

CellMotion straight_motion(double volume, const std::array<Vec3, 10>& v) {
  CellMotion motion{.volume = volume};
  for (std::size_t i = 0; i < v.size(); ++i) {
    const double share = i < 4 ? -0.05 : 0.2;  // ∫φ_i/V
    motion.flux += share * volume * v[i];
    motion.gross += share * volume * v[i].norm();
    Vec3 row = Vec3::Zero();
    for (std::size_t j = 0; j < v.size(); ++j) row += kQuadraticMass[i][j] * v[j];
    motion.energy += 0.5 * volume * row.dot(v[i]);
  }
  return motion;
}

CellMotion curved_motion(const CurvedMaps& maps, const std::array<Vec3, 10>& v) {
  CellMotion motion;
  for (std::size_t q = 0; q < maps.size(); ++q) {
    const auto phi = quadratic_tetrahedron_values(kTetrahedronRule5[q].barycentric);
    Vec3 here = Vec3::Zero();
    for (std::size_t i = 0; i < v.size(); ++i) here += phi[i] * v[i];
    motion.flux += maps[q].weight * here;
    motion.energy += 0.5 * maps[q].weight * here.squaredNorm();
    motion.gross += maps[q].weight * here.norm();
    motion.volume += maps[q].weight;
  }
  return motion;
}

CellMotion linear_motion(double volume, const std::array<Vec3, 4>& v) {
  CellMotion motion{.volume = volume};
  Vec3 sum = Vec3::Zero();
  double squared = 0.0;
  for (const Vec3& each : v) {
    sum += each;
    squared += each.squaredNorm();
    motion.gross += 0.25 * volume * each.norm();
  }
  motion.flux = 0.25 * volume * sum;
  motion.energy = volume / 40.0 * (sum.squaredNorm() + squared);  // ∫φ_iφ_j = V(1 + δ_ij)/20
  return motion;
}

CellMotion cell_motion(const TetMesh& mesh, const FlowSpace& space, const NodePositions& positions,
                       const MapsOfCurvedCells& maps, std::span<const Vec3> v, CellId c) {
  const auto nodes = space.velocity.of(c);
  const auto at_nodes = [&]<std::size_t count>(std::array<Vec3, count> values) {
    for (std::size_t i = 0; i < count; ++i) values[i] = v[static_cast<std::size_t>(nodes[i])];
    return values;
  };
  if (space.elements == Elements::p1_p1)
    return linear_motion(signed_volume(mesh, c), at_nodes(std::array<Vec3, 4>()));
  const auto quadratic = at_nodes(std::array<Vec3, 10>());
  return positions.is_curved[c] != 0 ? curved_motion(maps.of(c), quadratic)
                                     : straight_motion(signed_volume(mesh, c), quadratic);
}

}  // namespace

std::vector<RegionMotion> region_motions(const Scene& scene, const TetMesh& mesh,
                                         const FlowSpace& space, const NodePositions& positions,
                                         std::span<const Vec3> v, double* gross) {
  std::vector<RegionMotion> motions(static_cast<std::size_t>(scene.liquids.size()));
  std::vector<double> volume(motions.size(), 0.0);
  if (gross != nullptr) *gross = 0.0;
  const MapsOfCurvedCells maps(space, positions);
  for (const CellId c : mesh.cells.ids()) {
    const CellMotion cell = cell_motion(mesh, space, positions, maps, v, c);
    const double density = scene.liquids[mesh.region[c]].density;
    const auto region = static_cast<std::size_t>(mesh.region[c].value);
    RegionMotion& motion = motions[region];
    motion.mean_velocity += cell.flux;
    volume[region] += cell.volume;
    motion.momentum += density * cell.flux;
    motion.kinetic_energy += density * cell.energy;
    if (gross != nullptr) *gross += density * cell.gross;
  }
  for (std::size_t region = 0; region < motions.size(); ++region)
    if (volume[region] > 0.0) motions[region].mean_velocity /= volume[region];
  return motions;
}

}  // namespace meniscus::fem
