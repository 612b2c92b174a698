#include "meniscus/transport/bulk/adsorption.hpp"

#include <algorithm>
#include <cmath>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/face_elements.hpp"
#include "meniscus/scene/interface_tension.hpp"

namespace meniscus::bulk {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

std::size_t place_of(const fem::NodeGraph& graph, NodeId row, NodeId column) {
  const auto begin = graph.columns.begin() + graph.row_start[at(row.value)],
             end = graph.columns.begin() + graph.row_start[at(row.value) + 1];
  const auto found = std::lower_bound(begin, end, column.value);
  MENISCUS_ASSERT(found != end && *found == column.value, "no entry {}, {}", row.value,
                  column.value);
  return static_cast<std::size_t>(found - graph.columns.begin());
}

}  // namespace

InterfaceExchange::InterfaceExchange(const ScalarMotion& motion, const NodePositions& positions,
                                     std::size_t k)
    : sides_(motion.end.interfaces.size()), start_(sides_.size()), end_(sides_.size()) {
  const Scene& scene = motion.end;
  const ScalarSpace& space = motion.space;
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const Interface& interface = scene.interfaces[i];
    if (!interface.surfactant || !interface.surfactant->adsorption ||
        at(interface.surfactant->adsorption->species) != k)
      continue;
    const Adsorption& law = *interface.surfactant->adsorption;
    Side& side = sides_[i];
    side.biot = law.biot;
    side.adsorption = law.constant * scene.liquids[interface.outside].scalars[k].capacity;
    side.depth = law.depth;
    side.packing = 1.0 / packing_limit(interface.surfactant->state);
    is_empty_ = false;
    is_linear_ = is_linear_ && side.packing == 0.0;
    start_[i] = *surfactant_concentration(motion.start.interfaces[i]);
    end_[i] = *surfactant_concentration(interface);
    for (const VertexId v : end_[i].ids())
      end_[i][v] -= motion.duration * motion.expected_adsorption[i][v];
    const fem::FaceNodeTable& faces = space.interfaces[i];
    side.node.resize(at(interface.mesh.num_vertices()));
    for (const FaceId f : faces.faces()) {
      const auto nodes = faces.of(f);
      const FaceVertices& vertices = interface.mesh.faces[f];
      for (std::size_t v = 0; v < 3; ++v) side.node[at(vertices[v].value)] = at(nodes[v].value);
      Mat3 mass = Mat3::Zero();
      const fem::FacePoints points = fem::face_points(positions.x, nodes);
      for (std::size_t v = 0; v < 3; ++v)
        for (std::size_t n = 0; n < nodes.size(); ++n) {
          double value = 0.0;
          for (std::size_t q = 0; q < points.size(); ++q)
            value += points[q].area.norm() * points[q].value[n] * kTriangleRule6[q].barycentric[v];
          side.entries.push_back(
              {place_of(space.graph, nodes[n], nodes[v]), at(nodes[n].value), vertices[v], value});
        }
      for (std::size_t q = 0; q < points.size(); ++q)
        for (std::size_t v = 0; v < 3; ++v)
          for (std::size_t w = 0; w < 3; ++w)
            mass(static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(w)) +=
                points[q].area.norm() * kTriangleRule6[q].barycentric[v] *
                kTriangleRule6[q].barycentric[w];
      side.faces.push_back(vertices);
      side.masses.push_back(mass);
    }
  }
}

ByInterface InterfaceExchange::carried(double share) const {
  ByInterface result = start_;
  for (std::size_t i = 0; i < result.size(); ++i)
    for (const VertexId v : result[i].ids()) result[i][v] += share * (end_[i][v] - start_[i][v]);
  return result;
}

/// ∂j/∂T in a stage.
double InterfaceExchange::slope(const Side& side, double stage, double guess) const {
  return side.biot * side.adsorption * (1.0 - side.packing * guess) / (1.0 + stage * side.biot);
}

void InterfaceExchange::add_to(MatrixValues& system, std::vector<double>& right, double stage,
                               const ByInterface& begin, const ByInterface& guess) const {
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const Side& side = sides_[i];
    for (const Entry& entry : side.entries) {
      const double part = stage * side.depth * entry.value;
      system[entry.place] += part * slope(side, stage, guess[i][entry.vertex]);
      right[entry.node] += part * side.biot * begin[i][entry.vertex] / (1.0 + stage * side.biot);
    }
  }
}

ByInterface InterfaceExchange::rates(std::span<const double> T, double stage,
                                     const ByInterface& begin, const ByInterface& guess) const {
  ByInterface result(sides_.size());
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const Side& side = sides_[i];
    for (const VertexId v : begin[i].ids())
      result[i].add(slope(side, stage, guess[i][v]) * T[side.node[at(v.value)]] -
                    side.biot * begin[i][v] / (1.0 + stage * side.biot));
  }
  return result;
}

ByInterface InterfaceExchange::uptake(const ByInterface& rates) const {
  ByInterface result(sides_.size());
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    result[i] = VertexField<double>(rates[i].size(), 0.0);
    for (std::size_t f = 0; f < sides_[i].faces.size(); ++f)
      for (std::size_t v = 0; v < 3; ++v)
        for (std::size_t w = 0; w < 3; ++w)
          result[i][sides_[i].faces[f][v]] +=
              sides_[i].masses[f](static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(w)) *
              rates[i][sides_[i].faces[f][w]];
  }
  return result;
}

double InterfaceExchange::loss(const ByInterface& rates) const {
  const ByInterface taken = uptake(rates);
  double total = 0.0;
  for (std::size_t i = 0; i < sides_.size(); ++i)
    for (const double each : taken[i]) total += sides_[i].depth * each;
  return total;
}

}  // namespace meniscus::bulk
