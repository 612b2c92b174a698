#include "meniscus/flow/fem/laplacian_matrix.hpp"

#include <algorithm>
#include <cstring>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/cell_batches.hpp"
#include "meniscus/flow/fem/cell_inertia.hpp"
#include "meniscus/flow/fem/elements.hpp"
#include "meniscus/flow/fem/inertia_product.hpp"

namespace meniscus::fem {

using namespace lanes;

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// From ∇φ = (4b_k − 1)∇b_k at a corner k, 4(b_p∇b_q + b_q∇b_p) at an edge, and
/// ∫b_k b_l = V(1 + δ_kl)/20.
MENISCUS_INLINE void set_stiffness(const StraightCells& cells, Square& K) {
  const std::array<Lanes3, 4> gradients = all_gradients(cells.gradient);
  std::array<Corners, 4> G;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t l = k; l < 4; ++l)
      G[k][l] = G[l][k] = cells.volume * cells.viscosity * dot(gradients[k], gradients[l]);
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t l = k; l < 4; ++l)
      K.entry[k][l] = K.entry[l][k] = (k == l ? 12.0 : -4.0) * G[k][l];
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [p, q] = kCellEdges[e];
    for (std::size_t k = 0; k < 4; ++k)
      K.entry[k][4 + e] = K.entry[4 + e][k] =
          (k == p ? 12.0 : -4.0) * G[k][q] + (k == q ? 12.0 : -4.0) * G[k][p];
    for (std::size_t f = e; f < 6; ++f) {
      const auto [r, s] = kCellEdges[f];
      K.entry[4 + e][4 + f] = K.entry[4 + f][4 + e] =
          (p == r ? 32.0 : 16.0) * G[q][s] + (p == s ? 32.0 : 16.0) * G[q][r] +
          (q == r ? 32.0 : 16.0) * G[p][s] + (q == s ? 32.0 : 16.0) * G[p][r];
    }
  }
}

MENISCUS_INLINE void set_stiffness(const CurvedCells& cells, Square& K) {
  K.entry = {};
  for (std::size_t n = 0; n < cells.points.size(); ++n) {
    const std::array<double, 4>& b = kTetrahedronRule5[n].barycentric;
    const std::array<Lanes3, 4> gradients = all_gradients(cells.points[n].gradient);
    const Lanes scale = cells.points[n].weight * cells.viscosity;
    std::array<Lanes3, 10> of_shapes;
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t k = 0; k < 4; ++k) of_shapes[k][a] = (4.0 * b[k] - 1.0) * gradients[k][a];
      for (std::size_t e = 0; e < 6; ++e) {
        const auto [p, q] = kCellEdges[e];
        of_shapes[4 + e][a] = 4.0 * b[p] * gradients[q][a] + 4.0 * b[q] * gradients[p][a];
      }
    }
    for (std::size_t i = 0; i < 10; ++i) {
      const Lanes3 scaled = {scale * of_shapes[i][0], scale * of_shapes[i][1],
                             scale * of_shapes[i][2]};
      for (std::size_t j = i; j < 10; ++j) K.entry[i][j] += dot(scaled, of_shapes[j]);
    }
  }
  for (std::size_t i = 0; i < 10; ++i)
    for (std::size_t j = 0; j < i; ++j) K.entry[i][j] = K.entry[j][i];
}

MENISCUS_INLINE void add_mass(const NoInertia&, std::size_t, Square&) {}
MENISCUS_INLINE void add_mass(const CellSquares& masses, std::size_t n, Square& K) {
  for (std::size_t i = 0; i < 10; ++i)
    for (std::size_t j = 0; j < 10; ++j) K.entry[i][j] += masses.matrices[n].entry[i][j];
}
/// The masses of straight cells, whose volumes are given beside.
struct StraightMassesOf {
  const StraightMasses& masses;
  std::span<const StraightCells> cells;
};
MENISCUS_INLINE void add_mass(const StraightMassesOf& of, std::size_t n, Square& K) {
  const Lanes scale = 20.0 * of.masses.rate * of.cells[n].volume * of.masses.density[n].of;
  for (std::size_t i = 0; i < 10; ++i)
    for (std::size_t j = 0; j < 10; ++j) K.entry[i][j] += kQuadraticMass[i][j] * scale;
}

template <class Batch, class Masses>
MENISCUS_INLINE void set_all(std::span<const Batch> cells, const Masses& masses, const Range& range,
                             Square* squares) {
  for (std::size_t n = range.begin; n < range.end; ++n) {
    set_stiffness(cells[n], squares[n - range.begin]);
    add_mass(masses, n, squares[n - range.begin]);
  }
}

// One function for each, as clones are made of functions alone.
MENISCUS_VECTOR_CLONES
void set_squares(std::span<const StraightCells> cells, const Range& range, Square* squares) {
  set_all(cells, NoInertia{}, range, squares);
}
MENISCUS_VECTOR_CLONES
void set_squares(std::span<const CurvedCells> cells, const Range& range, Square* squares) {
  set_all(cells, NoInertia{}, range, squares);
}
MENISCUS_VECTOR_CLONES
void set_squares(std::span<const StraightCells> cells, const StraightMasses& masses,
                 const Range& range, Square* squares) {
  set_all(cells, StraightMassesOf{masses, cells}, range, squares);
}
MENISCUS_VECTOR_CLONES
void set_squares(std::span<const CurvedCells> cells, const CellSquares& masses, const Range& range,
                 Square* squares) {
  set_all(cells, masses, range, squares);
}

/// The three components of one node, and a fourth number that does not count.
using Node [[gnu::vector_size(32)]] = double;
MENISCUS_INLINE Node node_at(const double* v, std::int32_t node) {
  Node result;
  std::memcpy(&result, v + std::ptrdiff_t{3} * node, sizeof(result));
  return result;
}

/// Four sums at a time: one would wait for each product.
MENISCUS_VECTOR_CLONES
void multiply_rows(std::int32_t num_rows, const std::int32_t* row_start,
                   const std::int32_t* columns, const float* values, const double* v,
                   double* result) {
  for (std::int32_t i = 0; i < num_rows; ++i) {
    Node a = {}, b = {}, c = {}, d = {};
    std::int32_t k = row_start[i];
    const std::int32_t end = row_start[i + 1];
    for (; k + 4 <= end; k += 4) {
      a += double{values[k]} * node_at(v, columns[k]);
      b += double{values[k + 1]} * node_at(v, columns[k + 1]);
      c += double{values[k + 2]} * node_at(v, columns[k + 2]);
      d += double{values[k + 3]} * node_at(v, columns[k + 3]);
    }
    for (; k < end; ++k) a += double{values[k]} * node_at(v, columns[k]);
    a += b + (c + d);
    for (std::size_t n = 0; n < 3; ++n) result[3 * at(i) + n] = a[n];
  }
}

}  // namespace

LaplacianMatrix::LaplacianMatrix(const FlowSpace& space, std::int32_t num_rows)
    : num_rows_(num_rows), graph_(space.velocity_graph()) {}

void LaplacianMatrix::assemble(const StokesProblem& problem, const StokesProduct& product) {
  values_.assign(graph_->num_entries(), 0.0F);
  add_cells(problem, product);
  if (problem.inertia) add_tension(*problem.inertia);
}

void LaplacianMatrix::add_cells(const StokesProblem& problem, const StokesProduct& product) {
  const auto add = [&](const auto& batches, const std::vector<CellId>& cells, auto set) {
    with_matrices<Square>(
        batches.size(), cells, set, [&](CellId c, const Square& K, std::size_t lane) {
          const auto nodes = problem.space.velocity.of(c);
          std::size_t pair = 100 * at(c.value);
          for (std::size_t i = 0; i < 10; ++i)
            for (std::size_t j = 0; j < 10; ++j)
              values_[graph_->entry(nodes[i], pair++)] += static_cast<float>(K.entry[i][j][lane]);
        });
  };
  const CellBatches& cells = product.cells();
  const std::span<const StraightCells> straight = cells.straight;
  const std::span<const CurvedCells> curved = cells.curved;
  if (const InertiaProduct* inertia = product.inertia()) {
    const CellInertia masses = inertia->by_cells();
    add(straight, cells.straight_cells,
        [&](const Range& range, Square* to) { set_squares(straight, masses.straight, range, to); });
    add(curved, cells.curved_cells,
        [&](const Range& range, Square* to) { set_squares(curved, masses.curved, range, to); });
  } else {
    add(straight, cells.straight_cells,
        [&](const Range& range, Square* to) { set_squares(straight, range, to); });
    add(curved, cells.curved_cells,
        [&](const Range& range, Square* to) { set_squares(curved, range, to); });
  }
}

void LaplacianMatrix::add_tension(const InertiaTerms& terms) {
  const auto add = [&](const FaceNodes& nodes, const Eigen::Matrix<double, 6, 6>& stiffness) {
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t j = 0; j < nodes.size(); ++j)
        values_[entry(nodes[i].value, nodes[j].value)] += static_cast<float>(
            stiffness(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
  };
  for (const FaceStiffness& face : terms.tension) add(face.nodes, face.values);
  for (const FaceElasticity& face : terms.elasticity) add(face.nodes, face.mean_of_components());
}

std::size_t LaplacianMatrix::entry(std::int32_t row, std::int32_t column) const {
  const auto first = graph_->columns.begin() + graph_->row_start[at(row)],
             last = graph_->columns.begin() + graph_->row_start[at(row) + 1],
             found = std::lower_bound(first, last, column);
  MENISCUS_ASSERT(found != last && *found == column, "nodes {} and {}", row, column);
  return static_cast<std::size_t>(found - graph_->columns.begin());
}

void LaplacianMatrix::multiply(std::span<const double> v, std::span<double> result) const {
  MENISCUS_ASSERT(v.size() == 3 * at(graph_->num_columns) + 1 && result.size() == 3 * at(num_rows_),
                  "{} numbers in, {} out", v.size(), result.size());
  multiply_rows(num_rows_, graph_->row_start.data(), graph_->columns.data(), values_.data(),
                v.data(), result.data());
}

std::vector<double> LaplacianMatrix::diagonal() const {
  std::vector<double> diagonal;
  diagonal.reserve(at(num_rows_));
  for (std::int32_t i = 0; i < num_rows_; ++i) diagonal.push_back(double{values_[entry(i, i)]});
  return diagonal;
}

}  // namespace meniscus::fem
