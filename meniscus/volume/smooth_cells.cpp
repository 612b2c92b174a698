#include "meniscus/volume/smooth_cells.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "meniscus/volume/cells_around.hpp"
#include "meniscus/volume/facets.hpp"

namespace meniscus {
namespace {

constexpr int kSweeps = 3;
/// Vertices whose cells all count as this or better stay. Those beside interfaces never do.
constexpr double kGood = 0.5;
/// What the mean ratio counts of cells on a face of an interface.
constexpr double kOnInterface = 0.5;
/// The first way that is tried, over the shortest edge at the vertex. Ways that do not help are
/// halved, so often.
constexpr double kFirstWay = 0.25;
constexpr int kMostHalvings = 4, kMostWays = 12;

constexpr double cube(double x) { return x * x * x; }

/// A cell seen from one of its vertices.
struct Seen {
  std::array<Vec3, 3> others;  // counter-clockwise from outside the cell
  double weight;               // of its badness
};

/// η⁻³ = (Σl²)³/(432 (6V)²) of cells, as a function of the vertex that they share.
struct Badness {
  double sum = 0.0;  // of its squares
  double worst = 0.0;
  Vec3 gradient = Vec3::Zero();  // of the sum
};

Badness badness(std::span<const Seen> cells, const Vec3& x) {
  Badness result;
  for (const auto& [others, weight] : cells) {
    const Vec3 a = others[0] - x, b = others[1] - x, c = others[2] - x;
    const Vec3 across = (b - a).cross(c - a);
    const double six_volumes = a.dot(across);
    if (!(six_volumes > 0.0)) {
      result.sum = result.worst = std::numeric_limits<double>::infinity();
      return result;
    }
    const double squares = a.squaredNorm() + b.squaredNorm() + c.squaredNorm() +
                           (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
    const double here = weight * cube(squares) / (432.0 * six_volumes * six_volumes);
    result.sum += here * here;
    result.worst = std::max(result.worst, here);
    result.gradient +=
        2.0 * here * here * (2.0 / six_volumes * across - 6.0 / squares * (a + b + c));
  }
  return result;
}

CellField<char> cells_on_interfaces(const TetMesh& mesh) {
  CellField<char> result(mesh.num_cells(), 0);
  for (const EmbeddedSurface& interface : mesh.interfaces)
    for (const auto& [inside, outside] : interface.sides) result[inside] = result[outside] = 1;
  return result;
}

/// The cells around one vertex after another.
class Star {
 public:
  Star(const TetMesh& mesh, const CellField<char>& are_on_interfaces)
      : mesh_(mesh), around_(mesh.num_vertices(), mesh.cells), are_on_(are_on_interfaces) {}

  void look_from(TetVertexId v) {
    cells_.clear();
    shortest_ = std::numeric_limits<double>::infinity();
    for (const CellId c : around_.of(v)) {
      const CellVertices& cell = mesh_.cells[c];
      const auto k = static_cast<std::size_t>(std::ranges::find(cell, v) - cell.begin());
      Seen seen{{}, are_on_[c] != 0 ? 1.0 / cube(kOnInterface) : 1.0};
      for (std::size_t i = 0; i < 3; ++i) {
        seen.others[i] = mesh_.x[cell[kFacetCorners[k][i]]];
        shortest_ = std::min(shortest_, (seen.others[i] - mesh_.x[v]).norm());
      }
      cells_.push_back(seen);
    }
  }
  [[nodiscard]] std::span<const Seen> cells() const { return cells_; }
  [[nodiscard]] double shortest_edge() const { return shortest_; }

 private:
  const TetMesh& mesh_;
  CellsAround around_;
  const CellField<char>& are_on_;
  std::vector<Seen> cells_;
  double shortest_ = 0.0;
};

/// Where the vertex in the middle of a star goes.
Vec3 improved(const Star& star, Vec3 x) {
  constexpr double kBad = 1.0 / cube(kGood);
  Badness now = badness(star.cells(), x);
  double way = kFirstWay * star.shortest_edge();
  for (int tried = 0, halvings = 0; tried < kMostWays && halvings < kMostHalvings; ++tried) {
    if (!(now.worst > kBad)) break;
    const Vec3 next = x - way * now.gradient.normalized();
    const Badness there = badness(star.cells(), next);
    if (there.sum < now.sum) {
      x = next;
      now = there;
    } else {
      way *= 0.5;
      ++halvings;
    }
  }
  return x;
}

}  // namespace

void smooth_cells(TetMesh& mesh) {
  const CellField<char> are_on = cells_on_interfaces(mesh);
  Star star(mesh, are_on);
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (TetVertexId v = first_free_vertex(mesh); v.value < mesh.num_vertices(); ++v.value) {
      star.look_from(v);
      mesh.x[v] = improved(star, mesh.x[v]);
    }
}

}  // namespace meniscus
