#pragma once

#include <array>
#include <optional>

#include "meniscus/surface/diffused.hpp"

namespace meniscus {

/// Lengths that a crumpled surface is smoothed over, in mean edges, the least first. They go from
/// what the lattice of `DiffusedSurface` resolves to where a fold two edges wide is gone.
inline constexpr std::array<double, 5> kSmoothingLengths{0.5, 0.71, 1.0, 1.41, 2.0};

/// The shapes of `DiffusedSurface` that lose little volume, made when they are asked for.
class SmoothedShapes {
 public:
  SmoothedShapes(SurfaceMesh mesh, double edge);
  /// The surface smoothed over `length` [R0], not less than the last. None where more than
  /// `kMostMendedVolume` is lost.
  [[nodiscard]] std::optional<SurfaceMesh> at(double length);

 private:
  SurfaceMesh mesh_;
  double edge_;
  std::optional<DiffusedSurface> diffused_;
};

}  // namespace meniscus
