#include "meniscus/flow/fem/region_weights.hpp"

#include "meniscus/core/error.hpp"
#include "meniscus/linear/collective.hpp"

namespace meniscus::fem {

RegionWeights::RegionWeights(const PressureSpace& pressure, const Partition* partition)
    : partition_(partition) {
  region_of_pressure_.reserve(pressure.region.size());
  for (const RegionId region : pressure.region) region_of_pressure_.push_back(region.value);
}

void RegionWeights::set_shares(const Field<RegionId, double>& shares) {
  shares_.assign(shares.begin(), shares.end());
}

void RegionWeights::update(std::span<const double> pressure_mass) {
  std::vector<double> mass(shares_.size(), 0.0);
  for (std::size_t i = 0; i < pressure_mass.size() && !mass.empty(); ++i) {
    const auto region = static_cast<std::size_t>(region_of_pressure_[i]);
    MENISCUS_ASSERT(region < mass.size(), "region {} of {}", region, mass.size());
    mass[region] += pressure_mass[i];
  }
  if (partition_ != nullptr && !mass.empty()) linear::sum(partition_->communicator, mass);
  weights_.clear();
  for (std::size_t r = 0; r < mass.size(); ++r) {
    MENISCUS_ASSERT(shares_[r] == 0.0 || mass[r] > 0.0, "region {}", r);
    weights_.push_back(shares_[r] / mass[r]);
  }
}

void RegionWeights::put_into(linear::SaddleSystem& system) const {
  const auto count = static_cast<std::size_t>(system.num_pressures());
  system.group_of_pressure = std::span(region_of_pressure_).first(count);
  system.group_weights = weights_;
}

}  // namespace meniscus::fem
