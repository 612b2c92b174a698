#pragma once

#include <string>

#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus {

/// The largest number of vertices that one surface is given: a few gigabytes while they are made.
inline constexpr double kMostVertices = 2e6;

/// How many vertices a surface will have, before they are made.
struct ForeseenVertices {
  double number = 0.0;  ///< infinite where lengths or coordinates are no numbers
  // The edge that asks for most, and the length it is to be cut into.
  VertexId a, b;
  double length = 0.0;
  [[nodiscard]] bool is_too_many() const { return !(number <= kMostVertices); }
};

/// The number of vertices for edges of a given length at each vertex: ∮2/(√3 l²) dS of even
/// triangles. Where that is more, the pieces that the edges of the surface are cut into count:
/// needles have next to no area.
[[nodiscard]] ForeseenVertices foresee_vertices(const SurfaceMesh& mesh,
                                                const VertexField<double>& length);
/// The number of vertices for edges of one length everywhere.
[[nodiscard]] ForeseenVertices foresee_vertices(const SurfaceMesh& mesh, double length);

/// Says that there would be too many, with the place.
[[nodiscard]] std::string too_many(const ForeseenVertices& vertices, const SurfaceMesh& mesh);

}  // namespace meniscus
