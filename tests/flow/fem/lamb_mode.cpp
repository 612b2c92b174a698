#include "tests/flow/fem/lamb_mode.hpp"

#include <cmath>

#include <Eigen/Dense>

namespace meniscus::fem {
namespace {

/// One of Lamb's solutions v = U(r) Y r̂ + V(r) ∇_s Y of degree n, its derivatives and pressure.
struct Radial {
  double U, V, dU, dV, p;
};

/// From p = r^n Y in a liquid of viscosity μ.
Radial from_pressure(int n, double mu, double r) {
  const double denominator = mu * (2.0 * n + 3.0);
  const double u = 0.5 * n / denominator, v = 0.5 * (n + 3.0) / ((n + 1.0) * denominator);
  const double power = std::pow(r, n);
  return {u * power * r, v * power * r, u * (n + 1) * power, v * (n + 1) * power, power};
}

/// From the potential r^n Y.
Radial from_potential(int n, double r) {
  const double power = std::pow(r, n - 1);
  return {n * power, power, n * (n - 1) * power / r, (n - 1) * power / r, 0.0};
}

/// Amplitudes of σ_rr and of σ_rs at r.
double normal_traction(const Radial& f, double mu) { return -f.p + 2.0 * mu * f.dU; }
double tangential_traction(const Radial& f, double mu, double r) {
  return mu * (f.dV - f.V / r + f.U / r);
}

/// Lamb's solutions in the order of LambMode's amplitudes.
std::array<Radial, 6> solutions(int l, double lambda, double r) {
  const int m = -(l + 1);
  return {from_pressure(l, lambda, r), from_potential(l, r),     from_pressure(m, 1.0, r),
          from_potential(m, r),        from_pressure(l, 1.0, r), from_potential(l, r)};
}

}  // namespace

Legendre legendre(int l, double c) {
  double before = 1.0, now = c, before_derivative = 0.0, derivative = 1.0;
  if (l == 0) return {1.0, 0.0};
  for (int n = 2; n <= l; ++n) {
    const double next = ((2 * n - 1) * c * now - (n - 1) * before) / n;
    const double next_derivative = before_derivative + (2 * n - 1) * now;
    before = now;
    now = next;
    before_derivative = derivative;
    derivative = next_derivative;
  }
  return {now, derivative};
}

LambMode::LambMode(int l, double lambda, double b) : l_(l) {
  const bool is_unbounded = std::isinf(b);
  Eigen::Matrix<double, 6, 6> system = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> data = Eigen::Matrix<double, 6, 1>::Zero();
  const auto here = solutions(l, lambda, 1.0);
  for (Eigen::Index k = 0; k < 6; ++k) {
    const Radial& f = here[static_cast<std::size_t>(k)];
    const bool is_inside = k < 2;
    const double sign = is_inside ? -1.0 : 1.0, mu = is_inside ? lambda : 1.0;
    system(0, k) = sign * f.U;
    system(1, k) = sign * f.V;
    system(2, k) = sign * normal_traction(f, mu);
    system(3, k) = sign * tangential_traction(f, mu, 1.0);
    if (is_inside) continue;
    const Radial wall = is_unbounded ? Radial{} : solutions(l, lambda, b)[std::size_t(k)];
    system(4, k) = is_unbounded ? (k == 4 ? 1.0 : 0.0) : wall.U;
    system(5, k) = is_unbounded ? (k == 5 ? 1.0 : 0.0) : wall.V;
  }
  data[2] = 1.0;
  // Powers of b differ by many orders of magnitude: equilibrate the columns.
  const Eigen::Matrix<double, 6, 1> scale = system.colwise().norm().cwiseInverse();
  const Eigen::Matrix<double, 6, 6> scaled = system * scale.asDiagonal();
  const Eigen::Matrix<double, 6, 1> result = scale.asDiagonal() * scaled.fullPivLu().solve(data);
  for (std::size_t k = 0; k < 6; ++k) amplitude_[k] = result[static_cast<Eigen::Index>(k)];
}

Vec3 LambMode::velocity(const Vec3& x) const {
  const double r = x.norm(), c = x.x() / r;
  const Legendre P = legendre(l_, c);
  const Vec3 radial = x / r, tangential = P.derivative * (Vec3::UnitX() - c * radial);
  const auto f = solutions(l_, 1.0, r);  // used outside only, where μ = 1
  Vec3 v = Vec3::Zero();
  for (std::size_t k = 2; k < 6; ++k)
    v += amplitude_[k] * (f[k].U * P.value * radial + f[k].V * tangential);
  return v;
}

double LambMode::radial_amplitude() const {
  const auto f = solutions(l_, 1.0, 1.0);
  double sum = 0.0;
  for (std::size_t k = 2; k < 6; ++k) sum += amplitude_[k] * f[k].U;
  return sum;
}

double relaxation_rate(int l, double lambda, double b) {
  return -(l - 1) * (l + 2) * LambMode(l, lambda, b).radial_amplitude();
}

}  // namespace meniscus::fem
