#include "meniscus/report/cell_section.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

namespace meniscus::report {
namespace {

constexpr std::size_t kParts = 4;          // of the edges of a curved cell
constexpr double kStraightAngle = 1e-6;    // radians; a corner that turns less is none
constexpr std::size_t kCode = kParts + 1;  // base of the numbers of lattice points

using Weights = std::array<double, 4>;  // of the corners

/// A point of a cell in its section.
struct Crossing {
  std::array<double, 2> at;
  Weights weights;
};

/// Where the straight line between two points meets the plane; they lie on different sides.
Crossing crossing(const Vec3& xa, const Vec3& xb, const Weights& at_a, const Weights& at_b,
                  const CutPlane& plane) {
  const double share = plane.height(xa) / (plane.height(xa) - plane.height(xb));
  Crossing result{plane.in_plane(xa + share * (xb - xa)), {}};
  for (std::size_t k = 0; k < 4; ++k) result.weights[k] = (1.0 - share) * at_a[k] + share * at_b[k];
  return result;
}

CellSection section_through(const std::vector<Crossing>& crossings) {
  CellSection section;
  for (const Crossing& each : crossings) {
    section.points.push_back(each.at);
    for (std::size_t k = 0; k < 4; ++k)
      section.weights[k] += each.weights[k] / static_cast<double>(crossings.size());
  }
  return section;
}

/// A point on a face of the cell; its place is counted in parts from corner to corner.
struct LatticePoint {
  Vec3 x;
  Weights weights;
  bool is_above = false;
};

using Place = std::array<std::size_t, 4>;  // parts of each corner, their sum kParts

std::size_t number_of(const Place& place) {
  return ((place[0] * kCode + place[1]) * kCode + place[2]) * kCode + place[3];
}

/// The quadratic map of a cell.
Vec3 mapped(const std::array<Vec3, 10>& nodes, const Weights& b) {
  constexpr std::array<std::array<std::size_t, 2>, 6> kEdges = {
      {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
  Vec3 x = Vec3::Zero();
  for (std::size_t k = 0; k < 4; ++k) x += b[k] * (2.0 * b[k] - 1.0) * nodes[k];
  for (std::size_t e = 0; e < 6; ++e) x += 4.0 * b[kEdges[e][0]] * b[kEdges[e][1]] * nodes[4 + e];
  return x;
}

/// Follows a plane around the faces of a curved cell, piece by piece.
class Walk {
 public:
  Walk(const std::array<Vec3, 10>& nodes, const CutPlane& plane) : nodes_(nodes), plane_(plane) {
    // All faces turn the same way, so that each edge is left by one of its pieces.
    constexpr std::array<std::array<std::size_t, 3>, 4> kFaces = {
        {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {0, 2, 3}}};
    for (const auto& face : kFaces) add_face(face);
  }

  /// The closed lines of the section; they are given once.
  [[nodiscard]] std::vector<std::vector<Crossing>> take_loops() {
    std::vector<std::vector<Crossing>> loops;
    while (!next_.empty()) {
      std::vector<Crossing>& loop = loops.emplace_back();
      for (auto link = next_.begin(); link != next_.end();) {
        loop.push_back(at(link->first));
        const Edge end = link->second;
        next_.erase(link);
        link = next_.find(end);
      }
    }
    return loops;
  }

 private:
  using Edge = std::pair<std::size_t, std::size_t>;  // between lattice points, by ascending number

  void add_face(const std::array<std::size_t, 3>& corners) {
    const auto place = [&](std::size_t i, std::size_t j) {
      Place result{};
      result[corners[0]] = kParts - i - j;
      result[corners[1]] = i;
      result[corners[2]] = j;
      return result;
    };
    for (std::size_t i = 0; i < kParts; ++i)
      for (std::size_t j = 0; i + j < kParts; ++j) {
        add_piece({place(i, j), place(i + 1, j), place(i, j + 1)});
        if (i + j + 1 < kParts) add_piece({place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)});
      }
  }

  void add_piece(const std::array<Place, 3>& places) {
    std::array<std::size_t, 3> numbers;
    std::array<bool, 3> is_above;
    for (std::size_t k = 0; k < 3; ++k) {
      numbers[k] = number_of(places[k]);
      is_above[k] = point(places[k]).is_above;
    }
    Edge down, up;
    bool is_cut = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t other = (k + 1) % 3;
      if (is_above[k] == is_above[other]) continue;
      (is_above[k] ? down : up) = std::minmax(numbers[k], numbers[other]);
      is_cut = true;
    }
    if (is_cut) next_[down] = up;
  }

  const LatticePoint& point(const Place& place) {
    const auto [found, is_new] = points_.try_emplace(number_of(place));
    LatticePoint& result = found->second;
    if (!is_new) return result;
    std::ranges::transform(place, result.weights.begin(), [](std::size_t parts) {
      return static_cast<double>(parts) / static_cast<double>(kParts);
    });
    result.x = mapped(nodes_, result.weights);
    result.is_above = plane_.height(result.x) >= 0.0;
    return result;
  }

  [[nodiscard]] Crossing at(const Edge& edge) const {
    const LatticePoint &a = points_.at(edge.first), &b = points_.at(edge.second);
    return crossing(a.x, b.x, a.weights, b.weights, plane_);
  }

  const std::array<Vec3, 10>& nodes_;
  CutPlane plane_;
  std::map<std::size_t, LatticePoint> points_;
  std::map<Edge, Edge> next_;  // from where the section enters a piece to where it leaves
};

double distance(const Crossing& a, const Crossing& b) {
  return std::hypot(b.at[0] - a.at[0], b.at[1] - a.at[1]);
}

/// The points at which a closed line turns. It may go to and fro, and a corner on the plane is many
/// of its points. Each is judged by the neighbours that are left.
std::vector<Crossing> turning_points(std::vector<Crossing> loop) {
  for (std::size_t i = 0, num_turns = 0; num_turns < loop.size();) {
    const std::size_t n = loop.size();
    i %= n;
    const Crossing &before = loop[(i + n - 1) % n], &here = loop[i], &after = loop[(i + 1) % n];
    const double turn = (here.at[0] - before.at[0]) * (after.at[1] - here.at[1]) -
                        (here.at[1] - before.at[1]) * (after.at[0] - here.at[0]);
    if (std::abs(turn) > kStraightAngle * distance(before, here) * distance(here, after)) {
      ++i;
      ++num_turns;
    } else {
      loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(i));
      num_turns = 0;
    }
  }
  return loop;
}

}  // namespace

std::vector<CellSection> section_of(const std::array<Vec3, 4>& corners, const CutPlane& plane) {
  std::vector<std::size_t> above, below;
  for (std::size_t k = 0; k < 4; ++k)
    (plane.height(corners[k]) >= 0.0 ? above : below).push_back(k);
  if (above.empty() || below.empty()) return {};
  std::vector<Crossing> crossings;
  const auto add = [&](std::size_t a, std::size_t b) {
    Weights at_a{}, at_b{};
    at_a[a] = at_b[b] = 1.0;
    crossings.push_back(crossing(corners[a], corners[b], at_a, at_b, plane));
  };
  if (above.size() == 2) {  // in the order round the quadrangle
    add(above[0], below[0]);
    add(above[0], below[1]);
    add(above[1], below[1]);
    add(above[1], below[0]);
  } else {
    for (const std::size_t a : above)
      for (const std::size_t b : below) add(a, b);
  }
  return {section_through(crossings)};
}

std::vector<CellSection> sections_of(const std::array<Vec3, 10>& nodes, const CutPlane& plane) {
  std::vector<CellSection> sections;
  for (const std::vector<Crossing>& loop : Walk(nodes, plane).take_loops())
    if (const std::vector<Crossing> points = turning_points(loop); points.size() > 2)
      sections.push_back(section_through(points));
  return sections;
}

}  // namespace meniscus::report
