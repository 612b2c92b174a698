#include "meniscus/evolve/chebyshev.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

/// ε. With the least one |P| ≤ 1 − ε/3 between the ends of the interval [sommeijer1998].
constexpr std::array kDampings{ChebyshevScheme::kLeastDamping, 0.5, 1.0, 2.0,
                               ChebyshevScheme::kMostDamping};
/// Points per stage on each side of a spectrum. |P| has a maximum per stage there.
constexpr int kTestsPerStage = 12;
/// A scheme that lets waves grow replaces a cheaper one that lets them grow by so much more.
constexpr double kWorthAStage = 0.99;
constexpr double kRoundOff = 1e-12;

double damped_end(int num_stages, double damping) {
  return 1.0 + damping / (num_stages * num_stages);
}

/// T_j and its two derivatives at one argument.
struct Chebyshev {
  double value = 0.0, first = 0.0, second = 0.0;
};

/// T_0 to T_s at w, by T_j = 2w T_{j−1} − T_{j−2} and what follows for the derivatives.
std::vector<Chebyshev> chebyshev_polynomials(int s, double w) {
  std::vector<Chebyshev> T{{1.0, 0.0, 0.0}, {w, 1.0, 0.0}};
  for (std::size_t j = 2; j <= static_cast<std::size_t>(s); ++j) {
    const Chebyshev &a = T[j - 1], &b = T[j - 2];
    T.push_back({2.0 * w * a.value - b.value, 2.0 * (a.value + w * a.first) - b.first,
                 2.0 * (2.0 * a.first + w * a.second) - b.second});
  }
  return T;
}

}  // namespace

ChebyshevScheme::ChebyshevScheme(int num_stages, double damping)
    : w0_(damped_end(num_stages, damping)) {
  MENISCUS_ASSERT(num_stages >= 3, "{} stages", num_stages);
  const auto s = static_cast<std::size_t>(num_stages);
  const std::vector<Chebyshev> T = chebyshev_polynomials(num_stages, w0_);
  std::vector<double> b(s + 1), a(s + 1);
  for (std::size_t j = 2; j <= s; ++j) b[j] = T[j].second / (T[j].first * T[j].first);
  b[0] = b[1] = b[2];
  for (std::size_t j = 0; j <= s; ++j) a[j] = 1.0 - b[j] * T[j].value;
  w1_ = T[s].first / T[s].second;
  a_ = a[s];
  b_ = b[s];
  stages_.push_back({.mu_F = b[1] * w1_});
  for (std::size_t j = 2; j <= s; ++j) {
    const double mu_F = 2.0 * b[j] * w1_ / b[j - 1];
    stages_.push_back({.mu = 2.0 * b[j] * w0_ / b[j - 1],
                       .nu = -b[j] / b[j - 2],
                       .mu_F = mu_F,
                       .gamma_F = -a[j - 1] * mu_F,
                       .c = w1_ * T[j].second / T[j].first});
  }
  stages_[0].c = stages_[0].mu_F;
}

ChebyshevScheme ChebyshevScheme::for_waves(const WaveSpectrum& waves, int most_stages) {
  ChebyshevScheme best(most_stages);
  double least = std::numeric_limits<double>::infinity();
  for (int s = std::min(num_stages_for(waves.decay), most_stages); s <= most_stages; ++s)
    for (const double damping : kDampings) {
      ChebyshevScheme scheme(s, damping);
      const double growth = scheme.largest_growth(waves);
      if (growth <= 1.0 + kRoundOff) return scheme;
      if (growth > kWorthAStage * least) continue;
      least = growth;
      best = std::move(scheme);
    }
  return best;
}

std::complex<double> ChebyshevScheme::stability_polynomial(std::complex<double> z) const {
  const std::complex<double> w = w0_ + w1_ * z;
  std::complex<double> before = 1.0, now = w;
  for (std::size_t j = 2; j <= stages_.size(); ++j)
    before = std::exchange(now, 2.0 * w * now - before);
  return a_ + b_ * now;
}

double ChebyshevScheme::stability_polynomial(double z) const {
  return stability_polynomial(std::complex<double>(z)).real();
}

double ChebyshevScheme::largest_growth(const WaveSpectrum& waves) const {
  if (waves.decay * w1_ > 1.0 + w0_) return std::numeric_limits<double>::infinity();
  // A polynomial is largest on the edge of a region. Its upper half has three sides: waves that are
  // convected in proportion to their decay, those convected fastest, those that decay fastest.
  const double top = std::min(waves.ratio * waves.decay, waves.convection);
  const std::complex<double> corner(waves.ratio > 0.0 ? -top / waves.ratio : -waves.decay, top),
      fastest(-waves.decay, top), rest(-waves.decay, 0.0);
  const int num_tests = kTestsPerStage * static_cast<int>(stages_.size());
  double growth = 0.0;
  const auto pass = [&](std::complex<double> from, std::complex<double> to) {
    for (int k = 0; k <= num_tests; ++k)
      growth = std::max(growth,
                        std::abs(stability_polynomial(from + double(k) / num_tests * (to - from))));
  };
  pass(0.0, corner);
  pass(corner, fastest);
  pass(fastest, rest);
  return growth;
}

double ChebyshevScheme::stability_interval(int num_stages, double damping) {
  const double w0 = damped_end(num_stages, damping);
  const Chebyshev T = chebyshev_polynomials(num_stages, w0).back();
  return (1.0 + w0) * T.second / T.first;  // where w0 + w1 z = −1
}

int ChebyshevScheme::num_stages_for(double interval) {
  int s = 3;
  while (stability_interval(s) < interval) ++s;
  return s;
}

}  // namespace meniscus
