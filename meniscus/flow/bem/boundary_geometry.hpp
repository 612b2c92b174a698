#pragma once

#include <vector>

#include "meniscus/flow/bem/interface_elements.hpp"
#include "meniscus/flow/bem/layer_sums.hpp"
#include "meniscus/mesh/surface_tree.hpp"
#include "meniscus/scene/scene.hpp"

namespace meniscus::bem {

/// The interfaces of a scene at one instant. Their vertices, numbered through, are the points where
/// the equation is required. Nodes are the points and then the middles of all edges, surface by
/// surface: the sources of the far field.
struct BoundaryGeometry {
  struct Surface {
    InterfaceElements elements;
    SurfaceTree tree;
    SourceRange range, middles;      ///< as nodes
    std::vector<bool> is_inside_of;  ///< by interface: does it enclose this one
  };
  std::vector<Surface> surfaces;
  SourcePoints nodes;                    ///< with the sums of ∫φ_a n dS over their faces
  std::vector<std::int32_t> surface_of;  ///< by point

  [[nodiscard]] std::int32_t size() const { return static_cast<std::int32_t>(surface_of.size()); }
  [[nodiscard]] std::int32_t num_nodes() const { return nodes.size(); }
  /// The six nodes of a face.
  [[nodiscard]] std::array<std::int32_t, kQuadraticNodes> nodes_of(std::size_t surface,
                                                                   FaceId f) const;
  /// Values given at the points, at all nodes.
  [[nodiscard]] std::vector<double> at_nodes(std::vector<double> at_points) const;
  [[nodiscard]] SourceVectors at_nodes(SourceVectors at_points) const;
  /// Forces given at all nodes, at the points: those of middles go where values at them come from.
  [[nodiscard]] SourceVectors to_points(SourceVectors at_nodes) const;
  /// Of values given at all nodes, those of a face.
  [[nodiscard]] NodeValues on_face(std::size_t surface, FaceId f,
                                   const std::vector<double>& at_nodes) const;
  [[nodiscard]] std::int32_t index(std::size_t surface, VertexId v) const {
    return surfaces[surface].range.begin + v.value;
  }
};

[[nodiscard]] BoundaryGeometry make_geometry(const Scene& scene);

/// σ at the points.
[[nodiscard]] std::vector<double> tension_at_points(const Scene& scene);

}  // namespace meniscus::bem
