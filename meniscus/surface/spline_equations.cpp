#include "meniscus/surface/spline_equations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "meniscus/core/error.hpp"
#include "meniscus/core/vector_clones.hpp"

namespace meniscus {
namespace {

using Row = SplineEquations::Row;
constexpr std::size_t kMost = SplineEquations::kMost;
constexpr std::size_t kFirst = SplineEquations::kLeast;  // position of the first independent place

/// As many as AVX2 has room for.
constexpr std::size_t kLanes = 4;
using Lanes [[gnu::vector_size(8 * kLanes), gnu::may_alias]] = double;
constexpr std::size_t kBlocks = kMost / kLanes;
static_assert(kMost % kLanes == 0 && alignof(Row) >= alignof(Lanes));
constexpr std::size_t block_of(std::size_t position) { return position / kLanes; }
constexpr std::size_t kFirstBlock = block_of(kFirst);

MENISCUS_INLINE Lanes* blocks(Row& row) { return reinterpret_cast<Lanes*>(row.at); }
MENISCUS_INLINE const Lanes* blocks(const Row& row) {
  return reinterpret_cast<const Lanes*>(row.at);
}

/// row −= factor × other, from a block on.
MENISCUS_INLINE void subtract(Row& row, double factor, const Row& other, std::size_t from) {
  for (std::size_t b = from; b < kBlocks; ++b) blocks(row)[b] -= factor * blocks(other)[b];
}

/// row −= Σ factor_k × rows_k over the dependent places k, from a block on.
template <std::size_t From, class Factor>
MENISCUS_INLINE void subtract_all(Row& row, const Factor& factor, const Row* rows) {
  Lanes sum[kBlocks - From];
  for (std::size_t b = From; b < kBlocks; ++b) sum[b - From] = blocks(row)[b];
  for (std::size_t k = 0; k < kFirst; ++k)
    for (std::size_t b = From; b < kBlocks; ++b) sum[b - From] -= factor(k) * blocks(rows[k])[b];
  for (std::size_t b = From; b < kBlocks; ++b) blocks(row)[b] = sum[b - From];
}

/// Σ a_i b_i over the blocks of two positions and those between. What does not count is zero in
/// one of the rows.
MENISCUS_INLINE double product(const Row& a, const Row& b, std::size_t from, std::size_t to) {
  Lanes sum{};
  for (std::size_t block = block_of(from); block <= block_of(to); ++block)
    sum += blocks(a)[block] * blocks(b)[block];
  return (sum[0] + sum[2]) + (sum[1] + sum[3]);
}

/// φ(r) = r⁷ − q(r²) at the distances of x from all places, from a block on. Here q(s) is the
/// polynomial of degree four through s^(7/2) at Chebyshev's nodes of 0 < s < 4, r_k². While r⁷
/// comes to 128 in the unit disc, φ is below 0.035, and its factors lose no digits to cancellation.
///
/// The weights do not depend on q. A monomial of places x, y in q(|x − y|²) has degree four or less
/// in one of them. Of Zᵀ q Z it is annihilated from that side. The right side is Zᵀ(φ(x) − Φ w), w
/// the dependent weights. There degrees above four in the place come with three or less in x, where
/// w is exact.
MENISCUS_INLINE void set_kernel(double x_u, double x_v, const Row& u, const Row& v,
                                std::size_t from, Row& kernel) {
  constexpr double k1 = 1.9753766811902754, k2 = 1.7820130483767357, k3 = 1.4142135623730950,
                   k4 = 0.9079809994790936, k5 = 0.3128689300804617;
  // The cubic leaves r⁷ as the only odd power of the product.
  constexpr double kSquare = 1.4105790833879164, kLinear = 0.7282590489531896,
                   kConstant = 0.1199358051666513, kScale = -0.2007276724134635;
  Row r;
  for (std::size_t b = from; b < kBlocks; ++b) {
    const Lanes du = x_u - blocks(u)[b], dv = x_v - blocks(v)[b];
    blocks(r)[b] = du * du + dv * dv;
  }
  for (std::size_t j = from * kLanes; j < kMost; ++j) r.at[j] = std::sqrt(r.at[j]);
  for (std::size_t b = from; b < kBlocks; ++b) {
    const Lanes x = blocks(r)[b];
    const Lanes cubic = ((x + kSquare) * x + kLinear) * x + kConstant;
    blocks(kernel)[b] =
        ((x - k1) * (x - k2)) * ((x - k3) * (x - k4)) * ((x - k5) * (kScale * cubic));
  }
}

std::array<double, kFirst> terms_at(double u, double v) {
  std::array<double, kFirst> terms{1.0};
  const auto others = monomials<4>(u, v);
  std::ranges::copy(others, terms.begin() + 1);
  return terms;
}

/// The position of the largest entry from one position to before another.
MENISCUS_INLINE std::size_t largest(const Row& row, std::size_t from, std::size_t to) {
  double size = -1.0;
  std::size_t best = from;
  for (std::size_t i = from; i < to; ++i) {
    const double here = std::abs(row.at[i]);
    const bool is_larger = here > size;
    size = is_larger ? here : size;
    best = is_larger ? i : best;
  }
  return best;
}

/// P = L U. Row k of `terms` has monomial k at the places. It takes U_jk, j ≤ k, up to the diagonal
/// and L_ik, i > k, beyond. Each column's largest entry comes to the diagonal.
MENISCUS_VECTOR_CLONES void eliminate(Row* terms, std::size_t count, std::size_t* order) {
  for (std::size_t k = 0; k < kFirst; ++k) {
    const std::size_t best = largest(terms[k], k, count);
    std::swap(order[k], order[best]);
    for (std::size_t j = 0; j < kFirst; ++j) std::swap(terms[j].at[k], terms[j].at[best]);
    Row multiples = terms[k];
    for (std::size_t b = 0; b < kBlocks; ++b) blocks(multiples)[b] *= 1.0 / terms[k].at[k];
    for (std::size_t i = 0; i <= k; ++i) multiples.at[i] = 0.0;
    for (std::size_t j = k + 1; j < kFirst; ++j)
      subtract(terms[j], terms[j].at[k], multiples, block_of(k));
    for (std::size_t i = 0; i <= k; ++i) multiples.at[i] = terms[k].at[i];
    terms[k] = multiples;
  }
}

/// L1⁻ᵀ L2ᵀ: by how much less each dependent weight is for each of the others.
MENISCUS_VECTOR_CLONES void set_dependence(const Row* eliminated, Row* dependence) {
  for (std::size_t k = kFirst; k-- > 0;) {
    dependence[k] = eliminated[k];
    for (std::size_t i = 0; i < kFirst; ++i) dependence[k].at[i] = 0.0;
    for (std::size_t j = k + 1; j < kFirst; ++j)
      subtract(dependence[k], eliminated[k].at[j], dependence[j], kFirstBlock);
  }
}

/// Zᵀ Φ of the dependent places; beside it, from the diagonal on, D Lᵀ of the factors of Zᵀ Φ Z of
/// the independent ones. What is left of the diagonal there does not count.
MENISCUS_VECTOR_CLONES void reduce(const Row& u, const Row& v, const Row* dependence,
                                   std::size_t count, Row* rows) {
  for (std::size_t k = 0; k < kFirst; ++k) set_kernel(u.at[k], v.at[k], u, v, 0, rows[k]);
  for (std::size_t i = kFirst; i < count; ++i) {
    set_kernel(u.at[i], v.at[i], u, v, block_of(i), rows[i]);
    for (std::size_t k = 0; k < kFirst; ++k) rows[i].at[k] = rows[k].at[i];
    subtract_all<0>(
        rows[i], [&](std::size_t k) { return dependence[k].at[i]; }, rows);
    subtract_all<kFirstBlock>(
        rows[i], [&](std::size_t k) { return rows[i].at[k]; }, dependence);
  }
  for (std::size_t k = kFirst; k < count; ++k) {
    if (!(rows[k].at[k] > 0.0)) rows[k].at[k] = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = k + 1; i < count; ++i)
      subtract(rows[i], rows[k].at[i] / rows[k].at[k], rows[k], block_of(i));
  }
}

/// What `SplineEquations` holds.
struct Factors {
  const Row &u, &v;
  const Row *eliminated, *dependence, *reduced;
  std::size_t count;
};

/// Weights by position. `terms`: p(x).
MENISCUS_VECTOR_CLONES void solve(const Factors& of, double x_u, double x_v, const double* terms,
                                  Row& weights) {
  Row right, q{}, fixed{}, y{};
  weights = {};
  set_kernel(x_u, x_v, of.u, of.v, 0, right);
  // The dependent weights where all others are zero: Uᵀ q = p, L1ᵀ w = q.
  for (std::size_t k = 0; k < kFirst; ++k)
    q.at[k] = (terms[k] - product(of.eliminated[k], q, 0, k)) / of.eliminated[k].at[k];
  for (std::size_t k = kFirst; k-- > 0;)
    fixed.at[k] = q.at[k] - product(of.eliminated[k], fixed, k, kFirst - 1);
  subtract_all<kFirstBlock>(
      right, [&](std::size_t k) { return right.at[k]; }, of.dependence);
  for (std::size_t i = kFirst; i < of.count; ++i)
    right.at[i] -= product(of.reduced[i], fixed, 0, kFirst - 1);
  for (std::size_t k = kFirst; k < of.count; ++k) {
    y.at[k] = right.at[k];
    subtract(right, y.at[k] / of.reduced[k].at[k], of.reduced[k], block_of(k));
  }
  for (std::size_t i = of.count; i-- > kFirst;)
    weights.at[i] = (y.at[i] - product(of.reduced[i], weights, i, kMost - 1)) / of.reduced[i].at[i];
  for (std::size_t k = 0; k < kFirst; ++k)
    weights.at[k] = fixed.at[k] - product(of.dependence[k], weights, kFirst, kMost - 1);
}

}  // namespace

void SplineEquations::set(std::span<const Place> places) {
  MENISCUS_ASSERT(kLeast <= places.size() && places.size() <= kMost, "{} places", places.size());
  count_ = places.size();
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  double largest = 0.0;
  for (const Place& place : places) largest = std::max(largest, place.norm());
  scale_ = largest > 0.0 ? 1.0 / largest : 1.0;
  eliminated_ = {};
  for (std::size_t i = 0; i < count_; ++i) {
    const std::array<double, kFirst> terms =
        terms_at(scale_ * places[i].x(), scale_ * places[i].y());
    for (std::size_t k = 0; k < kFirst; ++k) eliminated_[k].at[i] = terms[k];
  }
  eliminate(eliminated_.data(), count_, order_.data());
  u_ = v_ = {};
  for (std::size_t i = 0; i < count_; ++i) {
    u_.at[i] = scale_ * places[order_[i]].x();
    v_.at[i] = scale_ * places[order_[i]].y();
  }
  set_dependence(eliminated_.data(), dependence_.data());
  reduced_ = {};
  reduce(u_, v_, dependence_.data(), count_, reduced_.data());
}

void SplineEquations::weights(const Place& x, std::span<double> weights) const {
  MENISCUS_ASSERT(weights.size() == count_, "{} weights of {} places", weights.size(), count_);
  const double u = scale_ * x.x(), v = scale_ * x.y();
  Row found;
  solve({u_, v_, eliminated_.data(), dependence_.data(), reduced_.data(), count_}, u, v,
        terms_at(u, v).data(), found);
  for (std::size_t i = 0; i < count_; ++i) weights[order_[i]] = found.at[i];
}

}  // namespace meniscus
