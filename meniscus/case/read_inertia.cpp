#include <cmath>
#include <string>

#include "meniscus/case/case_parts.hpp"

namespace meniscus {
namespace {

/// Throws InvalidInput where a case with inertia asks for what inertia knows nothing of.
void require_fit(const Case& c) {
  const Settings& settings = c.settings;
  if (c.method == FlowMethod::boundary_integral)
    settings.reject("solver.method",
                    "must be \"finite-element\" where liquids have inertia: boundary integrals "
                    "solve Stokes flow");
  if (c.flow_solver.linear != fem::LinearSolver::block)
    settings.reject("solver.linear", "must be \"block\" where liquids have inertia");
  if (c.flow_solver.capillary == fem::CapillaryForm::nodal)
    settings.reject("interface.surface-tension",
                    "must be \"weak\" or \"balanced\" where liquids have inertia");
  if (c.evolution.follows_drops)
    settings.reject("domain.frame", "must be \"fixed\" where liquids have inertia");
}

/// Reads the Bond number. Without a density or tension its unit is unknown, so that a default stays
/// unread.
Vec3 read_gravity(Case& c) {
  constexpr const char* kPath = "flow.gravity";
  Settings& settings = c.settings;
  if (!settings.is_given(kPath)) return Vec3::Zero();
  if (std::isinf(c.Ca))
    settings.reject(kPath, "needs surface tension: its unit is sigma/(rho_out R0²)");
  if (settings.scale() && settings.scale()->density == 0.0)
    settings.reject(kPath, "needs scale.density");
  return settings.vector(kPath);
}

}  // namespace

void read_inertia(Case& c) {
  Settings& settings = c.settings;
  if (settings.scale()) {
    const Scale& scale = *settings.scale();
    c.reynolds = scale.density * scale.rate * scale.length * scale.length / scale.viscosity;
  } else {
    c.reynolds = settings.number("flow.reynolds-number");
  }
  c.gravity = read_gravity(c);
  const bool has_weight = !c.gravity.isZero(0.0);
  bool is_given = false;
  for (std::size_t i = 0; i < c.drops.size(); ++i) {
    const std::string path = fmt::format("drop[{}].density-ratio", i);
    is_given |= settings.is_given(path);
    if (has_weight || c.reynolds > 0.0) c.drops[i].density_ratio = settings.number(path);
  }
  if (has_weight && !is_given)
    settings.reject("flow.gravity",
                    "needs drop.density-ratio: liquids of one density do not feel gravity");
}

void require_inertia_fits(const Case& c) {
  const bool is_implicit = c.evolution.scheme == TimeScheme::implicit;
  if (c.reynolds > 0.0 && !is_implicit)
    c.settings.reject("time.scheme", "must be \"implicit\" where liquids have inertia");
  if (c.reynolds == 0.0 && is_implicit)
    c.settings.reject("time.scheme",
                      "needs flow.reynolds-number or scale.density: Stokes flow has other schemes");
  if (c.reynolds > 0.0) require_fit(c);
}

}  // namespace meniscus
