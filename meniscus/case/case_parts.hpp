#pragma once

#include <string>
#include <vector>

#include "meniscus/case/case.hpp"

namespace meniscus {

// The tables of a case, each read and checked on its own. All throw InvalidInput.

[[nodiscard]] ImposedFlow read_flow(Settings& settings);
/// Reads the viscosity law of the liquid in a table, "matrix" or "drop[2]".
[[nodiscard]] ViscosityLaw read_viscosity_law(Settings& settings, const std::string& table);
[[nodiscard]] std::vector<DropCase> read_drops(Settings& settings);
/// The flow decides the default conditions on a box.
[[nodiscard]] DomainCase read_domain(Settings& settings, const ImposedFlow& flow);
[[nodiscard]] EvolutionOptions read_evolution(Settings& settings, FlowMethod method,
                                              fem::Elements elements);
/// Refuses liquids that boundary integrals cannot describe.
void require_newtonian(const Case& c);
[[nodiscard]] FlowMethod read_method(Settings& settings, const DomainCase& domain);
[[nodiscard]] fem::Options read_finite_elements(Settings& settings);
[[nodiscard]] bem::Options read_boundary_integrals(Settings& settings);
[[nodiscard]] OutputOptions read_output(Settings& settings, FlowMethod method);
/// Asks for the keys whose features are yet to come: they have one value so far.

}  // namespace meniscus
