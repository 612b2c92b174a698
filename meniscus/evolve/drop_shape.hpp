#pragma once

#include <optional>

#include "meniscus/mesh/surface_mesh.hpp"
#include "meniscus/scene/imposed_flow.hpp"
#include "meniscus/surface/reconstructed_surface.hpp"

namespace meniscus {

/// The measures of one drop in drops.csv (definitions: docs/notation.md). Lengths refer to the
/// smooth interface through the vertices; volume, area and D_inertia to the flat or curved faces;
/// the centroid to the flat faces.
struct DropShape {
  double volume = 0.0, area = 0.0;
  Vec3 centroid = Vec3::Zero();
  double L = 0.0, B = 0.0, W = 0.0;
  double D = 0.0;                   ///< (L − B)/(L + B)
  std::optional<double> angle_deg;  ///< of L from the flow direction; planar flows only
  double extent_x = 0.0;            ///< half of the extent in x
  double H_max = 0.0;               ///< largest half-sum of the principal curvatures
  double D_inertia = 0.0;           ///< deformation of the ellipsoid with the same second moments
};
/// Planar flows lie in the x-y plane with x the flow direction, axial ones have x as their axis.
[[nodiscard]] DropShape drop_shape(const SurfaceMesh& mesh, FlowFamily family,
                                   const ReconstructedSurface& faces);

/// (a − c)/(a + c), a and c the largest and the smallest half-axis of the ellipsoid with these
/// second moments. They are ∫ (x − c)(x − c)ᵀ dV about its centroid: along an axis a it is V a²/5.
[[nodiscard]] double inertial_deformation(const Mat3& second_moments, double volume);

}  // namespace meniscus
