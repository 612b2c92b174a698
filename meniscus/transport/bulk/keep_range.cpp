#include "meniscus/transport/bulk/keep_range.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meniscus::bulk {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// The difference of the largest and the least value in the cells around each node.
std::vector<double> variation(const ScalarSpace& space, std::span<const double> values) {
  std::vector<double> least(values.size(), HUGE_VAL), largest(values.size(), -HUGE_VAL);
  for (const CellId c : ids<CellId>(space.elements.velocity.num_cells())) {
    const auto nodes = space.elements.velocity.of(c);
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const std::int32_t node : nodes) {
      low = std::min(low, values[at(node)]);
      high = std::max(high, values[at(node)]);
    }
    for (const std::int32_t node : nodes) {
      least[at(node)] = std::min(least[at(node)], low);
      largest[at(node)] = std::max(largest[at(node)], high);
    }
  }
  for (std::size_t i = 0; i < values.size(); ++i) largest[i] -= least[i];
  return largest;
}

/// How far each node may go towards the bound, times the variation there. Vertices of quadratic
/// elements, whose functions have negative integrals, stay.
std::vector<double> rooms(const ValueBounds& bounds, bool upwards, std::span<const double> rows,
                          const ScalarSpace& space, std::span<const char> is_given,
                          std::span<const double> values) {
  std::vector<double> room = variation(space, values);
  const double bound = upwards ? bounds.largest : bounds.least;
  for (std::size_t i = 0; i < room.size(); ++i) {
    if (!(rows[i] > 0.0) || (!is_given.empty() && is_given[i] != 0)) room[i] = 0.0;
    if (std::isfinite(bound)) room[i] *= bound - values[i];
  }
  if (!std::isfinite(bound) && !upwards)
    for (double& each : room) each = -each;
  return room;
}

}  // namespace

ValueBounds around(double least, double largest) {
  const double margin = 0.01 * (largest - least);
  return {least - margin, largest + margin};
}

void keep_range(const ValueBounds& bounds, double amount, std::span<const double> rows,
                const ScalarSpace& space, std::span<const char> is_given,
                std::vector<double>& values) {
  const auto held = [&](std::span<const double> of) {
    return std::inner_product(rows.begin(), rows.end(), of.begin(), 0.0);
  };
  const auto is_free = [&](std::size_t i) { return is_given.empty() || is_given[i] == 0; };
  for (std::size_t i = 0; i < values.size(); ++i)
    if (is_free(i)) values[i] = std::clamp(values[i], bounds.least, bounds.largest);
  double missing = amount - held(values);
  const std::vector<double> room = rooms(bounds, missing > 0.0, rows, space, is_given, values);
  const double total = held(room);
  if (std::abs(total) > 1e-14 * std::abs(amount)) {
    // Rooms are products of a distance to the bound and of a variation: as a share of the largest
    // variation no node passes its bound.
    double share = missing / total;
    double largest = 0.0;
    const double bound = missing > 0.0 ? bounds.largest : bounds.least;
    if (std::isfinite(bound))
      for (std::size_t i = 0; i < room.size(); ++i)
        if (const double way = bound - values[i]; way != 0.0)
          largest = std::max(largest, share * room[i] / way);
    if (largest > 1.0) share /= largest;
    for (std::size_t i = 0; i < values.size(); ++i) values[i] += share * room[i];
    missing -= share * total;
  }
  double whole = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (is_free(i)) whole += rows[i];
  if (whole != 0.0 && missing != 0.0)
    for (std::size_t i = 0; i < values.size(); ++i)
      if (is_free(i)) values[i] += missing / whole;
}

}  // namespace meniscus::bulk
