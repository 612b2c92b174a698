#include "meniscus/flow/fem/stokes_product.hpp"

#include <algorithm>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/cell_batches.hpp"
#include "meniscus/flow/fem/cell_inertia.hpp"
#include "meniscus/flow/fem/inertia_product.hpp"
#include "meniscus/flow/fem/partition.hpp"

namespace meniscus::fem {

using namespace lanes;

namespace {

/// s(2μ D − p I).
MENISCUS_INLINE Tensor stress_of(const Tensor& gradient, const Lanes& viscosity, const Lanes& p,
                                 const Lanes& s) {
  Tensor result;
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = a; b < 3; ++b)
      result[a][b] = result[b][a] = s * viscosity * (gradient[a][b] + gradient[b][a]);
    result[a][a] -= s * p;
  }
  return result;
}

/// The derivatives d of the velocity become those that the test functions are paid with; p becomes
/// what the continuity gets.
MENISCUS_INLINE void multiply(const StraightCells& cells, Derivatives& d, Corners& p) {
  std::array<Tensor, 4> S;
  Tensor sum = {};
  Lanes divergence = {};
  for (std::size_t k = 0; k < 4; ++k) {
    const Tensor gradient = gradient_of(d[k], cells.gradient);
    S[k] = stress_of(gradient, cells.viscosity, p[k], cells.volume);
    add_to(sum, S[k]);
    p[k] = trace(gradient);
    divergence += p[k];
  }
  for (std::size_t k = 0; k < 4; ++k) {
    add_to(S[k], sum);
    d[k] = on_gradients(S[k], cells.gradient);
    p[k] = -cells.volume * (divergence + p[k]);
  }
}

/// The transpose of `at_point`.
MENISCUS_INLINE void add_back(const std::array<double, 4>& b, const Tensor& t, Derivatives& d) {
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t l = 0; l < 3; ++l)
      for (std::size_t a = 0; a < 3; ++a) d[k][l][a] += b[k] * t[l][a];
}

MENISCUS_INLINE void multiply(const CurvedCells& cells, Derivatives& d, Corners& p) {
  Derivatives paid = {};
  Corners continuity = {};
  for (std::size_t q = 0; q < cells.points.size(); ++q) {
    const auto& [g, weight] = cells.points[q];
    const std::array<double, 4>& b = kTetrahedronRule5[q].barycentric;
    const Tensor gradient = gradient_of(at_point(b, d), g);
    const Tensor flux = stress_of(gradient, cells.viscosity, at_point(b, p), weight);
    add_back(b, on_gradients(flux, g), paid);
    for (std::size_t k = 0; k < 4; ++k) continuity[k] -= b[k] * weight * trace(gradient);
  }
  d = paid;
  p = continuity;
}

/// The pressure's part of the momentum, −∫p∇φ. It is −V/20 (4p_k − Σp)∇b_k at a corner k, and
/// −V/5 [(Σp + p_i)∇b_j + (Σp + p_j)∇b_i] at the edge of i and j.
MENISCUS_INLINE void multiply_pressure(const StraightCells& cells, const Corners& p, Nodal& r) {
  const Lanes sum = p[0] + p[1] + p[2] + p[3];
  for (std::size_t a = 0; a < 3; ++a) {
    Corners slope;
    for (std::size_t l = 0; l < 3; ++l) slope[l + 1] = -cells.volume * cells.gradient[l][a];
    slope[0] = -(slope[1] + slope[2] + slope[3]);
    for (std::size_t k = 0; k < 4; ++k) r[k][a] = (4.0 * p[k] - sum) * slope[k];
    for (std::size_t e = 0; e < 6; ++e) {
      const auto [i, j] = kCellEdges[e];
      r[4 + e][a] = 4.0 * ((sum + p[i]) * slope[j] + (sum + p[j]) * slope[i]);
    }
  }
}

struct Fields {
  const double *v, *p;
  double *momentum, *continuity;
  bool are_zero_in_most = false;  // v and p
};

MENISCUS_INLINE bool are_zero(const Nodal& v, const Corners& p) {
  Lanes squares = {};
  for (const Lanes3& at_node : v)
    for (std::size_t a = 0; a < 3; ++a) squares += at_node[a] * at_node[a];
  for (const Lanes& at_corner : p) squares += at_corner * at_corner;
  double sum = 0.0;
  for (std::size_t lane = 0; lane < kLanes; ++lane) sum += squares[lane];
  return sum == 0.0;
}

template <class Batch, class Inertia>
MENISCUS_INLINE void add_fluxes(std::span<const Batch> batches, const Inertia& inertia,
                                const Fields& fields) {
  for (std::size_t n = 0; n < batches.size(); ++n) {
    const Batch& cells = batches[n];
    Nodal v, result;
    Corners p = {};
    Derivatives d;
    take(cells.nodes, fields.v, v);
    take(cells.pressures, fields.p, p);
    if (fields.are_zero_in_most && are_zero(v, p)) continue;
    differentiate(v, d);
    multiply(cells, d, p);
    differentiate_back(d, result);
    inertia.add(cells, n, v, result);
    give(cells.nodes, result, fields.momentum);
    give(cells.pressures, p, fields.continuity);
  }
}

struct Batches {
  std::span<const StraightCells> straight;
  std::span<const CurvedCells> curved;
};

// One function for each, as clones are made of functions alone.
MENISCUS_VECTOR_CLONES
void add_stresses(const Batches& cells, const Fields& fields) {
  add_fluxes(cells.straight, NoInertia{}, fields);
  add_fluxes(cells.curved, NoInertia{}, fields);
}
MENISCUS_VECTOR_CLONES
void add_stresses(const Batches& cells, const CellInertia& inertia, const Fields& fields) {
  add_fluxes(cells.straight, inertia.straight, fields);
  add_fluxes(cells.curved, inertia.curved, fields);
}
MENISCUS_VECTOR_CLONES
void add_stresses(const Batches& cells, const ConvectedCells& inertia, const Fields& fields) {
  add_fluxes(cells.straight, inertia.straight, fields);
  add_fluxes(cells.curved, inertia.curved, fields);
}
MENISCUS_VECTOR_CLONES
void add_pressures(std::span<const StraightCells> batches, const double* from, double* momentum) {
  for (const StraightCells& cells : batches) {
    Nodal result;
    Corners p;
    take(cells.pressures, from, p);
    multiply_pressure(cells, p, result);
    give(cells.nodes, result, momentum);
  }
}

/// The batches whose cells a rank takes: those it owns, or all.
Batches taken(const CellBatches& cells, bool owned) {
  const Batches all = {cells.straight, cells.curved};
  return owned ? Batches{all.straight.first(cells.num_owned_straight),
                         all.curved.first(cells.num_owned_curved)}
               : all;
}

}  // namespace

StokesProduct::StokesProduct(const StokesProblem& problem) {
  MENISCUS_ASSERT(has_product(problem), "linear elements, or a viscosity that depends on the rate");
  cells_ = std::make_unique<CellBatches>(cell_batches(problem));
  if (problem.inertia)
    inertia_ = std::make_unique<InertiaProduct>(problem, *cells_);
  else
    partition_ = problem.partition;
}
StokesProduct::StokesProduct(StokesProduct&&) noexcept = default;
StokesProduct& StokesProduct::operator=(StokesProduct&&) noexcept = default;
StokesProduct::~StokesProduct() = default;

void StokesProduct::convect(std::span<const double> v) {
  if (inertia_) inertia_->convect(v);
}

/// Calls `add` with the batches to take, then exchanges what it has added to rows of other ranks.
template <class Add>
void StokesProduct::add_by_ranks(std::span<double> momentum, std::span<double> continuity,
                                 const Add& add) const {
  const Batches cells = taken(*cells_, partition_ != nullptr);
  if (partition_ == nullptr) return add(cells);
  // What stands in rows of others would be sent to them.
  const auto clear = [](std::span<double> local, std::int32_t num_owned) {
    if (!local.empty()) std::ranges::fill(local.subspan(static_cast<std::size_t>(num_owned)), 0.0);
  };
  clear(momentum, 3 * partition_->owned.num_nodes);
  clear(continuity, partition_->owned.num_pressures);
  add(cells);
  add_of_ghosts(*partition_, momentum, continuity);
}

void StokesProduct::add(std::span<const double> v, std::span<const double> p,
                        std::span<double> momentum, std::span<double> continuity) const {
  if (!inertia_) return add_stress(v, p, momentum, continuity);
  const Batches cells = taken(*cells_, false);
  const Fields fields = {v.data(), p.data(), momentum.data(), continuity.data()};
  if (inertia_->convects())
    add_stresses(cells, inertia_->by_convected_cells(), fields);
  else
    add_stresses(cells, inertia_->by_cells(), fields);
  inertia_->add_tension(v, momentum);
}

void StokesProduct::add_stress(std::span<const double> v, std::span<const double> p,
                               std::span<double> momentum, std::span<double> continuity) const {
  add_by_ranks(momentum, continuity, [&](const Batches& cells) {
    add_stresses(cells, {v.data(), p.data(), momentum.data(), continuity.data()});
  });
}

void StokesProduct::add_stress_of_few(std::span<const double> v, std::span<const double> p,
                                      std::span<double> momentum,
                                      std::span<double> continuity) const {
  add_by_ranks(momentum, continuity, [&](const Batches& cells) {
    add_stresses(cells, {v.data(), p.data(), momentum.data(), continuity.data(), true});
  });
}

void StokesProduct::add_straight_gradient(std::span<const double> p,
                                          std::span<double> momentum) const {
  add_by_ranks(momentum, {}, [&](const Batches& cells) {
    add_pressures(cells.straight, p.data(), momentum.data());
    add_pressures(std::span(cells_->straightened).first(cells.curved.size()), p.data(),
                  momentum.data());
  });
}

}  // namespace meniscus::fem
