#pragma once

#include <optional>

#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus {

/// How creases are rounded: edges where normals turn by more than `crease_deg` are smoothed with
/// `rings` rings of faces around them.
struct Rounding {
  double crease_deg;
  int rings;
};

/// The surface with the bi-Laplace surface that joins the rest smoothly in the place of its
/// creases. None where it has no creases, or the volume changes by more than `kMostMendedVolume`.
[[nodiscard]] std::optional<SurfaceMesh> rounded_shape(SurfaceMesh mesh, const Rounding& rounding);

/// The largest piece of the surface without the faces within `margin` mean edges of its creases of
/// `crease_deg`, its holes closed smoothly. A crevice or a thorn goes as a whole. None where it has
/// no creases, an end cannot be closed, or the volume changes by more than `kMostMendedVolume`.
[[nodiscard]] std::optional<SurfaceMesh> capped_shape(const SurfaceMesh& mesh, double crease_deg,
                                                      double margin);

}  // namespace meniscus
