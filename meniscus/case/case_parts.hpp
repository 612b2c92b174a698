#pragma once

#include <string>
#include <vector>

#include "meniscus/case/case.hpp"

namespace meniscus {

// Functions that read and check one table of a case each. All throw InvalidInput.

[[nodiscard]] ImposedFlow read_flow(Settings& settings);
/// Reads the viscosity law of the liquid in a table, "matrix" or "drop[2]".
[[nodiscard]] ViscosityLaw read_viscosity_law(Settings& settings, const std::string& table);
[[nodiscard]] std::vector<DropCase> read_drops(Settings& settings);
/// Reads [domain]; the flow decides the default conditions on a box.
[[nodiscard]] DomainCase read_domain(Settings& settings, const ImposedFlow& flow);
/// Reads the name or tag of the patch that a table, "domain.patch[2]", is about.
[[nodiscard]] PatchPlace read_patch_place(Settings& settings, DomainCase::Shape shape,
                                          const std::string& table);
/// Throws InvalidInput, naming the line of `patch`, when an earlier table is about the same faces.
void require_apart(const Settings& settings, const PatchPlace& patch, const PatchPlace& earlier);
/// Reads every [[scalar]], whose drops are those of the case.
[[nodiscard]] std::vector<ScalarCase> read_scalars(Settings& settings, const DomainCase& domain,
                                                   std::size_t num_drops);
/// Gives surfactants the species that they are in the liquids.
void read_adsorption(Settings& settings, const std::vector<ScalarCase>& scalars,
                     std::vector<DropCase>& drops);
/// Throws InvalidInput when there is a [[scalar]], of which boundary integrals know nothing.
void require_no_scalars(const Settings& settings);
/// Reads the Reynolds number, gravity and densities.
void read_inertia(Case& c);
/// Throws InvalidInput where another part of the case does not go with inertia or its absence.
void require_inertia_fits(const Case& c);
/// Defaults depend on the inertia Re Ca = ρ_out G² R0³/σ of liquids; infinite without tension.
[[nodiscard]] EvolutionOptions read_evolution(Settings& settings, FlowMethod method,
                                              fem::Elements elements, double inertia,
                                              FlowFamily family);
/// Reads [time.stop-when]. Rules that a case does not give leave no trace in its settings.
[[nodiscard]] StopRules read_stop_rules(Settings& settings, const DomainCase& domain);
/// Throws InvalidInput when a liquid is not Newtonian, as boundary integrals require.
void require_newtonian(const Case& c);
[[nodiscard]] FlowMethod read_method(Settings& settings, const DomainCase& domain);
/// The default of the residual depends on how steps are controlled, and on whether liquids or
/// interfaces carry anything (inertia, surfactant, scalars).
[[nodiscard]] fem::Options read_finite_elements(Settings& settings, bool carries_something);
[[nodiscard]] MovingMeshOptions read_volume_mesh(Settings& settings, fem::Elements elements);
[[nodiscard]] bem::Options read_boundary_integrals(Settings& settings);
[[nodiscard]] OutputOptions read_output(Settings& settings, FlowMethod method);

}  // namespace meniscus
