#pragma once

#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus {

/// (x1 − x0) × (x2 − x0)/2: outward, its length the area of the face [R0²].
[[nodiscard]] Vec3 face_area_vector(const SurfaceMesh& mesh, FaceId f);
/// The area of each face [R0²].
[[nodiscard]] FaceField<double> face_areas(const SurfaceMesh& mesh);
[[nodiscard]] double surface_area(const SurfaceMesh& mesh);
/// Volume enclosed, 1/6 Σ_f x0·(x1 × x2), positive when the faces are outward [R0³]. Summed about
/// the mean vertex, so that a distant drop loses no digits.
[[nodiscard]] double enclosed_volume(const SurfaceMesh& mesh);
/// Centroid of the enclosed volume (not of the surface).
[[nodiscard]] Vec3 enclosed_centroid(const SurfaceMesh& mesh);
/// Mean vertex position.
[[nodiscard]] Vec3 mean_vertex(const SurfaceMesh& mesh);
/// Second moments ∫(x − c)(x − c)ᵀ dV of the enclosed volume about its centroid [R0⁵].
[[nodiscard]] Mat3 enclosed_second_moments(const SurfaceMesh& mesh);

/// A_i = ∂V/∂x_i = 1/3 Σ_{f∋i} (area vector of f), the area vector of each vertex [R0²].
[[nodiscard]] VertexField<Vec3> vertex_area_vectors(const SurfaceMesh& mesh);
/// ΔS_i, a third of the area of the faces at each vertex [R0²] (eq. 17 of hooper2001).
[[nodiscard]] VertexField<double> vertex_areas(const SurfaceMesh& mesh);
/// ∂S/∂x_i of the total area S [R0]; ∫_S (I − nn):∇φ_i dS of eq. 15 of hooper2001 on flat faces.
[[nodiscard]] VertexField<Vec3> area_gradient(const SurfaceMesh& mesh);

[[nodiscard]] double shortest_edge(const SurfaceMesh& mesh);
[[nodiscard]] double mean_edge(const SurfaceMesh& mesh);
/// Smallest angle of all faces [degrees].
[[nodiscard]] double smallest_angle_deg(const SurfaceMesh& mesh);
[[nodiscard]] bool is_finite(const SurfaceMesh& mesh);

}  // namespace meniscus
