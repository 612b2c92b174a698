#pragma once

#include <optional>
#include <vector>

#include "meniscus/core/fault.hpp"
#include "meniscus/surface/carry_fields.hpp"
#include "meniscus/topology/necks.hpp"

namespace meniscus {

/// What surgery leaves of a surface: its pieces, or why it could not be done.
struct [[nodiscard]] Surgery {
  std::vector<SurfaceMesh> pieces;
  std::optional<Fault> fault = {};
  /// What the pieces were made of, where that is not the parents themselves but their surfaces
  /// refined, and what lives on it; no mesh otherwise.
  CarryingSurface refined = {};
};

/// Cuts a thread. The band of faces around the neck within 1.5 of its radius from the middle is
/// taken out, and the two ends are rounded off. Pieces come in the order of their first faces, each
/// with the orientation it had.
Surgery cut_neck(const SurfaceMesh& mesh, const Neck& neck);

}  // namespace meniscus
