#include "meniscus/flow/bem/boundary_geometry.hpp"

#include <utility>

#include "meniscus/core/error.hpp"
#include "meniscus/scene/interface_tension.hpp"

namespace meniscus::bem {
namespace {

std::vector<bool> enclosing(const Scene& scene, const Interface& interface) {
  std::vector<bool> result(scene.interfaces.size(), false);
  for (RegionId r = interface.outside; r != RegionId{0};) {
    const auto around = static_cast<std::size_t>(r.value - 1);
    MENISCUS_ASSERT(around < result.size() && !result[around], "region {}", r.value);
    result[around] = true;
    r = scene.interfaces[around].outside;
  }
  return result;
}

/// Where the nodes are, and the areas that they have of all faces.
void place_nodes(BoundaryGeometry& geometry, std::int32_t num_nodes) {
  SourceVectors x(num_nodes), area(num_nodes);
  for (std::size_t m = 0; m < geometry.surfaces.size(); ++m) {
    const InterfaceElements& elements = geometry.surfaces[m].elements;
    for (const FaceId f : elements.faces.ids()) {
      const auto nodes = geometry.nodes_of(m, f);
      for (std::size_t a = 0; a < nodes.size(); ++a) {
        x.set(nodes[a], elements.faces[f].nodes[a]);
        area.set(nodes[a], area.at(nodes[a]) + elements.faces[f].area[a]);
      }
    }
  }
  for (std::int32_t node = 0; node < num_nodes; ++node)
    geometry.nodes.add(x.at(node), area.at(node));
}

}  // namespace

BoundaryGeometry make_geometry(const Scene& scene) {
  BoundaryGeometry geometry;
  std::int32_t num_nodes = 0;
  for (const Interface& interface : scene.interfaces) {
    BoundaryGeometry::Surface& surface =
        geometry.surfaces.emplace_back(make_elements(interface.mesh), SurfaceTree(interface.mesh));
    surface.is_inside_of = enclosing(scene, interface);
    surface.range.begin = num_nodes;
    num_nodes += interface.mesh.num_vertices();
    surface.range.end = num_nodes;
    geometry.surface_of.resize(static_cast<std::size_t>(num_nodes),
                               static_cast<std::int32_t>(geometry.surfaces.size()) - 1);
  }
  for (BoundaryGeometry::Surface& surface : geometry.surfaces) {
    surface.middles.begin = num_nodes;
    num_nodes += static_cast<std::int32_t>(surface.elements.middles.size());
    surface.middles.end = num_nodes;
  }
  place_nodes(geometry, num_nodes);
  return geometry;
}

std::array<std::int32_t, kQuadraticNodes> BoundaryGeometry::nodes_of(std::size_t surface,
                                                                     FaceId f) const {
  const Surface& of = surfaces[surface];
  std::array<std::int32_t, kQuadraticNodes> numbers{};
  for (std::size_t k = 0; k < 3; ++k) {
    numbers[k] = index(surface, of.elements.corners[f][k]);
    numbers[3 + k] = of.middles.begin + static_cast<std::int32_t>(of.elements.edges[f][k]);
  }
  return numbers;
}

std::vector<double> BoundaryGeometry::at_nodes(std::vector<double> values) const {
  MENISCUS_ASSERT(values.size() == surface_of.size(), "{} values of {} points", values.size(),
                  size());
  values.reserve(nodes.x.size());
  for (std::size_t m = 0; m < surfaces.size(); ++m)
    for (const Stencil& stencil : surfaces[m].elements.middles) {
      double sum = 0.0;
      for (const VertexWeight& w : stencil)
        sum += w.weight * values[static_cast<std::size_t>(index(m, w.vertex))];
      values.push_back(sum);
    }
  return values;
}

SourceVectors BoundaryGeometry::at_nodes(SourceVectors values) const {
  for (std::vector<double>* component : {&values.x, &values.y, &values.z})
    *component = at_nodes(std::move(*component));
  return values;
}

SourceVectors BoundaryGeometry::to_points(SourceVectors forces) const {
  for (std::size_t m = 0; m < surfaces.size(); ++m) {
    std::int32_t node = surfaces[m].middles.begin;
    for (const Stencil& stencil : surfaces[m].elements.middles) {
      const Vec3 force = forces.at(node++);
      for (const VertexWeight& w : stencil) {
        const std::int32_t i = index(m, w.vertex);
        forces.set(i, forces.at(i) + w.weight * force);
      }
    }
  }
  forces.resize(size());
  return forces;
}

NodeValues BoundaryGeometry::on_face(std::size_t surface, FaceId f,
                                     const std::vector<double>& at_nodes) const {
  NodeValues values{};
  const auto numbers = nodes_of(surface, f);
  for (std::size_t a = 0; a < numbers.size(); ++a)
    values[a] = at_nodes[static_cast<std::size_t>(numbers[a])];
  return values;
}

std::vector<double> tension_at_points(const Scene& scene) {
  std::vector<double> tension;
  for (const Interface& interface : scene.interfaces)
    for (const double sigma : vertex_tension(interface)) tension.push_back(sigma);
  return tension;
}

}  // namespace meniscus::bem
