#include "meniscus/flow/bem/boundary_geometry.hpp"

#include <cmath>

#include "meniscus/core/error.hpp"

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

}  // namespace

BoundaryGeometry make_geometry(const Scene& scene) {
  BoundaryGeometry geometry;
  for (const Interface& interface : scene.interfaces) {
    BoundaryGeometry::Surface surface{.elements = make_elements(interface.mesh),
                                      .tree = SurfaceTree(interface.mesh),
                                      .range = {},
                                      .first_middle = 0,
                                      .is_inside_of = enclosing(scene, interface)};
    const InterfaceElements& elements = surface.elements;
    surface.range.begin = geometry.size();
    for (const VertexId v : elements.x.ids()) {
      MENISCUS_ASSERT(std::abs(elements.n[v].norm() - 1.0) < 1e-9, "vertex {}", v.value);
      geometry.points.add(elements.x[v], elements.weight[v] * elements.n[v]);
      geometry.surface_of.push_back(static_cast<std::int32_t>(geometry.surfaces.size()));
    }
    surface.range.end = geometry.size();
    geometry.surfaces.push_back(std::move(surface));
  }
  std::int32_t num_nodes = geometry.size();
  for (BoundaryGeometry::Surface& surface : geometry.surfaces) {
    surface.first_middle = num_nodes;
    num_nodes += static_cast<std::int32_t>(surface.elements.middles.size());
  }
  return geometry;
}

std::int32_t BoundaryGeometry::num_nodes() const {
  if (surfaces.empty()) return 0;
  return surfaces.back().first_middle +
         static_cast<std::int32_t>(surfaces.back().elements.middles.size());
}

std::array<std::int32_t, kQuadraticNodes> BoundaryGeometry::nodes(std::size_t surface,
                                                                  FaceId f) const {
  const Surface& of = surfaces[surface];
  std::array<std::int32_t, kQuadraticNodes> nodes{};
  for (std::size_t k = 0; k < 3; ++k) {
    nodes[k] = index(surface, of.elements.corners[f][k]);
    nodes[3 + k] = of.first_middle + static_cast<std::int32_t>(of.elements.edges[f][k]);
  }
  return nodes;
}

SourceVectors BoundaryGeometry::at_nodes(const SourceVectors& at_points) const {
  SourceVectors result = at_points;
  result.resize(num_nodes());
  for (std::size_t m = 0; m < surfaces.size(); ++m) {
    std::int32_t node = surfaces[m].first_middle;
    for (const Stencil& stencil : surfaces[m].elements.middles) {
      Vec3 sum = Vec3::Zero();
      for (const VertexWeight& w : stencil) sum += w.weight * at_points.at(index(m, w.vertex));
      result.set(node++, sum);
    }
  }
  return result;
}

}  // namespace meniscus::bem
