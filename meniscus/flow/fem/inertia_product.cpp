#include "meniscus/flow/fem/inertia_product.hpp"

#include <algorithm>

#include "meniscus/core/error.hpp"
#include "meniscus/core/vector_clones.hpp"
#include "meniscus/flow/fem/cell_batches.hpp"
#include "meniscus/flow/fem/cell_inertia.hpp"
#include "meniscus/flow/fem/elements.hpp"

// GCC 12 takes elements of vectors that are set one by one for uninitialised.
#ifndef __clang__
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

namespace meniscus::fem {

using namespace lanes;

namespace {

constexpr std::size_t kPoints = kTetrahedronRule5.size();

/// φ_i, and ∂φ_i/∂b_l of the four barycentric coordinates, at the points of the rule.
struct ShapeTable {
  std::array<std::array<double, 10>, kPoints> value{};
  std::array<std::array<std::array<double, 4>, 10>, kPoints> by{};
};
constexpr ShapeTable kShapes = [] {
  ShapeTable table;
  for (std::size_t q = 0; q < kPoints; ++q) {
    const auto& b = kTetrahedronRule5[q].barycentric;
    for (std::size_t k = 0; k < 4; ++k) {
      table.value[q][k] = b[k] * (2.0 * b[k] - 1.0);
      table.by[q][k][k] = 4.0 * b[k] - 1.0;
    }
    for (std::size_t e = 0; e < 6; ++e) {
      const auto [i, j] = kCellEdges[e];
      table.value[q][4 + e] = 4.0 * b[i] * b[j];
      table.by[q][4 + e][i] = 4.0 * b[j];
      table.by[q][4 + e][j] = 4.0 * b[i];
    }
  }
  return table;
}();

/// What a point of a cell is: the gradients of b_1, b_2, b_3, and its weight.
struct PointOf {
  const Tensor& gradient;
  Lanes weight;
};
MENISCUS_INLINE PointOf point_of(const StraightCells& cells, std::size_t q) {
  return {cells.gradient, 20.0 * kTetrahedronRule5[q].share * cells.volume};
}
MENISCUS_INLINE PointOf point_of(const CurvedCells& cells, std::size_t q) {
  return {cells.points[q].gradient, cells.points[q].weight};
}

MENISCUS_INLINE void set_mass(const StraightCells& cells, const Lanes& density_rate, Square& m) {
  const Lanes scale = 20.0 * cells.volume * density_rate;
  for (std::size_t i = 0; i < 10; ++i)
    for (std::size_t j = 0; j < 10; ++j) m.entry[i][j] = kQuadraticMass[i][j] * scale;
}
MENISCUS_INLINE void set_mass(const CurvedCells& cells, const Lanes& density_rate, Square& m) {
  m.entry = {};
  for (std::size_t q = 0; q < kPoints; ++q) {
    const Lanes weight = cells.points[q].weight * density_rate;
    for (std::size_t i = 0; i < 10; ++i)
      for (std::size_t j = 0; j < 10; ++j)
        m.entry[i][j] += (kShapes.value[q][i] * kShapes.value[q][j]) * weight;
  }
}

/// Adds ∫ρφ_i a·∇φ_j, a given at the nodes.
template <class Batch>
MENISCUS_INLINE void add_convection(const Batch& cells, const Lanes& density, const Nodal& a,
                                    Square& m) {
  for (std::size_t q = 0; q < kPoints; ++q) {
    const PointOf point = point_of(cells, q);
    Lanes3 here = {};
    for (std::size_t i = 0; i < 10; ++i)
      for (std::size_t k = 0; k < 3; ++k) here[k] += kShapes.value[q][i] * a[i][k];
    std::array<Lanes, 4> along;  // a·∇b_l
    along[0] = Lanes{};
    for (std::size_t l = 1; l < 4; ++l) {
      const Lanes3& g = point.gradient[l - 1];
      along[l] = here[0] * g[0] + here[1] * g[1] + here[2] * g[2];
      along[0] -= along[l];
    }
    const Lanes weight = point.weight * density;
    std::array<Lanes, 10> slope;  // weight a·∇φ_j
    for (std::size_t j = 0; j < 4; ++j) slope[j] = weight * kShapes.by[q][j][j] * along[j];
    for (std::size_t e = 0; e < 6; ++e) {
      const auto [i, j] = kCellEdges[e];
      slope[4 + e] =
          weight * (kShapes.by[q][4 + e][i] * along[i] + kShapes.by[q][4 + e][j] * along[j]);
    }
    for (std::size_t i = 0; i < 10; ++i)
      for (std::size_t j = 0; j < 10; ++j) m.entry[i][j] += kShapes.value[q][i] * slope[j];
  }
}

template <class Batch>
MENISCUS_INLINE void set_matrices(std::span<const Batch> batches, std::span<const Density> density,
                                  double rate, const double* a, std::span<Square> matrices) {
  for (std::size_t n = 0; n < batches.size(); ++n) {
    set_mass(batches[n], rate * density[n].of, matrices[n]);
    if (a == nullptr) continue;
    Nodal convecting;
    take(batches[n].nodes, a, convecting);
    add_convection(batches[n], density[n].of, convecting, matrices[n]);
  }
}

/// Adds what a part of inertia makes of a velocity.
template <class Batch, class Part>
MENISCUS_INLINE void add_products(std::span<const Batch> batches, const Part& part, const double* v,
                                  double* momentum) {
  for (std::size_t n = 0; n < batches.size(); ++n) {
    Nodal given, result = {};
    take(batches[n].nodes, v, given);
    part.add(batches[n], n, given, result);
    give(batches[n].nodes, result, momentum);
  }
}

struct Batches {
  std::span<const StraightCells> straight;
  std::span<const CurvedCells> curved;
  std::span<const Density> straight_density, curved_density;
};

MENISCUS_VECTOR_CLONES
void set_all(const Batches& cells, double rate, const double* a, std::span<Square> straight,
             std::span<Square> curved) {
  set_matrices(cells.straight, cells.straight_density, rate, a, straight);
  set_matrices(cells.curved, cells.curved_density, rate, a, curved);
}
MENISCUS_VECTOR_CLONES
void set_curved_masses(const Batches& cells, double rate, std::span<Square> curved) {
  set_matrices(cells.curved, cells.curved_density, rate, nullptr, curved);
}
MENISCUS_VECTOR_CLONES
void add_all(const Batches& cells, std::span<const Square> straight, std::span<const Square> curved,
             const double* v, double* momentum) {
  add_products(cells.straight, CellSquares{straight}, v, momentum);
  add_products(cells.curved, CellSquares{curved}, v, momentum);
}
MENISCUS_VECTOR_CLONES
void add_masses(const Batches& cells, double rate, std::span<const Square> curved, const double* v,
                double* momentum) {
  add_products(cells.straight, StraightMasses{cells.straight_density, rate}, v, momentum);
  add_products(cells.curved, CellSquares{curved}, v, momentum);
}

/// The densities of the cells by eights; the last lanes repeat one.
std::vector<Density> densities(const InertiaTerms& terms, std::span<const CellId> cells,
                               std::size_t num_batches) {
  std::vector<Density> result(num_batches);
  for (std::size_t n = 0; n < kLanes * num_batches; ++n)
    result[n / kLanes].of[n % kLanes] = terms.density[cells[std::min(n, cells.size() - 1)]];
  return result;
}

}  // namespace

struct InertiaProduct::Matrices {
  std::vector<Density> straight_density, curved_density;
  std::vector<Square> straight, curved;  // with convection, once there is any
  std::vector<Square> curved_mass;

  [[nodiscard]] Batches of(const CellBatches& cells) const {
    return {cells.straight, cells.curved, straight_density, curved_density};
  }
};

InertiaProduct::InertiaProduct(const StokesProblem& problem, const CellBatches& cells)
    : terms_(*problem.inertia),
      cells_(cells),
      matrices_(std::make_unique<Matrices>()),
      given_mass_(numbers(terms_.before).size()),
      given_tension_(given_mass_.size()) {
  MENISCUS_ASSERT(problem.space.elements == Elements::p2_p1, "inertia needs quadratic elements");
  matrices_->straight_density = densities(terms_, cells.straight_cells, cells.straight.size());
  matrices_->curved_density = densities(terms_, cells.curved_cells, cells.curved.size());
  matrices_->curved_mass.resize(cells.curved.size());
  set_curved_masses(matrices_->of(cells), 1.0 / terms_.duration, matrices_->curved_mass);
  add_mass(numbers(terms_.before), given_mass_);
  add_tension(numbers(terms_.interface_went), given_tension_);
}
InertiaProduct::~InertiaProduct() = default;

void InertiaProduct::convect(std::span<const double> v) {
  std::vector<double> convecting(v.begin(), v.end());
  const std::span<const double> mesh_velocity = numbers(terms_.mesh_velocity);
  for (std::size_t i = 0; i < convecting.size(); ++i) convecting[i] -= mesh_velocity[i];
  matrices_->straight.resize(cells_.straight.size());
  matrices_->curved.resize(cells_.curved.size());
  convects_ = true;
  set_all(matrices_->of(cells_), 1.0 / terms_.duration, convecting.data(), matrices_->straight,
          matrices_->curved);
}

CellInertia InertiaProduct::by_cells() const {
  return {{matrices_->straight_density, 1.0 / terms_.duration}, {matrices_->curved_mass}};
}

ConvectedCells InertiaProduct::by_convected_cells() const {
  MENISCUS_ASSERT(convects_, "nothing convects");
  return {{matrices_->straight}, {matrices_->curved}};
}

void InertiaProduct::add(std::span<const double> v, std::span<double> momentum) const {
  if (convects_)
    add_all(matrices_->of(cells_), matrices_->straight, matrices_->curved, v.data(),
            momentum.data());
  else
    add_mass(v, momentum);
  add_tension(v, momentum);
}

void InertiaProduct::add_tension(std::span<const double> v, std::span<double> momentum) const {
  terms_.add_tension(v, momentum);
}

void InertiaProduct::add_mass(std::span<const double> v, std::span<double> momentum) const {
  add_masses(matrices_->of(cells_), 1.0 / terms_.duration, matrices_->curved_mass, v.data(),
             momentum.data());
}

void InertiaProduct::add_mass_diagonal(std::span<double> by_node) const {
  const double rate = 1.0 / terms_.duration;
  for (std::size_t n = 0; n < cells_.straight.size(); ++n) {
    const StraightCells& cells = cells_.straight[n];
    for (std::size_t i = 0; i < 10; ++i)
      for (std::size_t m = 0; m < kLanes; ++m)
        by_node[static_cast<std::size_t>(cells.nodes[i][m])] +=
            20.0 * rate * kQuadraticMass[i][i] * cells.volume[m] *
            matrices_->straight_density[n].of[m];
  }
  for (std::size_t n = 0; n < cells_.curved.size(); ++n)
    for (std::size_t i = 0; i < 10; ++i)
      for (std::size_t m = 0; m < kLanes; ++m)
        by_node[static_cast<std::size_t>(cells_.curved[n].nodes[i][m])] +=
            matrices_->curved_mass[n].entry[i][i][m];
}

void InertiaProduct::add_diagonal(std::span<double> by_node) const {
  add_mass_diagonal(by_node);
  const auto add = [&](const FaceNodes& nodes, const Eigen::Matrix<double, 6, 6>& values) {
    for (std::size_t i = 0; i < 6; ++i)
      by_node[static_cast<std::size_t>(nodes[i].value)] +=
          values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i));
  };
  for (const FaceStiffness& face : terms_.tension) add(face.nodes, face.values);
  for (const FaceElasticity& face : terms_.elasticity) add(face.nodes, face.mean_of_components());
}

void InertiaProduct::subtract_given(std::span<double> momentum) const {
  for (std::size_t i = 0; i < momentum.size(); ++i)
    momentum[i] -= given_mass_[i] + given_tension_[i];
}

double InertiaProduct::kinetic_rate(std::span<const double> v, std::int32_t num_owned) const {
  MENISCUS_ASSERT(convects_, "nothing convects");
  std::vector<double> momentum(v.size());
  add_all(matrices_->of(cells_), matrices_->straight, matrices_->curved, v.data(), momentum.data());
  double rate = 0.0;
  for (std::size_t i = 0; i < 3 * static_cast<std::size_t>(num_owned); ++i)
    rate += v[i] * (momentum[i] - given_mass_[i]);
  return rate;
}

}  // namespace meniscus::fem
