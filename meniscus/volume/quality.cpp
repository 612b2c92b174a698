#include "meniscus/volume/quality.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "meniscus/core/vector_clones.hpp"
#include "meniscus/volume/facets.hpp"

namespace meniscus {
namespace {

// One instruction works on so many cells.
constexpr std::size_t kLanes = 8;
using Numbers = std::array<double, kLanes>;

/// The least and the largest dihedral angle of some cells, as c|c| of their cosines c: no roots are
/// needed, and c|c| rises with the cosine.
struct AngleRanges {
  Numbers least, most;
};

/// The six dihedral angles of each cell: c = −n_i·n_j of the unit outward normals of the facets.
/// `x` has the coordinates of all vertices.
MENISCUS_VECTOR_CLONES
void find_angles(const double* x, const std::array<const CellVertices*, kLanes>& cells,
                 AngleRanges& to) {
  std::array<std::array<Numbers, 3>, 4> p, n;
  std::array<Numbers, 4> inverse;  // of |n|²
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t m = 0; m < kLanes; ++m) {
      const double* const from = x + std::ptrdiff_t{3} * (*cells[m])[k].value;
      for (std::size_t a = 0; a < 3; ++a) p[k][a][m] = from[a];
    }
  for (std::size_t k = 0; k < 4; ++k) {
    const auto& [i, j, l] = kFacetCorners[k];
    for (std::size_t m = 0; m < kLanes; ++m) {
      const std::array<double, 3> u = {p[j][0][m] - p[i][0][m], p[j][1][m] - p[i][1][m],
                                       p[j][2][m] - p[i][2][m]},
                                  v = {p[l][0][m] - p[i][0][m], p[l][1][m] - p[i][1][m],
                                       p[l][2][m] - p[i][2][m]};
      n[k][0][m] = u[1] * v[2] - u[2] * v[1];
      n[k][1][m] = u[2] * v[0] - u[0] * v[2];
      n[k][2][m] = u[0] * v[1] - u[1] * v[0];
      inverse[k][m] =
          1.0 / (n[k][0][m] * n[k][0][m] + n[k][1][m] * n[k][1][m] + n[k][2][m] * n[k][2][m]);
    }
  }
  to.least.fill(1.0);
  to.most.fill(-1.0);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j)
      for (std::size_t m = 0; m < kLanes; ++m) {
        const double dot =
            -(n[i][0][m] * n[j][0][m] + n[i][1][m] * n[j][1][m] + n[i][2][m] * n[j][2][m]);
        const double square = dot * std::abs(dot) * inverse[i][m] * inverse[j][m];
        to.least[m] = std::min(to.least[m], square);
        to.most[m] = std::max(to.most[m], square);
      }
}

/// Shows `take` the least and the largest angle of every cell.
template <class Take>
void for_angles(const TetMesh& mesh, const Take& take) {
  const auto count = static_cast<std::size_t>(mesh.num_cells());
  AngleRanges angles;
  std::array<const CellVertices*, kLanes> cells;
  for (std::size_t first = 0; first < count; first += kLanes) {
    const std::size_t num_taken = std::min(kLanes, count - first);
    for (std::size_t m = 0; m < kLanes; ++m)  // the last one fills up
      cells[m] = &mesh.cells.span()[first + std::min(m, num_taken - 1)];
    find_angles(mesh.x.span().front().data(), cells, angles);
    for (std::size_t m = 0; m < num_taken; ++m)
      take(CellId{static_cast<std::int32_t>(first + m)}, angles.least[m], angles.most[m]);
  }
}

/// 3 r/R with r = 3V/Σ areas and R = |α|/(12V). Here α = a² b×c + b² c×a + c² a×b of the edges a,
/// b, c from one vertex.
double radius_ratio(const TetMesh& mesh, const CellVertices& cell) {
  const Vec3 a = mesh.x[cell[1]] - mesh.x[cell[0]], b = mesh.x[cell[2]] - mesh.x[cell[0]],
             c = mesh.x[cell[3]] - mesh.x[cell[0]];
  const double six_volumes = a.cross(b).dot(c);
  const double twice_area =
      a.cross(b).norm() + b.cross(c).norm() + c.cross(a).norm() + (b - a).cross(c - a).norm();
  const Vec3 alpha =
      a.squaredNorm() * b.cross(c) + b.squaredNorm() * c.cross(a) + c.squaredNorm() * a.cross(b);
  const double product = twice_area * alpha.norm();
  return product > 0.0 ? 6.0 * six_volumes * std::abs(six_volumes) / product : 0.0;
}

/// The angle whose cosine c has this c|c|.
double degrees(double square) {
  const double cosine = std::copysign(std::sqrt(std::min(std::abs(square), 1.0)), square);
  return std::acos(cosine) * 180.0 / std::numbers::pi;
}

}  // namespace

MeshQuality quality(const TetMesh& mesh) {
  MeshQuality q;
  double least = 1.0, most = -1.0;  // of all cells
  q.min_volume = q.min_radius_ratio = std::numeric_limits<double>::infinity();
  const double cosine = std::cos(10.0 * std::numbers::pi / 180.0),
               square_of_10_deg = cosine * cosine;
  std::int32_t below = 0;
  for_angles(mesh, [&](CellId c, double least_of_cell, double most_of_cell) {
    least = std::min(least, least_of_cell);
    most = std::max(most, most_of_cell);
    below += most_of_cell > square_of_10_deg ? 1 : 0;
    q.min_volume = std::min(q.min_volume, signed_volume(mesh, c));
    q.min_radius_ratio = std::min(q.min_radius_ratio, radius_ratio(mesh, mesh.cells[c]));
  });
  q.min_dihedral_deg = degrees(most);
  q.max_dihedral_deg = degrees(least);
  q.below_10_deg = static_cast<double>(below) / std::max(1, mesh.num_cells());
  return q;
}

double smallest_dihedral_deg(const TetMesh& mesh) {
  double most = -1.0;
  for_angles(mesh, [&](CellId, double, double of_cell) { most = std::max(most, of_cell); });
  return degrees(most);
}

CellField<double> min_dihedral_deg(const TetMesh& mesh) {
  CellField<double> result(mesh.num_cells());
  for_angles(mesh, [&](CellId c, double, double most) { result[c] = degrees(most); });
  return result;
}

}  // namespace meniscus
