#pragma once

#include <utility>
#include <vector>

#include "meniscus/mesh/carried_fields.hpp"

namespace meniscus {

/// The values that a field had, from the least to the largest.
struct FieldRange {
  double low = 0.0, high = 0.0;
};

/// Elements that share an amount: all of one kind on one closed surface.
template <class IdType>
struct Shares {
  Field<IdType, double> measure;                 ///< [R0²], positive
  std::vector<std::pair<IdType, IdType>> links;  ///< pairs of elements beside each other
  Field<IdType, int> piece;                      ///< number of the connected piece that has it
  int num_pieces = 0;
};
/// The numbers of the connected pieces of a surface, by vertex, and how many there are.
struct VertexPieces {
  VertexField<int> piece;
  int count = 0;
};
[[nodiscard]] VertexPieces vertex_pieces(const SurfaceMesh& mesh, const SurfaceTopology& topology);
[[nodiscard]] Shares<VertexId> vertex_shares(const SurfaceMesh& mesh);
[[nodiscard]] Shares<FaceId> face_shares(const SurfaceMesh& mesh);

/// Changes values so that Σ value · measure over each piece is that of `amounts`, and near each
/// place as well. What is missing is evened out over a few elements before they take it. Values
/// stay in the range as long as the piece has room. Returns by how much they leave it.
template <class IdType>
FieldExcess keep_amounts(Field<IdType, double>& values, const Field<IdType, double>& amounts,
                         const Shares<IdType>& shares, const FieldRange& range);

/// Gives `values` the amounts that are `missing` at the elements, as `keep_amounts` does. In the
/// end Σ value · measure over each piece is `amount_of_piece`.
template <class IdType>
FieldExcess keep_amounts(Field<IdType, double>& values, Field<IdType, double> missing,
                         const std::vector<double>& amount_of_piece, const Shares<IdType>& shares,
                         const FieldRange& range);

}  // namespace meniscus
