#include "meniscus/volume/quality.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "meniscus/volume/facets.hpp"

namespace meniscus {
namespace {

/// The least and the largest of dihedral angles, as c|c| of their cosines c: no roots are needed.
struct AngleRange {
  double least = 1.0, most = -1.0;  // c|c|, which rises with the cosine
};

/// The six dihedral angles: c = −n_i·n_j of the unit outward normals of the facets.
AngleRange dihedral_angles(const TetMesh& mesh, const CellVertices& cell) {
  std::array<Vec3, 4> n;
  std::array<double, 4> inverse;  // of |n|²
  for (std::size_t k = 0; k < 4; ++k) {
    const FacetVertices f = facet(cell, k);
    n[k] = (mesh.x[f[1]] - mesh.x[f[0]]).cross(mesh.x[f[2]] - mesh.x[f[0]]);
    inverse[k] = 1.0 / n[k].squaredNorm();
  }
  AngleRange range;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) {
      const double dot = -n[i].dot(n[j]);
      const double square = dot * std::abs(dot) * inverse[i] * inverse[j];
      range.least = std::min(range.least, square);
      range.most = std::max(range.most, square);
    }
  return range;
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
  AngleRange all;
  q.min_volume = q.min_radius_ratio = std::numeric_limits<double>::infinity();
  const double cosine = std::cos(10.0 * std::numbers::pi / 180.0),
               square_of_10_deg = cosine * cosine;
  std::int32_t below = 0;
  for (const CellId c : mesh.cells.ids()) {
    const AngleRange range = dihedral_angles(mesh, mesh.cells[c]);
    all.least = std::min(all.least, range.least);
    all.most = std::max(all.most, range.most);
    below += range.most > square_of_10_deg ? 1 : 0;
    q.min_volume = std::min(q.min_volume, signed_volume(mesh, c));
    q.min_radius_ratio = std::min(q.min_radius_ratio, radius_ratio(mesh, mesh.cells[c]));
  }
  q.min_dihedral_deg = degrees(all.most);
  q.max_dihedral_deg = degrees(all.least);
  q.below_10_deg = static_cast<double>(below) / std::max(1, mesh.num_cells());
  return q;
}

double smallest_dihedral_deg(const TetMesh& mesh) {
  double most = -1.0;
  for (const CellVertices& cell : mesh.cells)
    most = std::max(most, dihedral_angles(mesh, cell).most);
  return degrees(most);
}

CellField<double> min_dihedral_deg(const TetMesh& mesh) {
  CellField<double> result(mesh.num_cells());
  for (const CellId c : mesh.cells.ids())
    result[c] = degrees(dihedral_angles(mesh, mesh.cells[c]).most);
  return result;
}

}  // namespace meniscus
