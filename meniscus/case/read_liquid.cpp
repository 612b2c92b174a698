#include <string>

#include "meniscus/case/case_parts.hpp"
#include "meniscus/case/words.hpp"

namespace meniscus {

ViscosityLaw read_viscosity_law(Settings& settings, const std::string& table) {
  const words::LawKind kind = settings.choice(table + ".viscosity-law", words::viscosity_laws);
  if (kind == words::LawKind::carreau_yasuda)
    return CarreauYasuda{.time_constant = settings.number(table + ".time-constant"),
                         .power_index = settings.number(table + ".power-index"),
                         .yasuda_exponent = settings.number(table + ".yasuda-exponent"),
                         .infinite_ratio = settings.number(table + ".infinite-shear-ratio")};
  if (kind == words::LawKind::power_law)
    return PowerLaw{.power_index = settings.number(table + ".power-index"),
                    .floor = settings.number(table + ".viscosity-floor"),
                    .ceiling = settings.number(table + ".viscosity-ceiling")};
  return Newtonian{};
}

void require_newtonian(const Case& c) {
  const auto require = [&c](const ViscosityLaw& law, const std::string& table) {
    if (!is_newtonian(law))
      c.settings.reject(table + ".viscosity-law",
                        "needs solver.method = \"finite-element\": boundary integrals describe "
                        "Newtonian liquids alone");
  };
  require(c.matrix_law, "matrix");
  for (std::size_t i = 0; i < c.drops.size(); ++i)
    require(c.drops[i].law, fmt::format("drop[{}]", i));
}

}  // namespace meniscus
