#include "meniscus/surface/repair/tube_faces.hpp"

#include <algorithm>
#include <limits>

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

/// One of the curves, from one of its vertices on and back to it.
class ClosedWalk {
 public:
  ClosedWalk(std::span<const VertexId> curve, std::size_t start, bool is_backward)
      : curve_(curve), start_(start), is_backward_(is_backward) {}
  [[nodiscard]] std::size_t size() const { return curve_.size(); }
  [[nodiscard]] VertexId operator[](std::size_t k) const {
    const std::size_t n = curve_.size(), step = k % n;
    return curve_[is_backward_ ? (start_ + n - step) % n : (start_ + step) % n];
  }

 private:
  std::span<const VertexId> curve_;
  std::size_t start_;
  bool is_backward_;
};

struct Start {
  std::size_t a = 0, b = 0;
};
Start shortest_line(const SurfaceMesh& mesh, std::span<const VertexId> a,
                    std::span<const VertexId> b) {
  Start best;
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) {
      const double length = (mesh.x[a[i]] - mesh.x[b[j]]).squaredNorm();
      if (length >= shortest) continue;
      shortest = length;
      best = {i, j};
    }
  return best;
}

}  // namespace

std::vector<FaceVertices> tube_faces(const SurfaceMesh& mesh, std::span<const VertexId> a,
                                     std::span<const VertexId> b) {
  // With the discs on their left the curves run opposite ways around the tube.
  MENISCUS_ASSERT(a.size() >= 3 && b.size() >= 3, "curves of {} and {}", a.size(), b.size());
  const Start start = shortest_line(mesh, a, b);
  const ClosedWalk p(a, start.a, false), q(b, start.b, true);
  const std::size_t m = p.size(), n = q.size();
  const auto length = [&](std::size_t i, std::size_t j) {
    return (mesh.x[p[i]] - mesh.x[q[j]]).squaredNorm();
  };
  // cost[i][j]: least sum of the lines up to that from p[i] to q[j]. Neither end of a line is half
  // a turn or more ahead of the other. One that stays while the other goes all the way around would
  // begin and end with the same line. The tube would then have it twice.
  const auto is_ahead = [&](std::size_t i, std::size_t j) {
    return 2 * std::max(i * n, j * m) >= 2 * std::min(i * n, j * m) + m * n;
  };
  constexpr double kNever = std::numeric_limits<double>::infinity();
  std::vector<double> cost((m + 1) * (n + 1), kNever);
  const auto at = [&](std::size_t i, std::size_t j) -> double& { return cost[i * (n + 1) + j]; };
  at(0, 0) = 0.0;
  for (std::size_t i = 0; i <= m; ++i)
    for (std::size_t j = 0; j <= n; ++j) {
      if ((i == 0 && j == 0) || is_ahead(i, j)) continue;
      const double before = std::min(i > 0 ? at(i - 1, j) : kNever, j > 0 ? at(i, j - 1) : kNever);
      at(i, j) = before + length(i, j);
    }
  std::vector<FaceVertices> faces;
  for (std::size_t i = m, j = n; i > 0 || j > 0;) {
    const bool is_along_p = j == 0 || (i > 0 && at(i - 1, j) <= at(i, j - 1));
    if (is_along_p) {
      faces.push_back({p[i - 1], p[i], q[j]});
      --i;
    } else {
      faces.push_back({q[j], q[j - 1], p[i]});
      --j;
    }
  }
  std::ranges::reverse(faces);
  MENISCUS_ASSERT(faces.size() == m + n, "{} faces between {} and {}", faces.size(), m, n);
  return faces;
}

}  // namespace meniscus
