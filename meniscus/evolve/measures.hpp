#pragma once

#include <span>
#include <vector>

#include "meniscus/evolve/interface_motion.hpp"
#include "meniscus/evolve/record.hpp"
#include "meniscus/evolve/state.hpp"
#include "meniscus/evolve/surfactant_motion.hpp"
#include "meniscus/surface/known_surfaces.hpp"

namespace meniscus {

/// The surfaces that the interfaces of a scene stand for, which all measures are made on.
[[nodiscard]] InterfaceSurfaces reconstructed_interfaces(const Scene& scene, SurfaceShape shape,
                                                         KnownSurfaces& known);

/// What history.csv has of all interfaces together.
struct InterfaceTotals {
  std::optional<double> min_gap;
  double surface_rate = 0.0;   ///< power spent against tension [μ_out G² R0³]
  std::optional<Mat3> stress;  ///< `drop_stress`; empty where the matrix is not Newtonian
};

/// The totals of a state whose flow was solved. `motion` is the velocity of the interfaces'
/// vertices; `faces` are the state's interfaces.
[[nodiscard]] InterfaceTotals interface_totals(const State& state, const FlowSolution& flow,
                                               const InterfaceMotion& motion,
                                               const InterfaceSurfaces& faces);
void save(const InterfaceTotals& totals, Archive& archive);
[[nodiscard]] InterfaceTotals load_interface_totals(const Archive& archive);

/// The row of history.csv of a state whose flow was solved.
[[nodiscard]] HistoryRow history_row(const State& state, const FlowSolution& flow,
                                     const InterfaceTotals& totals);

/// The rows of drops.csv, one per interface. Necks are searched if `breakup_radius` is positive.
[[nodiscard]] std::vector<DropRow> drop_rows(const State& state, const InterfaceSurfaces& faces,
                                             double breakup_radius, Carriers& carriers);

/// How drop i moves at time t; none where the flow of the regions is not known.
[[nodiscard]] std::optional<DropMotion> drop_motion(const Scene& scene, double t, std::size_t i,
                                                    const DropShape& shape,
                                                    const FlowSolution& flow);

}  // namespace meniscus
