#pragma once

#include "meniscus/flow/fem/stokes_problem.hpp"
#include "meniscus/scene/scene.hpp"

namespace meniscus::fem {

/// What a drop looks like whose flow is asked for, each of the volume of the unit sphere.
enum class DropShape {
  sphere,
  prolate,  ///< ellipsoid of revolution, 4 : 1
  dumbbell  ///< oval of Cassini of revolution, drawn to 2 : 1: half a length of 3.2, a neck of
            ///< radius 0.11 between bulbs of radius 0.56
};

/// The surface of a shape along the x-axis, remeshed to the density ρ = C0⟨κ⟩² with C0 = N0/4π.
[[nodiscard]] SurfaceMesh graded_surface(DropShape shape, int N0);

/// A drop of such a shape in uniaxial extension at Ca = 0.17, in a sphere of radius 10.
[[nodiscard]] Scene stretched_drop(DropShape shape, int N0, double lambda);

/// The flow problem of that instant, with the weak capillary force.
[[nodiscard]] StokesProblem instant(const Scene& scene, const TetMesh& mesh,
                                    const FlowSpace& space);

}  // namespace meniscus::fem
