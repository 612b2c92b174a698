#pragma once

#include <functional>

#include "tests/flow/fem/sphere_experiments.hpp"

namespace meniscus::fem {

/// Velocity of the vertices of a scene's only interface, the middles of whose edges are put where
/// the caller knows them to be, instead of on a fitted surface.
[[nodiscard]] VertexField<Vec3> velocity_with_middles(
    const Scene& scene, const Method& method,
    const std::function<Vec3(VertexId, VertexId)>& middle);

}  // namespace meniscus::fem
