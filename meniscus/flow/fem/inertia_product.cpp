#include "meniscus/flow/fem/inertia_product.hpp"

#include <algorithm>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/cell_batches.hpp"
#include "meniscus/flow/fem/cell_inertia.hpp"
#include "meniscus/flow/fem/elements.hpp"

namespace meniscus::fem {

using namespace lanes;

namespace {

/// Sets ∫ρφ_iφ_j/τ of curved cells.
MENISCUS_INLINE void set_mass(const CurvedCells& cells, const Lanes& density_rate, Square& m) {
  m.entry = {};
  for (std::size_t q = 0; q < cells.points.size(); ++q) {
    const std::array<double, 10> shapes =
        quadratic_tetrahedron_values(kTetrahedronRule5[q].barycentric);
    const Lanes weight = cells.points[q].weight * density_rate;
    for (std::size_t i = 0; i < 10; ++i)
      for (std::size_t j = 0; j < 10; ++j) m.entry[i][j] += (shapes[i] * shapes[j]) * weight;
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
};

MENISCUS_VECTOR_CLONES
void set_masses(std::span<const CurvedCells> cells, std::span<const Density> density, double rate,
                std::span<Square> masses) {
  for (std::size_t n = 0; n < cells.size(); ++n)
    set_mass(cells[n], rate * density[n].of, masses[n]);
}
MENISCUS_VECTOR_CLONES
void add_all(const Batches& cells, const ConvectedCells& inertia, const double* v,
             double* momentum) {
  add_products(cells.straight, inertia.straight, v, momentum);
  add_products(cells.curved, inertia.curved, v, momentum);
}
MENISCUS_VECTOR_CLONES
void add_masses(const Batches& cells, const CellInertia& inertia, const double* v,
                double* momentum) {
  add_products(cells.straight, inertia.straight, v, momentum);
  add_products(cells.curved, inertia.curved, v, momentum);
}

/// The densities of the cells by fours; the last lanes repeat one.
std::vector<Density> densities(const InertiaTerms& terms, std::span<const CellId> cells,
                               std::size_t num_batches) {
  std::vector<Density> result(num_batches);
  for (std::size_t n = 0; n < kLanes * num_batches; ++n)
    result[n / kLanes].of[n % kLanes] = terms.density[cells[std::min(n, cells.size() - 1)]];
  return result;
}

}  // namespace

struct InertiaProduct::Cells {
  std::vector<Density> straight_density, curved_density;
  std::vector<Square> curved_mass;
};

InertiaProduct::InertiaProduct(const StokesProblem& problem, const CellBatches& batches)
    : terms_(*problem.inertia),
      batches_(batches),
      cells_(std::make_unique<Cells>()),
      given_mass_(numbers(terms_.before).size()),
      given_tension_(given_mass_.size()) {
  MENISCUS_ASSERT(problem.space.elements == Elements::p2_p1, "inertia needs quadratic elements");
  cells_->straight_density = densities(terms_, batches.straight_cells, batches.straight.size());
  cells_->curved_density = densities(terms_, batches.curved_cells, batches.curved.size());
  cells_->curved_mass.resize(batches.curved.size());
  set_masses(batches.curved, cells_->curved_density, 1.0 / terms_.duration, cells_->curved_mass);
  add_mass(numbers(terms_.before), given_mass_);
  add_tension(numbers(terms_.interface_went), given_tension_);
}
InertiaProduct::~InertiaProduct() = default;

void InertiaProduct::convect(std::span<const double> v) {
  convecting_.assign(v.begin(), v.end());
  const std::span<const double> mesh_velocity = numbers(terms_.mesh_velocity);
  for (std::size_t i = 0; i < convecting_.size(); ++i) convecting_[i] -= mesh_velocity[i];
}

CellInertia InertiaProduct::by_cells() const {
  return {{cells_->straight_density, 1.0 / terms_.duration}, {cells_->curved_mass}};
}

ConvectedCells InertiaProduct::by_convected_cells() const {
  MENISCUS_ASSERT(convects(), "nothing convects");
  const CellInertia masses = by_cells();
  return {{masses.straight, cells_->straight_density, convecting_.data()},
          {masses.curved, cells_->curved_density, convecting_.data()}};
}

void InertiaProduct::add(std::span<const double> v, std::span<double> momentum) const {
  if (convects())
    add_all({batches_.straight, batches_.curved}, by_convected_cells(), v.data(), momentum.data());
  else
    add_mass(v, momentum);
  add_tension(v, momentum);
}

void InertiaProduct::add_tension(std::span<const double> v, std::span<double> momentum) const {
  terms_.add_tension(v, momentum);
}

void InertiaProduct::add_mass(std::span<const double> v, std::span<double> momentum) const {
  add_masses({batches_.straight, batches_.curved}, by_cells(), v.data(), momentum.data());
}

void InertiaProduct::add_mass_diagonal(std::span<double> by_node) const {
  const double rate = 1.0 / terms_.duration;
  for (std::size_t n = 0; n < batches_.straight.size(); ++n) {
    const StraightCells& cells = batches_.straight[n];
    for (std::size_t i = 0; i < 10; ++i)
      for (std::size_t m = 0; m < kLanes; ++m)
        by_node[static_cast<std::size_t>(cells.nodes[i][m])] += 20.0 * rate * kQuadraticMass[i][i] *
                                                                cells.volume[m] *
                                                                cells_->straight_density[n].of[m];
  }
  for (std::size_t n = 0; n < batches_.curved.size(); ++n)
    for (std::size_t i = 0; i < 10; ++i)
      for (std::size_t m = 0; m < kLanes; ++m)
        by_node[static_cast<std::size_t>(batches_.curved[n].nodes[i][m])] +=
            cells_->curved_mass[n].entry[i][i][m];
}

void InertiaProduct::subtract_given(std::span<double> momentum) const {
  for (std::size_t i = 0; i < momentum.size(); ++i)
    momentum[i] -= given_mass_[i] + given_tension_[i];
}

double InertiaProduct::kinetic_rate(std::span<const double> v, std::int32_t num_owned) const {
  std::vector<double> momentum(v.size());
  add_all({batches_.straight, batches_.curved}, by_convected_cells(), v.data(), momentum.data());
  double rate = 0.0;
  for (std::size_t i = 0; i < 3 * static_cast<std::size_t>(num_owned); ++i)
    rate += v[i] * (momentum[i] - given_mass_[i]);
  return rate;
}

}  // namespace meniscus::fem
