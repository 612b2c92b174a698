#include "meniscus/case/case.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>

#include "meniscus/case/case_parts.hpp"

namespace meniscus {
namespace {

std::string read_text(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error))
    reject_input("{}: is a folder, not a case file", file.string());
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) reject_input("{}: cannot be read: {}", file.string(), std::strerror(errno));
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// Reads [scale] and returns the capillary number, which [scale] or [flow] gives.
double read_scale(Settings& settings) {
  if (!settings.has_table("scale")) return settings.number("flow.capillary-number");
  Scale scale{.length = settings.number("scale.length"),
              .viscosity = settings.number("scale.viscosity"),
              .surface_tension = settings.number("scale.surface-tension"),
              .density = settings.number("scale.density")};
  const bool is_quiescent =
      settings.is_given("flow.kind") && settings.text("flow.kind") == "quiescent";
  scale.rate = is_quiescent && scale.surface_tension > 0.0
                   ? settings.number_or("scale.rate",
                                        scale.surface_tension / (scale.viscosity * scale.length))
                   : settings.number("scale.rate");
  settings.set_scale(scale);
  return scale.surface_tension == 0.0
             ? std::numeric_limits<double>::infinity()
             : scale.viscosity * scale.rate * scale.length / scale.surface_tension;
}

/// Whether nothing sets a rate G: no flow at any time, and no patch that drives one.
bool is_without_rate(const Case& c) {
  const bool is_at_rest =
      c.flow.initial_gradient().isZero(0.0) &&
      std::ranges::all_of(c.flow.schedule(), [](const ImposedFlow::Entry& entry) {
        return entry.gradient.isZero(0.0);
      });
  return is_at_rest && std::ranges::all_of(c.domain.patches, [](const PatchCase& patch) {
           return patch.velocity.isZero(0.0) && patch.traction.isZero(0.0);
         });
}

/// Throws InvalidInput unless Ca is 1 in a case without rate, where time is in mu_out R0/sigma.
void require_capillary_time(const Case& c) {
  const bool is_one = c.Ca == 1.0 || std::isinf(c.Ca);
  if (!c.settings.scale() && !is_one && is_without_rate(c))
    c.settings.reject("flow.capillary-number",
                      "must be 1 or inf where neither the flow nor a patch sets a rate: times are "
                      "in mu_out R0/sigma");
}

/// Throws InvalidInput where tension varies along a surface and its form knows no gradient of it.
void require_weak_form(const Case& c) {
  const bool has_surfactant = std::ranges::any_of(
      c.drops, [](const DropCase& drop) { return drop.surfactant.has_value(); });
  if (has_surfactant && c.flow_solver.capillary != fem::CapillaryForm::weak)
    c.settings.reject("interface.surface-tension",
                      "must be \"weak\" where a drop has a surfactant: the other forms know no "
                      "gradient of tension");
  const bool has_slope = std::ranges::any_of(
      c.scalars, [](const ScalarCase& each) { return each.scalar.tension_slope != 0.0; });
  if (has_slope && c.flow_solver.capillary != fem::CapillaryForm::weak)
    c.settings.reject(
        "interface.surface-tension",
        "must be \"weak\" where a scalar has a tension-slope: the other forms know no "
        "gradient of tension");
}

/// The keys that are used when the file is read without overrides; none if it is no valid case
/// alone.
std::map<std::string, schema::Value> used_by_file(std::string_view text, const std::string& name,
                                                  const std::filesystem::path& folder) {
  try {
    return parse_case(text, name, folder, {}).settings.used();
  } catch (const InvalidInput&) {
    return {};
  }
}

/// Whether a flow depends on more than the shapes of the drops.
bool carries_something(const Case& c) {
  return c.reynolds > 0.0 || !c.scalars.empty() ||
         std::ranges::any_of(c.drops,
                             [](const DropCase& drop) { return drop.surfactant.has_value(); });
}

}  // namespace

Case parse_case(std::string_view text, const std::string& name, const std::filesystem::path& folder,
                std::span<const std::string> overrides) {
  Case c;
  c.settings = Settings(schema::parse_document(text, name, folder, overrides));
  c.title = c.settings.text("title");
  c.Ca = read_scale(c.settings);
  c.flow = read_flow(c.settings);
  c.matrix_body_force = c.settings.vector("matrix.body-force");
  c.matrix_law = read_viscosity_law(c.settings, "matrix");
  c.drops = read_drops(c.settings);
  c.domain = read_domain(c.settings, c.flow);
  require_capillary_time(c);
  read_inertia(c);
  c.method = read_method(c.settings, c.domain);
  if (c.method == FlowMethod::boundary_integral) {
    require_newtonian(c);
    require_no_scalars(c.settings);
    c.boundary_integral = read_boundary_integrals(c.settings);
  } else {
    c.scalars = read_scalars(c.settings, c.domain, c.drops.size());
    read_adsorption(c.settings, c.scalars, c.drops);
    c.flow_solver = read_finite_elements(c.settings, carries_something(c));
    require_weak_form(c);
    c.volume_mesh = read_volume_mesh(c.settings, c.flow_solver.elements);
  }
  const double inertia = c.reynolds > 0.0 ? c.reynolds * c.Ca : 0.0;
  c.evolution =
      read_evolution(c.settings, c.method, c.flow_solver.elements, inertia, c.flow.family());
  require_inertia_fits(c);
  c.stop = read_stop_rules(c.settings, c.domain);
  if (!c.scalars.empty() && c.evolution.follows_drops)
    c.settings.reject("domain.frame",
                      "must be \"fixed\" with a [[scalar]]: what is carried would not follow");
  c.output = read_output(c.settings, c.method);
  // An override may choose another solver or boundary. Keys of the file for the old one are then no
  // mistake.
  if (overrides.empty())
    c.settings.require_all_used({});
  else
    c.settings.require_all_used(used_by_file(text, name, folder));
  return c;
}

Case read_case(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return parse_case(read_text(file), file.string(), file.parent_path(), overrides);
}

}  // namespace meniscus
