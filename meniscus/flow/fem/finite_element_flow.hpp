#pragma once

#include <memory>

#include "meniscus/flow/fem/known_elements.hpp"
#include "meniscus/flow/fem/options.hpp"

namespace meniscus::fem {

/// Two-phase Stokes flow by finite elements on a conforming tetrahedral mesh, pressure doubled on
/// the interfaces. They are P1–P1 with PSPG stabilisation (appendix of hooper2001), or P2–P1
/// (Taylor–Hood), curved at curved surfaces. `elements` are those of the options' kind that scalars
/// may share.
[[nodiscard]] std::unique_ptr<FlowSolver> make_finite_element_flow(
    const Options& options, std::shared_ptr<KnownElements> elements);
[[nodiscard]] std::unique_ptr<FlowSolver> make_finite_element_flow(const Options& options);

}  // namespace meniscus::fem
