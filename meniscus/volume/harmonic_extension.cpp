#include "meniscus/volume/harmonic_extension.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "meniscus/core/error.hpp"
#include "meniscus/core/log.hpp"
#include "meniscus/geometry/tetrahedron.hpp"

namespace meniscus {
namespace {

/// The cells at each vertex from `first_free` on, in rising order.
class CellsAtVertices {
 public:
  CellsAtVertices(const TetMesh& mesh, TetVertexId first_free)
      : first_(static_cast<std::size_t>(mesh.num_vertices() - first_free.value) + 1, 0) {
    const auto each = [&](const auto& visit) {
      for (const CellId c : mesh.cells.ids())
        for (const TetVertexId v : mesh.cells[c])
          if (v >= first_free) visit(static_cast<std::size_t>(v.value - first_free.value), c);
    };
    each([&](std::size_t row, CellId) { ++first_[row + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    cells_.resize(static_cast<std::size_t>(first_.back()));
    std::vector<std::int32_t> next(first_.begin(), first_.end() - 1);
    each([&](std::size_t row, CellId c) { cells_[static_cast<std::size_t>(next[row]++)] = c; });
  }
  [[nodiscard]] std::span<const CellId> of_row(std::size_t row) const {
    return {cells_.data() + first_[row], cells_.data() + first_[row + 1]};
  }

 private:
  std::vector<std::int32_t> first_;
  std::vector<CellId> cells_;
};

void end_row(linear::CsrMatrix& matrix) {
  matrix.row_start.push_back(static_cast<std::int32_t>(matrix.columns.size()));
}

/// Adds to an entry that the pattern has.
void add(linear::CsrMatrix& matrix, std::int32_t row, std::int32_t column, double value) {
  const auto begin = matrix.columns.begin() + matrix.row_start[static_cast<std::size_t>(row)],
             end = matrix.columns.begin() + matrix.row_start[static_cast<std::size_t>(row) + 1];
  const auto found = std::lower_bound(begin, end, column);
  MENISCUS_ASSERT(found != end && *found == column, "no entry {}, {}: another mesh", row, column);
  matrix.values[static_cast<std::size_t>(found - matrix.columns.begin())] += value;
}

/// The matrices of ∫_K |K|⁻¹ ∇φ_i·∇φ_j, summed over the cells of a mesh as it stands.
HarmonicPattern matrices_of(HarmonicPattern pattern, const TetMesh& mesh) {
  pattern.stiffness.values.assign(pattern.stiffness.columns.size(), 0.0);
  pattern.coupling.values.assign(pattern.coupling.columns.size(), 0.0);
  for (const CellId c : mesh.cells.ids()) {
    const CellVertices& v = mesh.cells[c];
    const std::array<Vec3, 4> gradients =
        linear_tetrahedron({mesh.x[v[0]], mesh.x[v[1]], mesh.x[v[2]], mesh.x[v[3]]}).gradient;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::int32_t row = v[i].value - pattern.first_free.value;
      if (row < 0) continue;
      for (std::size_t j = 0; j < 4; ++j) {
        const double entry = gradients[i].dot(gradients[j]);
        const std::int32_t column = v[j].value - pattern.first_free.value;
        if (column >= 0)
          add(pattern.stiffness, row, column, entry);
        else
          add(pattern.coupling, row, v[j].value, entry);
      }
    }
  }
  return pattern;
}

/// −A_d w_k, A_d the entries that couple the unknowns with the data.
void set_right_hand_side(const linear::CsrMatrix& coupling, const Field<TetVertexId, Vec3>& w,
                         Eigen::Index component, std::span<double> right) {
  for (std::size_t row = 0; row < right.size(); ++row) {
    right[row] = 0.0;
    for (auto k = static_cast<std::size_t>(coupling.row_start[row]);
         k < static_cast<std::size_t>(coupling.row_start[row + 1]); ++k)
      right[row] -= coupling.values[k] * w[TetVertexId{coupling.columns[k]}][component];
  }
}

}  // namespace

HarmonicPattern::HarmonicPattern(const TetMesh& mesh, TetVertexId first) : first_free(first) {
  const std::int32_t num_rows = mesh.num_vertices() - first_free.value;
  MENISCUS_ASSERT(first_free.value >= 0 && num_rows >= 0, "{} of {} vertices are fixed",
                  first_free.value, mesh.num_vertices());
  stiffness.num_columns = num_rows;
  coupling.num_columns = first_free.value;
  const CellsAtVertices cells(mesh, first_free);
  Field<TetVertexId, std::int32_t> seen_from(mesh.num_vertices(), -1);
  std::vector<TetVertexId> neighbours;  // and the vertex itself
  end_row(stiffness);
  end_row(coupling);
  for (std::int32_t row = 0; row < num_rows; ++row) {
    neighbours.clear();
    for (const CellId c : cells.of_row(static_cast<std::size_t>(row)))
      for (const TetVertexId v : mesh.cells[c])
        if (std::exchange(seen_from[v], row) != row) neighbours.push_back(v);
    std::ranges::sort(neighbours);
    for (const TetVertexId v : neighbours) {
      if (v < first_free)
        coupling.columns.push_back(v.value);
      else
        stiffness.columns.push_back(v.value - first_free.value);
    }
    end_row(stiffness);
    end_row(coupling);
  }
}

HarmonicExtension::HarmonicExtension(const HarmonicPattern& pattern, const TetMesh& mesh)
    : matrices_(matrices_of(pattern, mesh)), solver_(matrices_.stiffness.view()) {}

int HarmonicExtension::extend(Field<TetVertexId, Vec3>& w) const {
  // Any smooth extension will do, so the residual need not be small. An iterate cut short after as
  // many steps (never seen; ten are usual) would do as well.
  constexpr double kTolerance = 1e-6;
  constexpr int kMostIterations = 200;
  const auto num_free = static_cast<std::size_t>(matrices_.stiffness.num_columns);
  MENISCUS_ASSERT(w.size() == matrices_.first_free.value + matrices_.stiffness.num_columns,
                  "a velocity of {} vertices", w.size());
  std::vector<double> right(num_free), solution(num_free);
  int most_iterations = 0;
  for (Eigen::Index k = 0; k < 3 && num_free > 0; ++k) {
    set_right_hand_side(matrices_.coupling, w, k, right);
    const linear::LinearReport report = solver_.solve(right, solution, kTolerance, kMostIterations);
    if (!report.converged) log::warning("motion of the volume mesh: {}", report.reason);
    most_iterations = std::max(most_iterations, report.iterations);
    for (std::size_t i = 0; i < num_free; ++i)
      w[{matrices_.first_free.value + static_cast<std::int32_t>(i)}][k] = solution[i];
  }
  return most_iterations;
}

}  // namespace meniscus
