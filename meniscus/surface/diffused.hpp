#pragma once

#include <optional>
#include <vector>

#include "meniscus/mesh/contour.hpp"

namespace meniscus {

/// Surfaces of the same volume that are smoother and smoother. The distance from a surface,
/// negative inside, is smoothed over a length s (by a Gaussian of that deviation). Each is the
/// level of it that keeps the volume. As the Laplacian of the distance is 2H, that moves a place by
/// s²(⟨H⟩ − H) along the normal to first order. But never does the result meet itself. Threads that
/// are thinner than about s, and crevices that narrow, vanish, and films as thin are holed.
class DiffusedSurface {
 public:
  /// Lattice points are half an `edge` apart, or farther where there would be too many.
  DiffusedSurface(const SurfaceMesh& mesh, double edge);

  /// Smoothed over `length`, not less than the last: its largest piece, of any number of holes, in
  /// even triangles. There is none where more than `most_lost` of the volume is lost with others.
  [[nodiscard]] std::optional<SurfaceMesh> smoother_surface(double length, double most_lost);

 private:
  void smooth_by(double variance);
  [[nodiscard]] SurfaceMesh contour_of_volume() const;

  double volume_, edge_;
  double variance_ = 0.0;
  Lattice distance_;
};

}  // namespace meniscus
