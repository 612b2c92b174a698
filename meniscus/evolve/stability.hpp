#pragma once

#include <span>

#include "meniscus/evolve/chebyshev.hpp"
#include "meniscus/evolve/interface_motion.hpp"
#include "meniscus/evolve/options.hpp"
#include "meniscus/scene/scene.hpp"

namespace meniscus {

/// The fastest rate at which tension smooths a wave that the interfaces' vertices can show [G]. Or
/// the elasticity of a surfactant does so with its concentration. A wave of wave number k decays at
/// σk/(2(μ_in + μ_out)), and a triangulation of edge h shows k ≤ √6/h. It is the largest √6 σ/(2
/// (μ_in + μ_out) h) of all vertices, h the mean edge at the vertex. By power iteration the fastest
/// wave of boundary integrals has 0.66 to 0.74 of it (tests/evolve/stability_test.cpp), which is
/// the margin of the steps below. The viscosities are those of the liquids at rest: thinning
/// liquids flow faster.
[[nodiscard]] double capillary_rate(const Scene& scene);
/// The fastest rate at which surfactant diffuses from vertex to vertex, 20 D/h² [G]: on equilateral
/// triangles it is 15 D/h².
[[nodiscard]] double diffusion_rate(const Scene& scene);

/// The longest step of a scheme for which no such wave grows; infinite where
/// nothing has tension [1/G].
[[nodiscard]] double longest_stable_step(const Scene& scene, TimeScheme scheme);

/// The way of the liquid past a vertex, in edges, that a step may take while waves are convected
/// over the mesh. It is 1.1 ρ^(−1/3) between 0.35 and 1.4. ρ = 2(μ_in + μ_out)u/σ is the ratio of
/// the rates at which a speed u convects a wave and tension smooths it. The midpoint rule makes a
/// wave that goes the way z/k grow by z⁴/8; tension takes z/ρ of it.
[[nodiscard]] double aimed_slip(double speed, double viscosities, double tension);

/// Where the rates of the waves of shapes lie in a step of length dt. They decay by tension; the
/// diffusion of a surfactant counts as decay. The liquid carries them past the vertices with
/// u = |velocity − motion|: |Im z| ≤ √6 uΔt/h and ρ|Re z|, with ρ as above. Of an interface without
/// tension there are none.
[[nodiscard]] WaveSpectrum wave_spectrum(const Scene& scene, const InterfaceMotion& motion,
                                         std::span<const VertexField<Vec3>> velocity, double dt);

}  // namespace meniscus
