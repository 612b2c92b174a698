#pragma once

#include "meniscus/flow/fem/options.hpp"
#include "meniscus/scene/scene.hpp"

namespace meniscus::fem {

/// The force −σ∫κ n φ_i dS with which a surface of the given tension pulls on the fluid at each of
/// its vertices (inward on a sphere) [μ_out G R0²]; eqs 15–17 of hooper2001.
[[nodiscard]] VertexField<Vec3> capillary_force(const SurfaceMesh& mesh, double tension,
                                                CapillaryForm form);
/// −σ∫κ_h n φ_i dS for a given P1 field κ_h and the normals of the faces. For constant κ_h it is a
/// discrete pressure gradient: no flow.
[[nodiscard]] VertexField<Vec3> balanced_force(const SurfaceMesh& mesh, double tension,
                                               const VertexField<double>& kappa);

}  // namespace meniscus::fem
