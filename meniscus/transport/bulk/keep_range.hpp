#pragma once

#include <limits>
#include <span>
#include <vector>

#include "meniscus/transport/bulk/scalar_space.hpp"

namespace meniscus::bulk {

/// The values that a field may take at its nodes.
struct ValueBounds {
  double least = -std::numeric_limits<double>::infinity();
  double largest = std::numeric_limits<double>::infinity();
};

/// Bounds a hundredth of a range beyond it: what finite elements need to follow a smooth field, and
/// no more.
[[nodiscard]] ValueBounds around(double least, double largest);

/// Cuts values off at bounds and keeps the amount Σ rows·values. What is missing goes to nodes with
/// room, in proportion to their room and to how much the field varies around them. Where bounds and
/// amount exclude each other the amount wins, by one shift. `is_given` nodes keep their values.
void keep_range(const ValueBounds& bounds, double amount, std::span<const double> rows,
                const ScalarSpace& space, std::span<const char> is_given,
                std::vector<double>& values);

}  // namespace meniscus::bulk
