#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "meniscus/core/fault.hpp"
#include "meniscus/core/field.hpp"
#include "meniscus/core/vec.hpp"

namespace meniscus {

using VertexId = Id<struct VertexTag>;
using FaceId = Id<struct FaceTag>;
template <class T>
using VertexField = Field<VertexId, T>;
template <class T>
using FaceField = Field<FaceId, T>;
using FaceVertices = std::array<VertexId, 3>;

/// A triangulated surface: positions and faces, nothing derived. Faces are counter-clockwise seen
/// from outside, so that (x1 − x0) × (x2 − x0) points out of the enclosed liquid.
/// A value: copying it is how a step is undone.
struct SurfaceMesh {
  VertexField<Vec3> x;  ///< positions, |V| × 3 [R0]
  FaceField<FaceVertices> faces;

  [[nodiscard]] std::int32_t num_vertices() const { return x.size(); }
  [[nodiscard]] std::int32_t num_faces() const { return faces.size(); }
  friend bool operator==(const SurfaceMesh&, const SurfaceMesh&) = default;
};

struct SurfaceEdge {
  VertexId a, b;       ///< a < b
  FaceId left, right;  ///< left runs a → b, right runs b → a
  VertexId left_opposite, right_opposite;
};

/// Edges and rings of a closed, oriented, manifold surface. Linear to build; it holds no positions,
/// so it stays true while vertices move.
class SurfaceTopology {
 public:
  /// Throws InvalidInput naming an edge when the faces are not a closed oriented manifold.
  explicit SurfaceTopology(const SurfaceMesh& mesh);
  /// The topology of a mesh, or the place where its faces are no closed oriented manifold.
  [[nodiscard]] static std::variant<SurfaceTopology, Fault> try_build(const SurfaceMesh& mesh);

  [[nodiscard]] std::span<const SurfaceEdge> edges() const { return edges_; }
  /// Neighbours of v counter-clockwise seen from outside; the k-th face lies between the k-th and
  /// the (k+1)-th neighbour.
  [[nodiscard]] std::span<const VertexId> ring(VertexId v) const;
  [[nodiscard]] std::span<const FaceId> faces_around(VertexId v) const;
  [[nodiscard]] std::int32_t valence(VertexId v) const {
    return static_cast<std::int32_t>(ring(v).size());
  }

 private:
  SurfaceTopology() = default;
  [[nodiscard]] std::optional<Fault> add_edges(const SurfaceMesh& mesh);
  [[nodiscard]] std::optional<Fault> add_rings(const SurfaceMesh& mesh);

  std::vector<SurfaceEdge> edges_;
  std::vector<std::int32_t> first_;  // ring of v: [first_[v], first_[v + 1])
  std::vector<VertexId> ring_;
  std::vector<FaceId> around_;
};

/// Where the faces are not a closed oriented manifold.
[[nodiscard]] std::optional<Fault> find_broken_connectivity(const SurfaceMesh& mesh);

}  // namespace meniscus
