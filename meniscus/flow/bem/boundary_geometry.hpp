#pragma once

#include <vector>

#include "meniscus/flow/bem/interface_elements.hpp"
#include "meniscus/flow/bem/layer_sums.hpp"
#include "meniscus/mesh/surface_tree.hpp"
#include "meniscus/scene/scene.hpp"

namespace meniscus::bem {

/// The interfaces of a scene at one instant, their vertices numbered through as points. These are
/// the places where the equation is required and, with their weights, the sources of the far field.
/// Nodes are the points and then the middles of all edges, surface by surface.
struct BoundaryGeometry {
  struct Surface {
    InterfaceElements elements;
    SurfaceTree tree;
    SourceRange range;
    std::int32_t first_middle = 0;   ///< as a node
    std::vector<bool> is_inside_of;  ///< by interface: does it enclose this one
  };
  std::vector<Surface> surfaces;
  SourcePoints points;
  std::vector<std::int32_t> surface_of;  ///< by point

  [[nodiscard]] std::int32_t size() const { return points.size(); }
  [[nodiscard]] std::int32_t num_nodes() const;
  /// The six nodes of a face.
  [[nodiscard]] std::array<std::int32_t, kQuadraticNodes> nodes(std::size_t surface,
                                                                FaceId f) const;
  /// Vectors given at the points, at all nodes.
  [[nodiscard]] SourceVectors at_nodes(const SourceVectors& at_points) const;
  [[nodiscard]] std::int32_t index(std::size_t surface, VertexId v) const {
    return surfaces[surface].range.begin + v.value;
  }
};

[[nodiscard]] BoundaryGeometry make_geometry(const Scene& scene);

}  // namespace meniscus::bem
