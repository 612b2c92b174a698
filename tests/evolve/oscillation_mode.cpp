#include "tests/evolve/oscillation_mode.hpp"

#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

namespace meniscus::test {
namespace {

using Complex = std::complex<double>;

/// A function of r with its first two derivatives.
using Jet = std::array<Complex, 3>;

Jet power(int n, double r) {
  return {std::pow(r, n), n * std::pow(r, n - 1), n * (n - 1) * std::pow(r, n - 2)};
}

enum class Bessel { j, y, h };

/// The functions of order 0 and 1.
std::array<Complex, 2> first_two(Bessel kind, Complex z) {
  const Complex s = std::sin(z), c = std::cos(z), i(0.0, 1.0), e = std::exp(i * z);
  switch (kind) {
    case Bessel::j:
      return {s / z, s / (z * z) - c / z};
    case Bessel::y:
      return {-c / z, -c / (z * z) - s / z};
    case Bessel::h:
      break;
  }
  return {-i * e / z, -(z + i) * e / (z * z)};
}

/// Of order l and l − 1. Small arguments of j by its series, as the recurrence would lose digits.
std::array<Complex, 2> bessel(Bessel kind, int l, Complex z) {
  const auto series = [&](int n) {
    Complex term = 1.0;
    for (int k = 1; k <= n; ++k) term *= z / (2.0 * k + 1.0);
    Complex sum = term;
    for (int k = 1; k < 40; ++k) sum += term *= -0.5 * z * z / (k * (2.0 * n + 2.0 * k + 1.0));
    return sum;
  };
  if (kind == Bessel::j && std::abs(z) < 3.0) return {series(l), series(l - 1)};
  auto [before, now] = first_two(kind, z);
  for (int k = 1; k < l; ++k) {
    const Complex next = (2.0 * k + 1.0) / z * now - before;
    before = now;
    now = next;
  }
  return {now, before};
}

/// f_l(qr)/r.
Jet viscous(Bessel kind, int l, Complex q, double r) {
  const Complex z = q * r;
  const auto [f, below] = bessel(kind, l, z);
  const Complex slope = below - (l + 1.0) / z * f;
  const Complex bend = -2.0 / z * slope - (1.0 - l * (l + 1.0) / (z * z)) * f;
  return {f / r, q * slope / r - f / (r * r),
          q * q * bend / r - 2.0 * q * slope / (r * r) + 2.0 * f / (r * r * r)};
}

/// u, v of v_θ = v dP_l/dθ, and the stresses, of one function at r.
struct Terms {
  Complex u, v, shear, normal;
};
Terms terms_of(const Jet& u, Complex p, double mu, int l, double r) {
  const double ll = l * (l + 1.0);
  const Complex v = (2.0 * u[0] + r * u[1]) / ll, slope = (3.0 * u[1] + r * u[2]) / ll;
  return {u[0], v, mu * (slope - v / r + u[0] / r), -p + 2.0 * mu * u[1]};
}

/// Of all functions of one liquid at r.
std::vector<Terms> functions(const Oscillation& of, Complex s, double r, bool is_inside) {
  const int l = of.l;
  const double mu = is_inside ? of.lambda : 1.0, rho = of.La * (is_inside ? of.density_ratio : 1.0);
  const Complex q = std::sqrt(s * rho / mu);
  std::vector<Terms> all;
  if (is_inside || std::isfinite(of.b))
    all.push_back(terms_of(power(l - 1, r), s * rho * std::pow(r, l) / double(l), mu, l, r));
  if (!is_inside)
    all.push_back(terms_of(power(-l - 2, r), -s * rho * std::pow(r, -l - 1) / (l + 1.0), mu, l, r));
  all.push_back(terms_of(viscous(is_inside ? Bessel::j : Bessel::h, l, q, r), 0.0, mu, l, r));
  if (!is_inside && std::isfinite(of.b))
    all.push_back(terms_of(viscous(Bessel::j, l, q, r), 0.0, mu, l, r));
  return all;
}

/// g of a velocity at r = 1.
Complex concentration_of(const Oscillation& of, Complex s, const Terms& at) {
  const double ll = of.l * (of.l + 1.0);
  return of.E0 == 0.0 ? 0.0 : (2.0 * at.u - ll * at.v) / (s - of.D_s * ll);
}

/// What must vanish at r = 1, and at the wall, by columns of the functions: inside, then outside.
Eigen::MatrixXcd conditions(const Oscillation& of, Complex s) {
  const auto inside = functions(of, s, 1.0, true), outside = functions(of, s, 1.0, false);
  const auto size = static_cast<Eigen::Index>(inside.size() + outside.size());
  Eigen::MatrixXcd rows = Eigen::MatrixXcd::Zero(size, size);
  Eigen::Index column = 0;
  for (const Terms& each : inside) {
    // f = −u/s.
    const Complex restoring = -(of.l - 1.0) * (of.l + 2.0) * each.u / s,
                  lost = of.E0 * concentration_of(of, s, each);
    rows.col(column++).head(4) << each.u, each.v, each.shear + lost,
        each.normal + restoring - 2.0 * lost;
  }
  for (const Terms& each : outside)
    rows.col(column++).head(4) << -each.u, -each.v, -each.shear, -each.normal;
  if (!std::isfinite(of.b)) return rows;
  column = static_cast<Eigen::Index>(inside.size());
  for (const Terms& each : functions(of, s, of.b, false))
    rows.col(column++).tail(2) << each.u, each.v;
  return rows;
}

}  // namespace

OscillationMode::OscillationMode(const Oscillation& of, Complex guess) : of_(of), rate_(guess) {
  Complex before = guess * Complex(1.0, 1e-3);
  Complex at_before = conditions(of, before).determinant();
  for (int k = 0; k < 60; ++k) {
    const Complex here = conditions(of, rate_).determinant();
    const Complex step = here * (rate_ - before) / (here - at_before);
    before = rate_;
    at_before = here;
    rate_ -= step;
    if (std::abs(step) < 1e-13 * std::abs(rate_)) break;
  }
  Eigen::MatrixXcd rows = conditions(of, rate_);
  Eigen::VectorXd scale(rows.cols());
  for (Eigen::Index k = 0; k < rows.cols(); ++k) {
    scale[k] = rows.col(k).norm();
    rows.col(k) /= scale[k];
  }
  const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(rows, Eigen::ComputeFullV);
  amplitudes_ = svd.matrixV().col(rows.cols() - 1).cwiseQuotient(scale.cast<Complex>());
  Complex u = 0.0;
  const auto inside = functions(of, rate_, 1.0, true);
  for (std::size_t k = 0; k < inside.size(); ++k)
    u += amplitudes_[static_cast<Eigen::Index>(k)] * inside[k].u;
  amplitudes_ *= -rate_ / u;
  for (std::size_t k = 0; k < inside.size(); ++k)
    concentration_ +=
        amplitudes_[static_cast<Eigen::Index>(k)] * concentration_of(of, rate_, inside[k]);
}

Vec3 OscillationMode::velocity(const Vec3& x, double f0) const {
  const double r = std::max(x.norm(), 1e-6);
  const bool is_inside = r < 1.0;
  const auto all = functions(of_, rate_, r, is_inside);
  Eigen::Index k = is_inside ? 0 : 2;
  Complex u = 0.0, v = 0.0;
  for (const Terms& each : all) {
    u += amplitudes_[k] * each.u;
    v += amplitudes_[k++] * each.v;
  }
  // dP_l/dθ e_θ = P_l′(c) (e_x − c e_r), c = cos θ.
  const double c = x.x() / r;
  const double slope = (std::legendre(static_cast<unsigned>(of_.l - 1), c) -
                        c * std::legendre(static_cast<unsigned>(of_.l), c)) *
                       of_.l / std::max(1.0 - c * c, 1e-300);
  const Vec3 along = x / r;
  return f0 * (u.real() * std::legendre(static_cast<unsigned>(of_.l), c) * along +
               v.real() * slope * (Vec3::UnitX() - c * along));
}

}  // namespace meniscus::test
