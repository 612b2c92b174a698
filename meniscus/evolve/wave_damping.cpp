#include "meniscus/evolve/wave_damping.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>

#include "meniscus/core/error.hpp"
#include "meniscus/evolve/constants.hpp"
#include "meniscus/linear/shared_work.hpp"
#include "meniscus/mesh/sphere_radius.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/scene/interface_tension.hpp"

namespace meniscus {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// The lower half of K with Σ_w K_vw s_w = ∫∇φ_v·∇s dS on flat faces.
SparseMatrix stiffness(const SurfaceMesh& mesh) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(9 * static_cast<std::size_t>(mesh.faces.size()));
  for (const FaceVertices& v : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = v[(k + 1) % 3], b = v[(k + 2) % 3];
      const Vec3 to_a = mesh.x[a] - mesh.x[v[k]], to_b = mesh.x[b] - mesh.x[v[k]];
      const double half_cotangent = 0.5 * to_a.dot(to_b) / to_a.cross(to_b).norm();
      entries.emplace_back(std::max(a.value, b.value), std::min(a.value, b.value), -half_cotangent);
      entries.emplace_back(a.value, a.value, half_cotangent);
      entries.emplace_back(b.value, b.value, half_cotangent);
    }
  SparseMatrix K(mesh.num_vertices(), mesh.num_vertices());
  K.setFromTriplets(entries.begin(), entries.end());
  return K;
}

/// 1/(1 + b(αΛ^½)) with b(q) = q²/(q + q0), q0 = `kUndampedShare`, by the trapezoidal rule in ln s
/// for
///   (2/π)∫ y³s/(((q0 − y²)² + y²)(s² + Λ)) ds,   y = αs,   over s > 0.
/// Where s² is far above all Λ of a matrix, the terms are multiples of the identity.
struct InverseSum {
  struct Term {
    double shift, weight;  // of 1/(shift + Λ)
  };
  std::vector<Term> terms;
  double rest = 0.0;  // of the identity
};

InverseSum inverse_sum(double alpha, double least, double most) {
  constexpr double kSpacing = 0.5, kBelow = 0.05, kAbove = 4.0, kSmallest = 1e-9;
  InverseSum sum;
  const double factor = 2.0 / std::numbers::pi * kSpacing, growth = std::exp(kSpacing);
  for (double s = kBelow * std::sqrt(least);; s *= growth) {
    const double y = alpha * s, square = y * y, rest = kUndampedShare - square;
    const double weight = factor * square * y / (rest * rest + square);
    if (s < kAbove * std::sqrt(most)) {
      sum.terms.push_back({s * s, weight * s * s});
      continue;
    }
    sum.rest += weight;
    if (!(y <= 1.0) && !(weight >= kSmallest)) return sum;  // what is no number as well
  }
}

/// α of `damped`: the duration times A per wave number.
double rate_factor(const Interface& interface, std::span<const double> viscosity, double modulus,
                   const Damping& damping) {
  const double inside = viscosity[static_cast<std::size_t>(interface.inside.value)],
               outside = viscosity[static_cast<std::size_t>(interface.outside.value)],
               thinness = std::max(0.0, (outside - inside) / (outside + inside)),
               stiffness = 1.0 + thinness * (damping.stiffness_around_thin - 1.0);
  return stiffness * damping.duration * modulus / (2.0 * (inside + outside));
}

/// What 1/(1 + b(α(M⁻¹K + k)^½)) makes of s.
Eigen::VectorXd damped(const SparseMatrix& K, const Eigen::VectorXd& mass, double k, double alpha,
                       const Eigen::VectorXd& s, linear::Processes processes) {
  const double most = 2.0 * (K.diagonal().array() / mass.array()).maxCoeff() + k;
  constexpr double kUndamped = 1e-9;  // α√Λ below which b is roundoff
  if (alpha * std::sqrt(most) < kUndamped) return s;
  const InverseSum sum = inverse_sum(alpha, k, most);
  const Eigen::VectorXd moment = mass.cwiseProduct(s);
  Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower> factors;
  factors.analyzePattern(K);
  const auto size = static_cast<std::size_t>(s.size());
  const std::vector<double> parts =
      linear::shared_numbers(linear::Communicator::of(processes), sum.terms.size(), size,
                             [&](std::size_t first, std::size_t end) {
                               std::vector<double> values(size * (end - first));
                               for (std::size_t term = first; term < end; ++term) {
                                 SparseMatrix shifted = K;
                                 shifted.diagonal() += (sum.terms[term].shift + k) * mass;
                                 factors.factorize(shifted);
                                 Eigen::Map<Eigen::VectorXd>(&values[size * (term - first)],
                                                             s.size()) = factors.solve(moment);
                               }
                               return values;
                             });
  Eigen::VectorXd result = sum.rest * s;
  for (std::size_t term = 0; term < sum.terms.size(); ++term)
    result +=
        sum.terms[term].weight * Eigen::Map<const Eigen::VectorXd>(&parts[size * term], s.size());
  return result;
}

/// q = cΛ^(3/2)/(a + bΛ).
struct WaveOfStage {
  double a = 0.0, b = 0.0, c = 0.0;
};

/// The roots of x³ + p x² + q x + r.
std::array<std::complex<double>, 3> cubic_roots(double p, double q, double r) {
  Mat3 companion = Mat3::Zero();
  companion(0, 2) = -r;
  companion(1, 0) = companion(2, 1) = 1.0;
  companion(1, 2) = -q;
  companion(2, 2) = -p;
  const Eigen::EigenSolver<Mat3> solver(companion, false);
  const auto& roots = solver.eigenvalues();
  return {roots[0], roots[1], roots[2]};
}

/// What 1/(1 + q²) makes of s, Λ = M⁻¹K + k. With P(Λ) = (a + bΛ)² + c²Λ³ it is Σ_z (a +
/// bz)²/P′(z)/(Λ − z) over the roots z of P.
Eigen::VectorXd slowed(const SparseMatrix& K, const Eigen::VectorXd& mass, double k,
                       const WaveOfStage& wave, const Eigen::VectorXd& s) {
  using Complex = std::complex<double>;
  using ComplexMatrix = Eigen::SparseMatrix<Complex>;
  const auto& [a, b, c] = wave;
  const double cc = c * c;
  const SparseMatrix whole = K.selfadjointView<Eigen::Lower>();
  const Eigen::VectorXd moment = mass.cwiseProduct(s);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(s.size());
  Eigen::SparseLU<ComplexMatrix> factors;
  bool is_analyzed = false;
  for (const Complex z : cubic_roots(b * b / cc, 2.0 * a * b / cc, a * a / cc)) {
    if (z.imag() < 0.0) continue;  // its conjugate has the conjugate solution
    const Complex slope = 2.0 * b * (a + b * z) + 3.0 * cc * z * z;
    const Complex weight = (a + b * z) * (a + b * z) / slope;
    ComplexMatrix shifted = whole.cast<Complex>();
    shifted.diagonal() += (Complex(k) - z) * mass.cast<Complex>();
    if (!std::exchange(is_analyzed, true)) factors.analyzePattern(shifted);
    factors.factorize(shifted);
    const Eigen::VectorXcd part = factors.solve(moment.cast<Complex>().eval());
    result += (z.imag() > 0.0 ? 2.0 : 1.0) * (weight * part).real();
  }
  return result;
}

/// What A would change in the duration on one interface, of tension or elasticity `modulus`, about
/// zero; `mesh` is where its vertices are.
Eigen::VectorXd damped_on(const Scene& scene, std::size_t i, const SurfaceMesh& mesh,
                          std::span<const double> viscosity, double modulus,
                          const Eigen::VectorXd& mass, const Eigen::VectorXd& s,
                          const Damping& damping) {
  const Interface& interface = scene.interfaces[i];
  const double radius = sphere_radius(interface.volume);
  return damped(stiffness(mesh), mass, kSphereStiffness / (radius * radius),
                rate_factor(interface, viscosity, modulus, damping), s, damping.processes);
}

}  // namespace

double share_of_spin(const Interface& interface, std::span<const double> viscosity,
                     const Damping& damping) {
  constexpr double kEllipsoidMode = 6.0;  // l(l + 1) of the waves of degree l = 2
  const double q = rate_factor(interface, viscosity, largest_tension(interface), damping) *
                   std::sqrt(kEllipsoidMode + kSphereStiffness) / sphere_radius(interface.volume),
               damped = 1.0 / (1.0 + q * q / (q + kUndampedShare));
  return damped * damped;
}

NormalSpeeds damped_speeds(const Scene& scene, std::span<const double> viscosity,
                           const NormalSpeeds& speeds, const NormalSpeeds& about,
                           const Damping& damping) {
  MENISCUS_ASSERT(speeds.size() == scene.interfaces.size() && about.size() == speeds.size(),
                  "{} and {} speeds of {} interfaces", speeds.size(), about.size(),
                  scene.interfaces.size());
  NormalSpeeds result = speeds;
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    const Interface& interface = scene.interfaces[i];
    if (interface.tension == 0.0) continue;
    const VertexField<Vec3> area = vertex_area_vectors(interface.mesh);
    Eigen::VectorXd mass(area.size()), s(area.size());
    for (const VertexId v : area.ids()) {
      mass[v.value] = area[v].norm();
      s[v.value] = speeds[i][v] - about[i][v];
    }
    s = damped_on(scene, i, interface.mesh, viscosity, largest_tension(interface), mass, s,
                  damping);
    for (const VertexId v : area.ids()) result[i][v] = about[i][v] + s[v.value];
  }
  return result;
}

NormalSpeeds expected_speeds(const Scene& scene, const NormalSpeeds& speeds,
                             const NormalSpeeds& about, double duration) {
  NormalSpeeds result = speeds;
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    const Interface& interface = scene.interfaces[i];
    if (interface.tension == 0.0) continue;
    const Liquid &inside = scene.liquids[interface.inside],
                 &outside = scene.liquids[interface.outside];
    const VertexField<Vec3> area = vertex_area_vectors(interface.mesh);
    Eigen::VectorXd mass(area.size()), s(area.size());
    for (const VertexId v : area.ids()) {
      mass[v.value] = area[v].norm();
      s[v.value] = speeds[i][v] - about[i][v];
    }
    const double radius = sphere_radius(interface.volume);
    s = slowed(stiffness(interface.mesh), mass, kSphereStiffness / (radius * radius),
               WaveOfStage{inside.density + outside.density,
                           2.0 * duration * (inside.viscosity + outside.viscosity),
                           largest_tension(interface) * duration * duration},
               s);
    for (const VertexId v : area.ids()) result[i][v] = about[i][v] + s[v.value];
  }
  return result;
}

ConcentrationRates damped_concentration_rates(const Scene& scene, std::span<const double> viscosity,
                                              const ConcentrationRates& rates,
                                              const ConcentrationRates& about,
                                              const SceneCarriers& carriers,
                                              const Damping& damping) {
  MENISCUS_ASSERT(rates.size() == carriers.size() && about.size() == rates.size(),
                  "{} and {} rates of {} interfaces", rates.size(), about.size(), carriers.size());
  ConcentrationRates result = rates;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    const double elasticity = largest_elasticity(scene.interfaces[i]);
    if (elasticity == 0.0) continue;
    const VertexField<double> area = carriers[i]->mass.areas();
    Eigen::VectorXd mass(area.size()), s(area.size());
    for (const VertexId v : area.ids()) {
      mass[v.value] = area[v];
      s[v.value] = rates[i][v] - about[i][v];
    }
    const double mean = mass.dot(s) / mass.sum();
    s.array() -= mean;
    s = damped_on(scene, i, carriers[i]->mesh, viscosity, elasticity, mass, s, damping);
    for (const VertexId v : area.ids()) result[i][v] = about[i][v] + mean + s[v.value];
  }
  return result;
}

}  // namespace meniscus
