#include "meniscus/flow/fem/drop_sections.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>

#include "meniscus/core/error.hpp"

namespace meniscus::fem {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

struct Edge {
  double length;
};
using EdgeGraph =
    boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, Edge,
                                       boost::no_property, std::int32_t, std::int32_t>;

/// The edges of some cells; one between two of them is there twice.
template <class IsTaken>
EdgeGraph edges_of(const TetMesh& mesh, IsTaken is_taken) {
  std::vector<std::pair<std::int32_t, std::int32_t>> ends;
  std::vector<Edge> edges;
  for (const CellId c : mesh.cells.ids()) {
    if (!is_taken(c)) continue;
    for (const TetVertexId a : mesh.cells[c])
      for (const TetVertexId b : mesh.cells[c])
        if (a != b) {
          ends.emplace_back(a.value, b.value);
          edges.push_back({(mesh.x[a] - mesh.x[b]).norm()});
        }
  }
  return {boost::edges_are_unsorted_multi_pass, ends.begin(), ends.end(), edges.begin(),
          mesh.num_vertices()};
}

/// How far vertices are from the nearest of some sources along edges, and which comes before each.
struct Paths {
  std::vector<double> distance;
  std::vector<std::int32_t> before;
};

Paths shortest_paths(const EdgeGraph& graph, const std::vector<std::int32_t>& sources) {
  const std::size_t count = boost::num_vertices(graph);
  Paths paths{std::vector<double>(count), std::vector<std::int32_t>(count)};
  const auto index = boost::get(boost::vertex_index, graph);
  boost::dijkstra_shortest_paths(graph, sources.begin(), sources.end(),
                                 boost::make_iterator_property_map(paths.before.begin(), index),
                                 boost::make_iterator_property_map(paths.distance.begin(), index),
                                 boost::get(&Edge::length, graph), index, std::less<>(),
                                 std::plus<>(), kFar, 0.0, boost::default_dijkstra_visitor());
  return paths;
}

struct Body {
  std::vector<std::int32_t> vertices;
  Vec3 centroid = Vec3::Zero();
  double radius = 0.0;  ///< of the sphere of its volume
};

Body body_of(const TetMesh& mesh, RegionId region) {
  Body body;
  std::vector<char> is_in(static_cast<std::size_t>(mesh.num_vertices()), 0);
  double volume = 0.0;
  for (const CellId c : mesh.cells.ids()) {
    if (mesh.region[c] != region) continue;
    const double cell_volume = signed_volume(mesh, c);
    volume += cell_volume;
    for (const TetVertexId v : mesh.cells[c]) {
      is_in[static_cast<std::size_t>(v.value)] = 1;
      body.centroid += 0.25 * cell_volume * mesh.x[v];
    }
  }
  for (const TetVertexId v : mesh.x.ids())
    if (is_in[static_cast<std::size_t>(v.value)] != 0) body.vertices.push_back(v.value);
  MENISCUS_ASSERT(!body.vertices.empty(), "region {} has no cells", region.value);
  body.centroid /= volume;
  body.radius = std::cbrt(3.0 / (4.0 * std::numbers::pi) * volume);
  return body;
}

/// Distances from the centres of sections, by section. The first centre is the vertex nearest to
/// the centroid, each other one the vertex farthest from those before.
struct Spread {
  std::vector<std::vector<double>> distance;
  double reach = kFar;  ///< of the vertex farthest from its nearest centre
};

Spread spread_centres(const TetMesh& mesh, const Body& body, const EdgeGraph& inside, int most) {
  constexpr double kReach = 1.5;  // of the radius
  std::int32_t centre = *std::ranges::min_element(body.vertices, {}, [&](std::int32_t v) {
    return (mesh.x[TetVertexId{v}] - body.centroid).squaredNorm();
  });
  Spread spread;
  std::vector<double> nearest(static_cast<std::size_t>(mesh.num_vertices()), kFar);
  while (static_cast<int>(spread.distance.size()) < most && spread.reach > kReach * body.radius) {
    spread.distance.push_back(shortest_paths(inside, {centre}).distance);
    spread.reach = 0.0;
    for (const std::int32_t v : body.vertices) {
      double& distance = nearest[static_cast<std::size_t>(v)];
      distance = std::min(distance, spread.distance.back()[static_cast<std::size_t>(v)]);
      if (distance > spread.reach) spread.reach = distance, centre = v;
    }
  }
  return spread;
}

/// Hats about the centres that overlap and sum to one in the body.
std::vector<VertexWeights> hats(const Body& body, const Spread& spread, std::int32_t num_vertices) {
  const double base = 1.5 * spread.reach;
  std::vector<VertexWeights> weights(spread.distance.size(), VertexWeights(num_vertices, 0.0));
  for (const std::int32_t v : body.vertices) {
    double sum = 0.0;
    for (std::size_t s = 0; s < weights.size(); ++s)
      sum += weights[s][TetVertexId{v}] =
          std::max(0.0, 1.0 - spread.distance[s][static_cast<std::size_t>(v)] / base);
    for (VertexWeights& each : weights) each[TetVertexId{v}] /= sum;
  }
  return weights;
}

/// Goes on with the weights outside the body: those of the nearest vertex of the body, less and
/// less.
void fade(const Body& body, const EdgeGraph& around, std::vector<VertexWeights>& weights) {
  const Paths paths = shortest_paths(around, body.vertices);
  const auto distance = [&](std::int32_t v) { return paths.distance[static_cast<std::size_t>(v)]; };
  std::vector<std::int32_t> outward(paths.distance.size());
  std::iota(outward.begin(), outward.end(), 0);
  std::erase_if(outward,
                [&](std::int32_t v) { return distance(v) == 0.0 || distance(v) >= body.radius; });
  std::ranges::stable_sort(outward, {}, distance);
  for (VertexWeights& each : weights) {
    for (const std::int32_t v : outward)
      each[TetVertexId{v}] = each[TetVertexId{paths.before[static_cast<std::size_t>(v)]}];
    for (const std::int32_t v : outward) each[TetVertexId{v}] *= 1.0 - distance(v) / body.radius;
  }
}

}  // namespace

std::vector<VertexWeights> sections(const TetMesh& mesh, RegionId region, int most) {
  const Body body = body_of(mesh, region);
  const EdgeGraph inside = edges_of(mesh, [&](CellId c) { return mesh.region[c] == region; }),
                  around = edges_of(mesh, [&](CellId c) { return mesh.region[c] != region; });
  const Spread spread = spread_centres(mesh, body, inside, most);
  std::vector<VertexWeights> weights = hats(body, spread, mesh.num_vertices());
  fade(body, around, weights);
  return weights;
}

}  // namespace meniscus::fem
