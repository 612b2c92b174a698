#pragma once

#include "meniscus/core/archive.hpp"
#include "meniscus/core/fault.hpp"
#include "meniscus/evolve/volume_restoration.hpp"

namespace meniscus {

/// The outcome of remeshing one interface. With a fault its triangles are unchanged.
struct [[nodiscard]] InterfaceRemesh : Report {
  int drop = 0;
  bool is_mended = false;      ///< repair changed its shape or triangles before
  double smoothed_over = 0.0;  ///< [R0] smoothing length of the whole surface; 0: not smoothed
  int closed_holes = 0;        ///< holes that closed with a crevice
};

/// An interface after remeshing.
struct RemeshedInterface {
  SurfaceMesh mesh;
  SurfaceFields fields;
  VolumeShift shift;
  InterfaceRemesh outcome;
};

/// Saves a remeshed interface bit for bit, for the ranks that did not remesh it.
void save(const RemeshedInterface& remeshed, Archive& archive);
/// Throws InvalidInput when the archive is damaged.
[[nodiscard]] RemeshedInterface load_remeshed(const Archive& archive);

}  // namespace meniscus
