#pragma once

#include <optional>

#include "meniscus/scene/scene.hpp"

namespace meniscus {

/// The least of `smallest_gap(a, b)` over all pairs of surfaces of a scene, interfaces and (of a
/// bounded scene) the outer boundary [R0]. There is none of only one. O(n log n) in the number of
/// vertices as long as no more than a few surfaces' boxes overlap at a point.
[[nodiscard]] std::optional<double> smallest_gap(const Scene& scene);

}  // namespace meniscus
