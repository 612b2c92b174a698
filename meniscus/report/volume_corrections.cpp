#include "meniscus/report/volume_corrections.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace meniscus::report {

std::optional<double> volume_correction_sum(const io::Table& drops) {
  for (const char* needed : {"step", "drop", "volume_correction"})
    if (!drops.find(needed)) return std::nullopt;
  const std::vector<double> steps = drops.column("step"), ids = drops.column("drop"),
                            shifts = drops.column("volume_correction");
  std::map<double, double> drop_to_sum;
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (steps[i] > 0.0 && std::isfinite(shifts[i])) drop_to_sum[ids[i]] += std::abs(shifts[i]);
  double largest = 0.0;
  for (const auto& [drop, sum] : drop_to_sum) largest = std::max(largest, sum);
  return largest;
}

}  // namespace meniscus::report
