#pragma once

#include <span>
#include <vector>

#include "meniscus/flow/fem/share.hpp"
#include "meniscus/linear/saddle_system.hpp"

namespace meniscus::fem {

/// The weights that preconditioners give to pressures constant in a region (region_pressures.hpp):
/// χ share/(∫χ/μ) χᵀ is the share of μM⁻¹ between them.
class RegionWeights {
 public:
  RegionWeights(const PressureSpace& pressure, const Share* share);

  /// By region; they hold for the assemblies to come.
  void set_shares(const Field<RegionId, double>& shares);
  /// Computes the weights from the lumped mass ∫ψ/μ of this rank's pressures. Collective.
  void update(std::span<const double> pressure_mass);
  void put_into(linear::SaddleSystem& system) const;

 private:
  const Share* share_;
  std::vector<std::int32_t> region_of_pressure_;
  std::vector<double> shares_, weights_;
};

}  // namespace meniscus::fem
