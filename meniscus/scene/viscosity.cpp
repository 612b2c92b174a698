#include "meniscus/scene/viscosity.hpp"

#include <cmath>

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

RelativeViscosity at_rate(const Newtonian&, double) { return {}; }

RelativeViscosity at_rate(const CarreauYasuda& law, double rate) {
  const double r = law.infinite_ratio, n = law.power_index, a = law.yasuda_exponent;
  const double u = std::pow(law.time_constant * rate, a);
  MENISCUS_ASSERT(a > 0.0, "yasuda exponent {}", a);
  const double thinned = (1.0 - r) * std::exp((n - 1.0) / a * std::log1p(u));
  const double value = r + thinned;
  // u/(1 + u), written so that an infinite u gives 1
  return {value, thinned / value * (n - 1.0) / (1.0 + 1.0 / u)};
}

RelativeViscosity at_rate(const PowerLaw& law, double rate) {
  const double value = std::pow(rate, law.power_index - 1.0);
  MENISCUS_ASSERT(law.floor >= 0.0 && law.ceiling >= law.floor, "{} {}", law.floor, law.ceiling);
  if (value <= law.floor) return {law.floor, 0.0};
  if (value >= law.ceiling) return {law.ceiling, 0.0};
  return {value, law.power_index - 1.0};
}

}  // namespace

RelativeViscosity relative_viscosity(const ViscosityLaw& law, double rate) {
  MENISCUS_ASSERT(!(rate < 0.0), "rate = {}", rate);
  return std::visit([rate](const auto& each) { return at_rate(each, rate); }, law);
}

}  // namespace meniscus
