#include "meniscus/scene/surfactant.hpp"

#include <cmath>
#include <limits>

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

RelativeTension at(const LinearState& law, double concentration) {
  return {1.0 - law.elasticity * (concentration - 1.0), -law.elasticity};
}

RelativeTension at(const LangmuirState& law, double concentration) {
  const double E = law.elasticity, X = law.coverage;
  const double initial = 1.0 + E * std::log1p(-X);
  return {(1.0 + E * std::log1p(-X * concentration)) / initial,
          -E * X / ((1.0 - X * concentration) * initial)};
}

double packing(const LinearState&) { return kInfinity; }
double packing(const LangmuirState& law) { return 1.0 / law.coverage; }

double zero_tension(const LinearState& law) { return 1.0 + 1.0 / law.elasticity; }
double zero_tension(const LangmuirState& law) {
  return -std::expm1(-1.0 / law.elasticity) / law.coverage;
}

}  // namespace

RelativeTension relative_tension(const EquationOfState& state, double concentration) {
  MENISCUS_ASSERT(concentration < packing_limit(state), "concentration {}", concentration);
  return std::visit([=](const auto& law) { return at(law, concentration); }, state);
}

double packing_limit(const EquationOfState& state) {
  return std::visit([](const auto& law) { return packing(law); }, state);
}

double zero_tension_concentration(const EquationOfState& state) {
  return std::visit([](const auto& law) { return zero_tension(law); }, state);
}

}  // namespace meniscus
