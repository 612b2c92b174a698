#pragma once

#include <memory>
#include <vector>

#include "meniscus/app/frames.hpp"
#include "meniscus/evolve/evolution.hpp"

namespace meniscus::python {

/// The interfaces of one recorded state and what lives on them. Arrays share its ownership, so that
/// neither a step nor the end of the simulation takes their storage away.
struct SurfaceSnapshot {
  struct Part {
    int drop = 0, parent = -1;
    SurfaceMesh mesh;
    std::size_t first_vertex = 0, first_face = 0;  ///< in the arrays of `data`
  };
  std::vector<Part> parts;
  io::MeshData data;
};
[[nodiscard]] std::shared_ptr<const SurfaceSnapshot> surface_snapshot(const Evolution& evolution);

/// The volume mesh of one state and what lives on it.
struct VolumeSnapshot {
  TetMesh mesh;
  VolumeArrays arrays;
};
/// Null where the solver needs no volume mesh.
[[nodiscard]] std::shared_ptr<const VolumeSnapshot> volume_snapshot(const Evolution& evolution);

}  // namespace meniscus::python
