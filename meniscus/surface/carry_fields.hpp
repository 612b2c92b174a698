#pragma once

#include <span>
#include <vector>

#include "meniscus/mesh/carried_fields.hpp"

namespace meniscus {

/// A surface and what lives on it.
struct CarryingSurface {
  SurfaceMesh mesh;
  SurfaceFields fields;
};

/// Makes `excess` the larger of itself and another.
void widen(FieldExcess& excess, const FieldExcess& other);
/// Adds to `excess` that of a further transfer of the same fields.
void follow(FieldExcess& excess, const FieldExcess& next);

/// Barycentric centres of the cuts² equal parts of a triangle whose sides are cut in `cuts`.
[[nodiscard]] std::vector<Vec3> part_centers(int cuts);

/// Follows a motion of the vertices of a mesh, its faces being the same. Interpolated fields keep
/// their values. Conserved ones become value · m_before / m_after, m being the area of the face or
/// a third of that of the faces at the vertex [R0²]. So Σ value · m stays. Returns by how much that
/// leaves the range the field had.
FieldExcess move_fields(SurfaceFields& fields, const SurfaceMesh& before, const SurfaceMesh& after);

/// Fields on the surface that has taken the place of another, and by how much they left the range.
struct [[nodiscard]] ReplacedFields {
  SurfaceFields fields;
  FieldExcess excess;
};

/// Carries fields to a closed surface that replaces another in part or as a whole, and may have
/// other pieces: what surgery and mending leave.
///
/// Vertices and faces of both, at the same positions, keep their values; others take that of the
/// nearest points. The amount of an old face that is gone goes to what is nearest to its parts.
/// What a new element then has beyond value · measure is evened out along a few edges. It is given
/// to the elements as far as the old range lets them take it; the rest is passed on. What no
/// neighbour takes is shared by the whole piece, v + θ (max − v) or v − θ (v − min). Beyond the
/// range the parts are equal. Amounts add up over the pieces to round-off. O(n log n).
///
/// `settled` is `after` with its vertices shifted a little, as to restore its volume: it is there
/// that amounts are kept.
ReplacedFields replaced_fields(const SurfaceFields& fields, const SurfaceMesh& before,
                               const SurfaceMesh& after, const SurfaceMesh& settled);
ReplacedFields replaced_fields(const SurfaceFields& fields, const SurfaceMesh& before,
                               const SurfaceMesh& after);

/// The fields of surfaces that `joined_surface` makes one, in the same order. All must have the
/// same list.
[[nodiscard]] SurfaceFields joined_fields(std::span<const SurfaceFields> parts);
/// The fields of the pieces that `joined_surface` made one.
[[nodiscard]] std::vector<SurfaceFields> split_fields(const SurfaceFields& whole,
                                                      std::span<const SurfaceMesh> pieces);
/// Whether two surfaces have fields of the same names and transfers in the same order.
[[nodiscard]] bool have_same_fields(const SurfaceFields& a, const SurfaceFields& b);

}  // namespace meniscus
