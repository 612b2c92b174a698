#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "meniscus/core/field.hpp"
#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus {

using TetVertexId = Id<struct TetVertexTag>;
using CellId = Id<struct CellTag>;
using RegionId = Id<struct RegionTag>;  ///< a connected body of one liquid: what an interface
                                        ///< encloses, or the matrix
template <class T>
using CellField = Field<CellId, T>;
using CellVertices = std::array<TetVertexId, 4>;

/// A triangulated surface that is part of a tetrahedral mesh. Its vertex v is the mesh vertex
/// `first_vertex + v`. Its face f is a facet of the two cells named here.
struct EmbeddedSurface {
  struct Sides {
    CellId inside, outside;  ///< `outside` is invalid on the outer boundary
  };
  TetVertexId first_vertex;
  std::int32_t num_vertices = 0;
  FaceField<Sides> sides;

  [[nodiscard]] TetVertexId vertex(VertexId v) const { return {first_vertex.value + v.value}; }
};

/// A tetrahedral mesh of all regions whose facets include every face of every embedded surface.
/// Vertices: those of interface 0, 1, …, then those of the outer boundary (`boundary`), then the
/// points between. Cells have positive volume det[x1 − x0, x2 − x0, x3 − x0]/6.
struct TetMesh {
  Field<TetVertexId, Vec3> x;  ///< positions [R0]
  CellField<CellVertices> cells;
  CellField<RegionId> region;
  std::vector<EmbeddedSurface> interfaces;  ///< in the order of Scene::interfaces
  EmbeddedSurface boundary;

  [[nodiscard]] std::int32_t num_vertices() const { return x.size(); }
  [[nodiscard]] std::int32_t num_cells() const { return cells.size(); }
};

/// The first of the vertices between the surfaces.
[[nodiscard]] inline TetVertexId first_free_vertex(const TetMesh& mesh) {
  return {mesh.boundary.first_vertex.value + mesh.boundary.num_vertices};
}
[[nodiscard]] double signed_volume(const TetMesh& mesh, CellId c);
[[nodiscard]] double shortest_edge(const TetMesh& mesh);

}  // namespace meniscus
