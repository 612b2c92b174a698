#pragma once

#include <optional>

#include "meniscus/evolve/record.hpp"
#include "meniscus/flow/scalar_solver.hpp"

namespace meniscus {

/// Gives interfaces the factor of their tension that bulk scalars make at their vertices. The first
/// vertex that is left without tension is a fault.
std::optional<Fault> set_tension_factors(Scene& scene, const TetMesh& mesh,
                                         const BulkScalars& scalars);
/// Whether a scalar of the scene does something to the flow.
[[nodiscard]] bool act_on_flow(const Scene& scene);

/// The bulk scalars' part of a row of history.csv, and of those of drops.csv, by interface.
[[nodiscard]] std::vector<ScalarTotals> scalar_totals(std::span<const ScalarMeasures> measures,
                                                      const BulkScalars& scalars);
[[nodiscard]] std::vector<ScalarOnDrop> scalars_on_drop(const Scene& scene, std::size_t interface,
                                                        std::span<const ScalarMeasures> measures);

}  // namespace meniscus
