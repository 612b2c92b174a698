#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "meniscus/evolve/interface_motion.hpp"
#include "meniscus/flow/scalar_solver.hpp"
#include "meniscus/transport/surface_transport.hpp"

namespace meniscus {

/// An interface as what carries its surfactant, at one instant.
struct Carrier {
  explicit Carrier(const SurfaceMesh& at, SurfaceShape shape)
      : mesh(at), surface(mesh, shape), mass(surface) {}
  Carrier(const Carrier&) = delete;
  Carrier& operator=(const Carrier&) = delete;

  SurfaceMesh mesh;
  CarrierSurface surface;
  SurfaceMass mass;
};

/// Makes carriers and remembers the last ones: stages, steps and their ends ask for the same.
class Carriers {
 public:
  /// Of flat faces, or of those on patches.
  explicit Carriers(SurfaceShape shape)
      : shape_(shape == SurfaceShape::faceted ? shape : SurfaceShape::patched) {}
  [[nodiscard]] std::shared_ptr<const Carrier> of(const SurfaceMesh& mesh);
  /// The carriers of the interfaces that have a surfactant; null of others.
  [[nodiscard]] std::vector<std::shared_ptr<const Carrier>> of(const Scene& scene);

 private:
  SurfaceShape shape_;
  std::deque<std::shared_ptr<const Carrier>> last_;
};
using SceneCarriers = std::vector<std::shared_ptr<const Carrier>>;

/// Rates at which the amounts of surfactant at the vertices change, by interface; empty where there
/// is none. An amount is ∫φ_v Γ dS [R0²] (`SurfaceMass`), Γ being over its initial value.
using AmountRates = std::vector<VertexField<double>>;

/// Transport of the surfactants of a scene, by interface; empty where there is none.
using SurfactantTransport = std::vector<std::optional<SurfaceTransport>>;
/// For liquid that moves with `velocity` over vertices that move with `motion`.
[[nodiscard]] SurfactantTransport surfactant_transport(const Scene& scene,
                                                       const SceneCarriers& carriers,
                                                       std::span<const VertexField<Vec3>> velocity,
                                                       const InterfaceMotion& motion);
/// a first + b second, of the same interfaces.
[[nodiscard]] SurfactantTransport combined(double a, const SurfactantTransport& first, double b,
                                           const SurfactantTransport& second);
/// The rates at this instant, at the concentrations of the scene.
[[nodiscard]] AmountRates amount_rates(const SurfactantTransport& transport, const Scene& scene);

/// A way of the interfaces with surfactant from the scene `start` on.
struct SurfactantPath {
  const Scene& start;
  SceneCarriers at_start, at_end;
  double duration = 0.0;
};
/// The constant rates that take the amounts along a path: implicit, of second order with the
/// transport of its middle.
[[nodiscard]] AmountRates mean_amount_rates(const SurfactantTransport& transport,
                                            const SurfactantPath& path);

/// What sources of amounts add to those rates.
[[nodiscard]] AmountRates rates_of_sources(const SurfactantTransport& transport,
                                           const SurfactantPath& path, const AmountRates& sources);

/// Mean rates ∂Γ/∂t at the vertices, by interface; empty where there is no surfactant [G].
using ConcentrationRates = std::vector<VertexField<double>>;
/// Those of the concentrations to which rates of amounts lead: they hold how the surface stretched
/// as well.
[[nodiscard]] ConcentrationRates concentration_rates(const SurfactantPath& path,
                                                     const AmountRates& rates);
/// The rates of amounts that lead there.
[[nodiscard]] AmountRates amount_rates_of(const SurfactantPath& path,
                                          const ConcentrationRates& rates);

/// c of the species beside each vertex, by interface; empty where no surfactant is soluble.
[[nodiscard]] std::vector<VertexField<double>> species_beside(const Scene& scene,
                                                              const TetMesh& mesh,
                                                              const BulkScalars& scalars);
/// The rates j = Bi [K c (1 − XΓ) − Γ] at which a step of length τ is to expect that surfactants
/// adsorb, by interface [G]. They are empty where none is soluble:
///   j/[1 + τ Bi (1 + K X c)],
/// right to first order in τ. It never leads beyond equilibrium with the c at hand.
[[nodiscard]] ConcentrationRates expected_adsorption(const Scene& scene,
                                                     std::span<const VertexField<double>> species,
                                                     double duration);
/// The same as sources of amounts on the carriers of that scene.
[[nodiscard]] AmountRates expected_uptake(const Scene& scene, const SceneCarriers& carriers,
                                          std::span<const VertexField<double>> species,
                                          double duration);

/// Gives interfaces at the end of a path the concentrations to which these rates lead. Σ_v S_v Γ_v
/// changes by round-off alone.
void move_surfactant(Scene& scene, const SurfactantPath& path, const AmountRates& rates);
/// Gives the interfaces that took the place of others, by remeshing, restored volumes or events,
/// their amounts. Each drop gets its own, new ones by one factor all of those that are gone. Fields
/// are conserved as amounts on flat faces, which differ.
void keep_surfactant(Scene& scene, const Scene& before, Carriers& carriers);

/// Adds to concentrations what the surfactants took up at their vertices in `duration`, beyond what
/// they hold as expected. Both are by interface, empty where they took up nothing.
void take_up(Scene& scene, std::span<const VertexField<double>> uptake, const AmountRates& expected,
             double duration, Carriers& carriers);

/// max_v |Δc_v|/⟨Γ⟩ R/h over all vertices, Δc being the `settled` concentration of dt Δṁ. It is how
/// far rates of second and of first order take a concentration apart in a step. It counts as
/// `step_error` counts a displacement over the radius R of the drop's sphere. h is its mean edge.
[[nodiscard]] double surfactant_error(const SurfactantPath& path,
                                      const SurfactantTransport& transport,
                                      const AmountRates& second, const AmountRates& first);

}  // namespace meniscus
