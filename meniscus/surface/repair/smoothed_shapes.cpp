#include "meniscus/surface/repair/smoothed_shapes.hpp"

#include <utility>

#include "meniscus/core/error.hpp"
#include "meniscus/surface/constants.hpp"

namespace meniscus {

SmoothedShapes::SmoothedShapes(SurfaceMesh mesh, double edge)
    : mesh_(std::move(mesh)), edge_(edge) {
  MENISCUS_ASSERT(edge_ > 0.0, "edge = {}", edge_);
}

std::optional<SurfaceMesh> SmoothedShapes::at(double length) {
  if (!diffused_) diffused_.emplace(mesh_, edge_);
  return diffused_->smoother_surface(length, kMostMendedVolume);
}

}  // namespace meniscus
