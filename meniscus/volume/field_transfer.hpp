#pragma once

#include "meniscus/mesh/carried_fields.hpp"
#include "meniscus/scene/region_sources.hpp"

namespace meniscus {

/// The fields of a mesh on another mesh of the same liquids (docs/fields.md, "In the bulk").
/// Conserved: integrals of a limited linear reconstruction over the intersections of cells. Σ v |c|
/// stays to round-off over the regions that share liquid. Interpolated: the same means in cells, P1
/// with slopes at vertices, in the old range. Second order for like interfaces; O(n log n).
/// Raises `excess` by what conserved values leave the old range of their regions.
/// Throws InvalidInput when a field does not fit the mesh (`check_fields`).
[[nodiscard]] VolumeFields transfer_fields(const VolumeFields& fields, const TetMesh& before,
                                           const TetMesh& after, FieldExcess& excess,
                                           const RegionSources& sources = {});

/// The fields after vertices moved, connectivity kept: interpolated values stay, conserved ones
/// become v |c before| / |c after|. Raises `excess` as `transfer_fields` does. Linear.
void move_fields(VolumeFields& fields, const TetMesh& before, const TetMesh& after,
                 FieldExcess& excess);

}  // namespace meniscus
