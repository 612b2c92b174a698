#pragma once

#include <vector>

#include "meniscus/mesh/surface_mesh.hpp"
#include "meniscus/mesh/surface_tree.hpp"
#include "meniscus/surface/smooth_surface.hpp"

namespace meniscus {

/// The closed curve in which a plane cuts a thread.
struct Section {
  Vec3 center = Vec3::Zero();  ///< centroid of the curve
  Vec3 axis = Vec3::UnitX();   ///< unit normal of the plane
  double radius = 0.0;         ///< perimeter/2π [R0]
  double area = 0.0;           ///< enclosed [R0²]
  std::vector<Vec3> points;    ///< corners of the curve, in order
  std::vector<FaceId> faces;   ///< the face between each point and the next
};

enum class SectionKind { closed, wide, none };
struct SectionResult {
  SectionKind kind = SectionKind::none;
  Section section;
};

/// The curve around `center` in the plane through it normal to `axis`; where none goes around it,
/// the nearest. Only the cube within `reach` of `center` is searched. The curve is `wide` when it
/// leaves that cube, `none` when the plane meets no face there.
[[nodiscard]] SectionResult section_around(const SurfaceMesh& mesh, const SurfaceTree& tree,
                                           const Vec3& center, const Vec3& axis, double reach);

/// What a section of the faces of `mesh` encloses on the smooth surface through its vertices [R0²].
/// Over each face the curve becomes the parabola through its ends and middle there. A polygon
/// through the vertices of a ring of n edges lacks 2π²/3n² of it.
[[nodiscard]] double smooth_area(const Section& section, const SurfaceMesh& mesh,
                                 const SmoothSurface& surface);

}  // namespace meniscus
