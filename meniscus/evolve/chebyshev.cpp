#include "meniscus/evolve/chebyshev.hpp"

#include <cmath>

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

/// Damping: T_s is taken at w0 = 1 + ε/s², so that |P| ≤ 1 − ε/3 between its ends [sommeijer1998].
constexpr double kDamping = 2.0 / 13.0;

double damped_end(int num_stages) { return 1.0 + kDamping / (num_stages * num_stages); }

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

ChebyshevScheme::ChebyshevScheme(int num_stages) : w0_(damped_end(num_stages)) {
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

double ChebyshevScheme::stability_polynomial(double z) const {
  return a_ +
         b_ * chebyshev_polynomials(static_cast<int>(stages_.size()), w0_ + w1_ * z).back().value;
}

double ChebyshevScheme::stability_interval(int num_stages) {
  const double w0 = damped_end(num_stages);
  const Chebyshev T = chebyshev_polynomials(num_stages, w0).back();
  return (1.0 + w0) * T.second / T.first;  // where w0 + w1 z = −1
}

int ChebyshevScheme::num_stages_for(double interval) {
  int s = 3;
  while (stability_interval(s) < interval) ++s;
  return s;
}

}  // namespace meniscus
