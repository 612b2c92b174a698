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
  return geometry;
}

}  // namespace meniscus::bem
