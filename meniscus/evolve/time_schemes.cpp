#include "meniscus/evolve/time_schemes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "meniscus/core/error.hpp"
#include "meniscus/evolve/constants.hpp"

namespace meniscus {
namespace {

VertexField<double> shortest_edges(const SurfaceMesh& mesh) {
  VertexField<double> shortest(mesh.num_vertices(), std::numeric_limits<double>::infinity());
  for (const FaceVertices& face : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = face[k], b = face[(k + 1) % 3];
      const double length = (mesh.x[a] - mesh.x[b]).norm();
      shortest[a] = std::min(shortest[a], length);
      shortest[b] = std::min(shortest[b], length);
    }
  return shortest;
}

}  // namespace

StageFlow euler_step(const StageFlow& first) { return first; }

StageFlow midpoint_step(const StageFlow& first, const Step& step, const StageSolver& solve) {
  const double half = 0.5 * step.dt;
  StageFlow middle =
      solve(first, half, {.t = step.t + half, .dt = step.dt, .stage = Stage::middle});
  if (middle.ok()) middle.error = step_error(step, middle.normal_speed, first.normal_speed);
  return middle;
}

StageFlow semi_implicit_step(const StageFlow& first, const Step& step, const StageSolver& solve) {
  const double half = 0.5 * step.dt;
  Instant instant{.t = step.t,
                  .dt = step.dt,
                  .stage = Stage::start,
                  .damping = {kDampedShare * step.dt, first.shape.rigid}};
  StageFlow start = solve(first, 0.0, instant);
  if (!start.ok()) return start;
  start.motion = mean_motion(step.start, first.shape, start.shape, half);
  instant.t = step.t + half;
  instant.stage = Stage::middle;
  instant.damping.about.clear();  // about the normal speeds of the first stage
  StageFlow middle = solve(start, half, instant);
  if (!middle.ok()) return middle;
  middle.motion = mean_motion(step.start, first.shape, middle.shape, step.dt);
  middle.error = step_error(step, middle.normal_speed, start.normal_speed);
  return middle;
}

double step_error(const Step& step, const NormalSpeeds& second, const NormalSpeeds& first) {
  MENISCUS_ASSERT(first.size() == second.size(), "{} {}", first.size(), second.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < second.size(); ++i) {
    const VertexField<double> edges = shortest_edges(step.start.interfaces[i].mesh);
    for (const VertexId v : edges.ids())
      largest = std::max(largest, step.dt * std::abs(second[i][v] - first[i][v]) / edges[v]);
  }
  return largest;
}

}  // namespace meniscus
