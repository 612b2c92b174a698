#pragma once

#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus {

/// The figures by which a triangulation is judged. Lengths in the unit of its coordinates.
struct SurfaceQuality {
  std::int32_t num_vertices = 0, num_faces = 0, num_pieces = 0;
  int genus = 0;  ///< Σ over the pieces of (2 − V + E − F)/2: handles, 0 for spheres
  double volume = 0.0, area = 0.0;
  double min_edge = 0.0, mean_edge = 0.0, max_edge = 0.0;
  double min_angle_deg = 0.0;
  double low_angle_deg = 0.0;  ///< the 5 % quantile of all angles of all faces
  /// Mean over the faces of each one's smallest angle; 60 if all were equilateral.
  double mean_min_angle_deg = 0.0;
  double max_angle_deg = 0.0;
  /// Twice the radius of the inscribed circle over that of the circumscribed one: 1 equilateral,
  /// 0 flat.
  double min_radius_ratio = 0.0, mean_radius_ratio = 0.0;
  int min_valence = 0, max_valence = 0;
  double share_of_valence_6 = 0.0;
};

/// The figures of a closed oriented manifold. It may have any number of pieces; every face must
/// have an area.
[[nodiscard]] SurfaceQuality surface_quality(const SurfaceMesh& mesh,
                                             const SurfaceTopology& topology);

}  // namespace meniscus
