#pragma once

#include <vector>

#include "meniscus/flow/bem/interface_elements.hpp"
#include "meniscus/flow/bem/layer_sums.hpp"
#include "meniscus/mesh/surface_tree.hpp"
#include "meniscus/scene/scene.hpp"

namespace meniscus::bem {

/// The interfaces of a scene at one instant, their vertices numbered through as points. These are
/// the places where the equation is required and, with their weights, the sources of the far field.
struct BoundaryGeometry {
  struct Surface {
    InterfaceElements elements;
    SurfaceTree tree;
    SourceRange range;
    std::vector<bool> is_inside_of;  ///< by interface: does it enclose this one
  };
  std::vector<Surface> surfaces;
  SourcePoints points;
  std::vector<std::int32_t> surface_of;  ///< by point

  [[nodiscard]] std::int32_t size() const { return points.size(); }
  [[nodiscard]] std::int32_t index(std::size_t surface, VertexId v) const {
    return surfaces[surface].range.begin + v.value;
  }
};

[[nodiscard]] BoundaryGeometry make_geometry(const Scene& scene);

}  // namespace meniscus::bem
