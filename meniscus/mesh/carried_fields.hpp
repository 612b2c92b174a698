#pragma once

#include <string>
#include <vector>

#include "meniscus/mesh/tet_mesh.hpp"

namespace meniscus {

/// How the values of a field follow when the mesh under them moves or is replaced.
enum class FieldTransfer {
  interpolated,  ///< values ride on moving vertices and never leave their old range
  conserved      ///< Σ value · measure stays, region by region and interface by interface
};

/// A field of doubles that lives on elements of one kind and is carried by what changes the mesh.
template <class IdType>
struct CarriedField {
  std::string name;
  std::string unit;  ///< as docs/notation.md writes it; empty where the field has none
  FieldTransfer transfer = FieldTransfer::interpolated;
  Field<IdType, double> values;

  friend bool operator==(const CarriedField&, const CarriedField&) = default;
};

/// The fields of a surface. On vertices they are linear over the faces, with the integral
/// Σ_v value · (a third of the area of the faces at v). On faces they are means over the face.
struct SurfaceFields {
  std::vector<CarriedField<VertexId>> on_vertices;
  std::vector<CarriedField<FaceId>> on_faces;

  [[nodiscard]] bool empty() const { return on_vertices.empty() && on_faces.empty(); }
  friend bool operator==(const SurfaceFields&, const SurfaceFields&) = default;
};

/// The fields of a volume mesh. On vertices they are linear over the cells and one-valued across
/// interfaces; only interpolated ones may live there. On cells they are means over the cell.
struct VolumeFields {
  std::vector<CarriedField<TetVertexId>> on_vertices;
  std::vector<CarriedField<CellId>> on_cells;

  [[nodiscard]] bool empty() const { return on_vertices.empty() && on_cells.empty(); }
  friend bool operator==(const VolumeFields&, const VolumeFields&) = default;
};

/// What a transfer could not keep: by how much values left the range they had before, because a
/// measure changed and the amount was kept.
struct FieldExcess {
  double above = 0.0, below = 0.0;  ///< ≥ 0, over all fields, in the unit of the worst one
};

/// Throws InvalidInput naming the field that has a wrong length, a value that is not finite, an
/// earlier one's name, or none. On the vertices of a volume mesh no field may be conserved.
void check_fields(const SurfaceFields& fields, const SurfaceMesh& mesh);
void check_fields(const VolumeFields& fields, const TetMesh& mesh);

}  // namespace meniscus
