#include "meniscus/transport/bulk/adsorption.hpp"

#include <algorithm>
#include <cmath>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/face_elements.hpp"
#include "meniscus/scene/interface_tension.hpp"
#include "meniscus/transport/vertex_vectors.hpp"

namespace meniscus::bulk {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// What is given at the vertices, at the first `count` nodes of a surface.
std::vector<double> at_nodes(const CarrierSurface& surface, const VertexField<double>& values,
                             std::size_t count) {
  const Eigen::VectorXd all = surface.interpolation() * vector_of(values);
  return {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace

InterfaceExchange::InterfaceExchange(const ScalarMotion& motion, const NodePositions& positions,
                                     std::size_t k)
    : sides_(motion.end.interfaces.size()), start_(sides_.size()), end_(sides_.size()) {
  const Scene& scene = motion.end;
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const Interface& interface = scene.interfaces[i];
    if (!interface.surfactant || !interface.surfactant->adsorption ||
        at(interface.surfactant->adsorption->species) != k)
      continue;
    const Adsorption& law = *interface.surfactant->adsorption;
    const fem::FaceNodeTable& faces = motion.space.interfaces[i];
    const SurfaceShape shape =
        faces.nodes_per_face == 3 ? SurfaceShape::faceted : SurfaceShape::patched;
    Side& side = sides_[i].emplace(
        Side{.biot = law.biot,
             .adsorption = law.constant * scene.liquids[interface.outside].scalars[k].capacity,
             .depth = law.depth,
             .packing = 1.0 / packing_limit(interface.surfactant->state),
             .at_start = CarrierSurface(motion.start.interfaces[i].mesh, shape),
             .at_end = CarrierSurface(interface.mesh, shape)});
    set_nodes(side, motion.space, faces, positions);
    is_empty_ = false;
    is_linear_ = is_linear_ && side.packing == 0.0;
    VertexField<double> carried = *surfactant_concentration(interface);
    for (const VertexId v : carried.ids())
      carried[v] -= motion.duration * motion.expected_adsorption[i][v];
    const std::size_t count = side.in_space.size();
    start_[i] =
        at_nodes(side.at_start, *surfactant_concentration(motion.start.interfaces[i]), count);
    end_[i] = at_nodes(side.at_end, carried, count);
  }
}

void InterfaceExchange::set_nodes(Side& side, const ScalarSpace& space,
                                  const fem::FaceNodeTable& faces, const NodePositions& positions) {
  const CarrierSurface& surface = side.at_end;
  const bool has_middles = faces.nodes_per_face == kQuadraticNodes;
  side.in_space.resize(at(has_middles ? static_cast<std::int32_t>(surface.interpolation().rows())
                                      : surface.mesh().num_vertices()));
  for (const FaceId f : faces.faces()) {
    const auto nodes = faces.of(f);
    const CarrierSurface::FaceNodes& of_carrier = surface.nodes(f);
    for (std::size_t n = 0; n < nodes.size(); ++n)
      side.in_space[at(of_carrier[n])] = at(nodes[n].value);
    Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(nodes.size(), nodes.size());
    const fem::FacePoints points = fem::face_points(positions.x, nodes);
    for (std::size_t q = 0; q < points.size(); ++q) {
      const double area = points[q].area.norm();
      const Eigen::Map<const Eigen::VectorXd> value(points[q].value.data(), mass.rows());
      mass += area * value * value.transpose();
    }
    for (std::size_t r = 0; r < nodes.size(); ++r)
      for (std::size_t n = 0; n < nodes.size(); ++n)
        side.entries.push_back({place_of(space.graph, nodes[r], nodes[n]), at(nodes[r].value),
                                at(of_carrier[n]),
                                mass(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(n))});
  }
}

ByInterface InterfaceExchange::carried(double share) const {
  ByInterface result = start_;
  for (std::size_t i = 0; i < result.size(); ++i)
    for (std::size_t n = 0; n < result[i].size(); ++n)
      result[i][n] += share * (end_[i][n] - start_[i][n]);
  return result;
}

/// ∂j/∂T in a stage.
double InterfaceExchange::slope(const Side& side, double stage, double guess) const {
  return side.biot * side.adsorption * (1.0 - side.packing * guess) / (1.0 + stage * side.biot);
}

void InterfaceExchange::add_to(MatrixValues& system, std::vector<double>& right, double stage,
                               const ByInterface& begin, const ByInterface& guess) const {
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    if (!sides_[i]) continue;
    const Side& side = *sides_[i];
    for (const Entry& entry : side.entries) {
      const double part = stage * side.depth * entry.value;
      system[entry.place] += part * slope(side, stage, guess[i][entry.node]);
      right[entry.row] += part * side.biot * begin[i][entry.node] / (1.0 + stage * side.biot);
    }
  }
}

ByInterface InterfaceExchange::rates(std::span<const double> T, double stage,
                                     const ByInterface& begin, const ByInterface& guess) const {
  ByInterface result(sides_.size());
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    if (!sides_[i]) continue;
    const Side& side = *sides_[i];
    for (std::size_t n = 0; n < begin[i].size(); ++n)
      result[i].push_back(slope(side, stage, guess[i][n]) * T[side.in_space[n]] -
                          side.biot * begin[i][n] / (1.0 + stage * side.biot));
  }
  return result;
}

VertexField<double> InterfaceExchange::uptake(const Side& side, const std::vector<double>& rates) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(side.at_end.mesh().num_vertices());
  for (const CarrierSurface* surface : {&side.at_start, &side.at_end}) {
    const bool has_middles = std::ssize(rates) == surface->interpolation().rows();
    const FaceField<CarrierSurface::NodeMatrix> masses = surface->masses();
    Eigen::VectorXd amounts = Eigen::VectorXd::Zero(surface->interpolation().rows());
    for (const FaceId f : masses.ids()) {
      const CarrierSurface::FaceNodes& nodes = surface->nodes(f);
      Eigen::Vector<double, kQuadraticNodes> here;
      for (std::size_t n = 0; n < kQuadraticNodes; ++n)
        here[static_cast<Eigen::Index>(n)] =
            n < 3 || has_middles ? rates[at(nodes[n])]
                                 : 0.5 * (rates[at(nodes[n - 3])] + rates[at(nodes[(n - 2) % 3])]);
      amounts(nodes) += masses[f] * here;
    }
    sum += 0.5 * surface->interpolation().transpose() * amounts;
  }
  return field_of(sum);
}

std::vector<VertexField<double>> InterfaceExchange::uptake(const ByInterface& rates) const {
  std::vector<VertexField<double>> result(sides_.size());
  for (std::size_t i = 0; i < sides_.size(); ++i)
    if (sides_[i]) result[i] = uptake(*sides_[i], rates[i]);
  return result;
}

double InterfaceExchange::loss(std::span<const VertexField<double>> uptake) const {
  double total = 0.0;
  for (std::size_t i = 0; i < uptake.size(); ++i)
    for (const double each : uptake[i]) total += sides_[i]->depth * each;
  return total;
}

}  // namespace meniscus::bulk
