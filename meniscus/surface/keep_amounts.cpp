#include "meniscus/surface/keep_amounts.hpp"

#include <algorithm>
#include <cmath>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {
namespace {

/// Exchanges with neighbours before what is missing is taken: over some two edges, which evens out
/// how old elements fall on new ones.
constexpr int kExchanges = 6;
/// Rounds in which elements pass on what their range did not let them take: some ten edges in all.
constexpr int kPasses = 20;

template <class IdType>
Field<IdType, int> valences(const Shares<IdType>& shares) {
  Field<IdType, int> valence(shares.measure.size(), 0);
  for (const auto& [a, b] : shares.links) {
    ++valence[a];
    ++valence[b];
  }
  return valence;
}

/// Lets neighbours exchange amounts, as much as one loses as the other gains. An element gives away
/// at most half of what it has, so that nothing oscillates.
template <class IdType>
void exchange(Field<IdType, double>& amounts, const Shares<IdType>& shares,
              const Field<IdType, int>& valence) {
  const Field<IdType, double> before = amounts;
  for (const auto& [a, b] : shares.links) {
    const double ma = shares.measure[a], mb = shares.measure[b];
    const double difference = before[a] / ma - before[b] / mb;
    const double flux = 0.5 * std::min(ma, mb) * difference / std::max(valence[a], valence[b]);
    amounts[a] -= flux;
    amounts[b] += flux;
  }
}

/// Lets elements take of what is missing as much as the range permits; whether anything is left.
template <class IdType>
bool take(Field<IdType, double>& values, Field<IdType, double>& missing,
          const Shares<IdType>& shares, const FieldRange& range) {
  bool is_left = false;
  for (const IdType i : values.ids()) {
    MENISCUS_ASSERT(shares.measure[i] > 0.0, "element {} measures {}", i.value, shares.measure[i]);
    const double m = shares.measure[i], wanted = values[i] + missing[i] / m;
    const double value = std::clamp(wanted, range.low, range.high);
    missing[i] = m * (wanted - value);
    values[i] = value;
    is_left = is_left || missing[i] != 0.0;
  }
  return is_left;
}

/// What is missing in each piece, and the room it has for that.
struct PieceBalance {
  long double missing = 0.0L, measure = 0.0L, above = 0.0L, below = 0.0L;
};
template <class IdType>
std::vector<PieceBalance> balances(const Field<IdType, double>& values,
                                   const std::vector<double>& amount_of_piece,
                                   const Shares<IdType>& shares, const FieldRange& range) {
  std::vector<PieceBalance> result(amount_of_piece.size());
  for (std::size_t k = 0; k < result.size(); ++k) result[k].missing = amount_of_piece[k];
  for (const IdType i : values.ids()) {
    PieceBalance& piece = result[static_cast<std::size_t>(shares.piece[i])];
    const long double m = shares.measure[i];
    piece.missing -= m * values[i];
    piece.measure += m;
    piece.above += m * std::max(0.0, range.high - values[i]);
    piece.below += m * std::max(0.0, values[i] - range.low);
  }
  return result;
}

/// Shares what is missing among the elements of each piece: in proportion to their room, beyond
/// that in equal parts.
template <class IdType>
void share_rest(Field<IdType, double>& values, const std::vector<double>& amount_of_piece,
                const Shares<IdType>& shares, const FieldRange& range) {
  const auto pieces = balances(values, amount_of_piece, shares, range);
  for (const IdType i : values.ids()) {
    const PieceBalance& piece = pieces[static_cast<std::size_t>(shares.piece[i])];
    const bool rises = piece.missing > 0.0L;
    const long double room = rises ? piece.above : piece.below, size = std::abs(piece.missing);
    const auto theta = static_cast<double>(room > 0.0L ? std::min(1.0L, size / room) : 0.0L);
    const auto beyond = static_cast<double>(std::max(0.0L, size - room) / piece.measure);
    values[i] += rises ? theta * std::max(0.0, range.high - values[i]) + beyond
                       : -theta * std::max(0.0, values[i] - range.low) - beyond;
  }
}

}  // namespace

VertexPieces vertex_pieces(const SurfaceMesh& mesh, const SurfaceTopology& topology) {
  VertexPieces pieces{VertexField<int>(mesh.num_vertices(), -1)};
  std::vector<VertexId> open;
  for (const VertexId seed : pieces.piece.ids()) {
    if (pieces.piece[seed] >= 0) continue;
    pieces.piece[seed] = pieces.count;
    open.push_back(seed);
    while (!open.empty()) {
      const VertexId v = open.back();
      open.pop_back();
      for (const VertexId w : topology.ring(v)) {
        if (pieces.piece[w] >= 0) continue;
        pieces.piece[w] = pieces.count;
        open.push_back(w);
      }
    }
    ++pieces.count;
  }
  return pieces;
}

Shares<VertexId> vertex_shares(const SurfaceMesh& mesh) {
  const SurfaceTopology topology(mesh);
  VertexPieces pieces = vertex_pieces(mesh, topology);
  Shares<VertexId> shares{
      .measure = vertex_areas(mesh), .links = {}, .piece = std::move(pieces.piece)};
  shares.num_pieces = pieces.count;
  for (const SurfaceEdge& e : topology.edges()) shares.links.emplace_back(e.a, e.b);
  return shares;
}

Shares<FaceId> face_shares(const SurfaceMesh& mesh) {
  const SurfaceTopology topology(mesh);
  const VertexPieces pieces = vertex_pieces(mesh, topology);
  Shares<FaceId> shares;
  shares.num_pieces = pieces.count;
  for (const FaceId f : mesh.faces.ids()) {
    shares.measure.add(face_area_vector(mesh, f).norm());
    shares.piece.add(pieces.piece[mesh.faces[f][0]]);
  }
  for (const SurfaceEdge& e : topology.edges()) shares.links.emplace_back(e.left, e.right);
  return shares;
}

template <class IdType>
FieldExcess keep_amounts(Field<IdType, double>& values, Field<IdType, double> missing,
                         const std::vector<double>& amount_of_piece, const Shares<IdType>& shares,
                         const FieldRange& range) {
  MENISCUS_ASSERT(values.size() == shares.measure.size() && missing.size() == values.size(),
                  "{} values, {} amounts and {} measures", values.size(), missing.size(),
                  shares.measure.size());
  MENISCUS_ASSERT(amount_of_piece.size() == static_cast<std::size_t>(shares.num_pieces),
                  "{} amounts of {} pieces", amount_of_piece.size(), shares.num_pieces);
  const Field<IdType, int> valence = valences(shares);
  bool is_left = true;
  for (int pass = 0; pass < kPasses && is_left; ++pass) {
    for (int i = 0; i < kExchanges; ++i) exchange(missing, shares, valence);
    is_left = take(values, missing, shares, range);
  }
  for (int i = 0; i < 2; ++i) share_rest(values, amount_of_piece, shares, range);  // 2: round-off
  FieldExcess excess;
  for (const double value : values) {
    excess.above = std::max(excess.above, value - range.high);
    excess.below = std::max(excess.below, range.low - value);
  }
  return excess;
}

template <class IdType>
FieldExcess keep_amounts(Field<IdType, double>& values, const Field<IdType, double>& amounts,
                         const Shares<IdType>& shares, const FieldRange& range) {
  Field<IdType, double> missing(values.size());
  std::vector<double> amount_of_piece(static_cast<std::size_t>(shares.num_pieces), 0.0);
  for (const IdType i : values.ids()) {
    missing[i] = amounts[i] - shares.measure[i] * values[i];
    amount_of_piece[static_cast<std::size_t>(shares.piece[i])] += amounts[i];
  }
  return keep_amounts(values, std::move(missing), amount_of_piece, shares, range);
}

template FieldExcess keep_amounts(VertexField<double>&, const VertexField<double>&,
                                  const Shares<VertexId>&, const FieldRange&);
template FieldExcess keep_amounts(FaceField<double>&, const FaceField<double>&,
                                  const Shares<FaceId>&, const FieldRange&);
template FieldExcess keep_amounts(VertexField<double>&, VertexField<double>,
                                  const std::vector<double>&, const Shares<VertexId>&,
                                  const FieldRange&);
template FieldExcess keep_amounts(FaceField<double>&, FaceField<double>, const std::vector<double>&,
                                  const Shares<FaceId>&, const FieldRange&);

}  // namespace meniscus
