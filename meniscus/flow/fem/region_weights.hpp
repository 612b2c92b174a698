#pragma once

#include <span>
#include <vector>

#include "meniscus/flow/fem/partition.hpp"
#include "meniscus/linear/saddle_system.hpp"

namespace meniscus::fem {

/// The weights that preconditioners give to pressures constant in a region (region_pressures.hpp).
/// χ w/(∫χ/μ) χᵀ, w being the region's fraction, is w μM⁻¹ for such a pressure.
class RegionWeights {
 public:
  RegionWeights(const PressureSpace& pressure, const Partition* partition);

  /// Sets the fractions by region, for all later updates.
  void set_shares(const Field<RegionId, double>& shares);
  /// Computes the weights from the lumped mass ∫ψ/μ of this rank's pressures. Collective.
  void update(std::span<const double> pressure_mass);
  void put_into(linear::SaddleSystem& system) const;

 private:
  const Partition* partition_;
  std::vector<std::int32_t> region_of_pressure_;
  std::vector<double> shares_, weights_;
};

}  // namespace meniscus::fem
