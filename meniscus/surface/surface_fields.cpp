#include "meniscus/surface/surface_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_tree.hpp"
#include "meniscus/surface/edge_interpolation.hpp"
#include "meniscus/surface/face_reconstruction.hpp"
#include "meniscus/surface/keep_amounts.hpp"
#include "meniscus/surface/polynomial_fit.hpp"

namespace meniscus {
namespace {

struct Range {
  double low, high;
  void include(const Range& other) {
    low = std::min(low, other.low);
    high = std::max(high, other.high);
  }
  [[nodiscard]] double clamped_value(double value) const { return std::clamp(value, low, high); }
};

/// How far a smooth function may pass the values at the vertices around, over their spread. At its
/// extremum amid an equilateral face it passes them by a sixth.
constexpr double kOvershoot = 0.25;

/// A range with room for an extremum between the vertices. Zero stays a bound.
Range with_overshoot(const Range& range) {
  const double room = kOvershoot * (range.high - range.low);
  return {range.low < 0.0 ? range.low - room : std::max(0.0, range.low - room),
          range.high > 0.0 ? range.high + room : std::min(0.0, range.high + room)};
}

/// The value at a vertex plus monomials in the frame of the smooth surface's patch.
struct Quadratic {
  double value = 0.0;
  Eigen::Matrix<double, 5, 1> c = Eigen::Matrix<double, 5, 1>::Zero();
  [[nodiscard]] double at(double u, double v) const { return value + monomials<2>(u, v).dot(c); }
};

struct Sample {
  double u, v, difference;
};

/// Weighted least squares of the monomials up to a degree; false where they are not determined.
template <int Degree>
bool fit(std::span<const Sample> samples, Quadratic& quadratic) {
  constexpr int kTerms = num_monomials(Degree);
  if (samples.size() < kTerms) return false;
  double squared = 0.0;
  for (const Sample& s : samples) squared += s.u * s.u + s.v * s.v;
  const double h = std::sqrt(squared / static_cast<double>(samples.size()));
  PolynomialFit<kTerms> fit;
  Eigen::Matrix<double, kTerms, 1> rhs = Eigen::Matrix<double, kTerms, 1>::Zero();
  for (const Sample& s : samples) {
    const double u = s.u / h, v = s.v / h;
    rhs += s.difference * fit.add(monomials<Degree>(u, v), 1.0 / (u * u + v * v));
  }
  const auto factor = fit.factor();
  if (!factor) return false;
  const Eigen::Matrix<double, kTerms, 1> solution = factor->solve(rhs);
  for (int k = 0; k < kTerms; ++k) quadratic.c[k] = solution[k] / (k < 2 ? h : h * h);
  return true;
}

/// A vertex field as a function on the old surface. One that is conserved may pass the range of its
/// values where it is smooth.
class VertexInterpolant {
 public:
  VertexInterpolant(const SurfaceChange& change, const CarriedField<VertexId>& field)
      : change_(change),
        passes_range_(field.transfer == FieldTransfer::conserved),
        patches_(field.values.size()),
        ranges_(field.values.size()) {
    const VertexField<double>& values = field.values;
    MENISCUS_ASSERT(values.size() == change.before.num_vertices(), "{} values of {} vertices",
                    values.size(), change.before.num_vertices());
    std::vector<Sample> samples;
    for (const VertexId v : values.ids()) {
      const HeightPatch& frame = change.surface.patch(v);
      Range range{values[v], values[v]};
      samples.clear();
      for (const VertexId w : change.topology.ring(v)) {
        const Vec3 d = change.before.x[w] - frame.x;
        samples.push_back({d.dot(frame.t1), d.dot(frame.t2), values[w] - values[v]});
        range.include({values[w], values[w]});
      }
      patches_[v].value = values[v];
      if (!fit<2>(samples, patches_[v])) fit<1>(samples, patches_[v]);
      ranges_[v] = range;
    }
  }

  [[nodiscard]] double at(const SurfacePoint& point) const {
    const FaceVertices& corners = change_.surface.corners(point.face);
    const Vec3 flat = change_.walk.flat_point(point);
    const Vec3 squares = point.weights.cwiseProduct(point.weights);
    double value = 0.0;
    Range range = ranges_[corners[0]];
    for (std::size_t k = 0; k < 3; ++k) {
      const HeightPatch& frame = change_.surface.patch(corners[k]);
      const Vec3 d = flat - frame.x;
      value += squares[static_cast<int>(k)] / squares.sum() *
               patches_[corners[k]].at(d.dot(frame.t1), d.dot(frame.t2));
      range.include(ranges_[corners[k]]);
    }
    return (passes_range_ ? with_overshoot(range) : range).clamped_value(value);
  }

 private:
  const SurfaceChange& change_;
  bool passes_range_;
  VertexField<Quadratic> patches_;
  VertexField<Range> ranges_;
};

Vec3 center(const SurfaceMesh& mesh, FaceId f) {
  const FaceVertices& v = mesh.faces[f];
  return (mesh.x[v[0]] + mesh.x[v[1]] + mesh.x[v[2]]) / 3.0;
}

/// Four points of a new face, the centres of the quarters it is cut into by its mid-edges, on the
/// old surface.
std::array<SurfacePoint, 4> sample_points(const SurfaceChange& change, FaceId f) {
  const FaceVertices& v = change.after.faces[f];
  std::array<Vec3, 3> flat;
  for (std::size_t k = 0; k < 3; ++k) flat[k] = change.walk.flat_point(change.points[v[k]]);
  const Vec3 middle = (flat[0] + flat[1] + flat[2]) / 3.0;
  std::array<SurfacePoint, 4> points;
  for (std::size_t k = 0; k < 3; ++k)
    points[k] = change.walk.destination(change.points[v[k]], 0.5 * (middle - flat[k]));
  points[3] = change.walk.destination(change.points[v[0]], middle - flat[0]);
  return points;
}

/// Each side of an old face is cut in this many, to find what its parts come to lie on.
constexpr int kCuts = 3;

/// A part of an old face, and where it comes to lie on the new surface.
struct Part {
  SurfacePoint from;
  double area;
  SurfaceTree::Hit to;
};
std::vector<Part> parts_of(const SurfaceChange& change, const FaceField<double>& areas) {
  const SurfaceTree tree(change.after);
  const std::vector<Vec3> centers = part_centers(kCuts);
  std::vector<Part> parts;
  for (const FaceId f : areas.ids())
    for (const Vec3& center : centers) {
      const SurfacePoint from{f, center};
      parts.push_back({from, areas[f] / static_cast<double>(centers.size()),
                       tree.closest(change.walk.flat_point(from))});
    }
  return parts;
}

/// A vertex field as a function on the new surface.
class NewFunction {
 public:
  NewFunction(const SurfaceMesh& mesh, const SurfaceTopology& topology,
              const VertexField<double>& values)
      : mesh_(mesh), values_(values) {
    const VertexField<Vec3> area = vertex_area_vectors(mesh);
    around_.reserve(static_cast<std::size_t>(mesh.num_vertices()));
    for (const VertexId v : mesh.x.ids())
      around_.emplace_back(mesh, topology, v, area[v].normalized());
  }
  /// Where a flat face has these barycentric weights.
  [[nodiscard]] double at(FaceId f, const Vec3& weights) const {
    const FaceVertices& v = mesh_.faces[f];
    const Vec3 x =
        weights[0] * mesh_.x[v[0]] + weights[1] * mesh_.x[v[1]] + weights[2] * mesh_.x[v[2]];
    const Vec3 squares = weights.cwiseProduct(weights);
    Stencil stencil;
    for (std::size_t k = 0; k < 3; ++k)
      around_[static_cast<std::size_t>(v[k].value)].add(
          x, squares[static_cast<int>(k)] / squares.sum(), stencil);
    double value = 0.0;
    for (const VertexWeight& each : stencil) value += each.weight * values_[each.vertex];
    return value;
  }

 private:
  const SurfaceMesh& mesh_;
  const VertexField<double>& values_;
  std::vector<VertexInterpolation> around_;
};

/// Conserved fields: what the old surface had beyond the new values goes to where it comes to lie.
/// What areas have gained or lost is left to the piece.
class Conservation {
 public:
  explicit Conservation(const SurfaceChange& change)
      : change_(change),
        old_areas_(face_areas(change.before)),
        old_pieces_(vertex_pieces(change.before, change.topology)),
        parts_(parts_of(change, old_areas_)) {}

  FieldExcess keep(VertexField<double>& values, const VertexField<double>& before,
                   const VertexInterpolant& old_function) const {
    const SurfaceTopology topology(change_.after);
    const NewFunction new_function(change_.after, topology, values);
    VertexField<double> missing(values.size(), 0.0);
    for (const Part& part : parts_) {
      const double amount =
          part.area * (old_function.at(part.from) - new_function.at(part.to.face, part.to.weights));
      for (int k = 0; k < 3; ++k)
        missing[change_.after.faces[part.to.face][static_cast<std::size_t>(k)]] +=
            part.to.weights[k] * amount;
    }
    const Shares<VertexId> shares = vertex_shares(change_.after);
    const VertexField<double> areas = vertex_areas(change_.before);
    std::vector<double> amounts(static_cast<std::size_t>(old_pieces_.count), 0.0);
    for (const VertexId v : before.ids())
      amounts[static_cast<std::size_t>(old_pieces_.piece[v])] += areas[v] * before[v];
    FieldRange range = range_of(before);
    for (const double value : values)
      range = {std::min(range.low, value), std::max(range.high, value)};
    return keep_amounts(values, std::move(missing), of_new_pieces(amounts, shares.num_pieces),
                        shares, range);
  }

  /// Old and new values are compared at the centre of the new face. At the part itself the slope
  /// would count, and with it how parts happen to lie.
  FieldExcess keep(FaceField<double>& values, const FaceField<double>& before,
                   const FaceReconstruction& reconstruction) const {
    FaceField<double> missing(values.size(), 0.0);
    for (const Part& part : parts_)
      missing[part.to.face] +=
          part.area *
          (reconstruction.unclamped_value(part.from.face, center(change_.after, part.to.face)) -
           values[part.to.face]);
    std::vector<double> amounts(static_cast<std::size_t>(old_pieces_.count), 0.0);
    for (const FaceId f : before.ids())
      amounts[static_cast<std::size_t>(old_pieces_.piece[change_.before.faces[f][0]])] +=
          old_areas_[f] * before[f];
    const Shares<FaceId> shares = face_shares(change_.after);
    return keep_amounts(values, std::move(missing), of_new_pieces(amounts, shares.num_pieces),
                        shares, range_of(before));
  }

 private:
  template <class IdType>
  static FieldRange range_of(const Field<IdType, double>& values) {
    const auto [low, high] = std::ranges::minmax(values);
    return {low, high};
  }
  /// Numbers given by old pieces, in the order of the pieces of the new surface.
  [[nodiscard]] std::vector<double> of_new_pieces(const std::vector<double>& of_old,
                                                  int num_pieces) const {
    std::vector<double> result(static_cast<std::size_t>(num_pieces), 0.0);
    const VertexPieces pieces = vertex_pieces(change_.after, SurfaceTopology(change_.after));
    for (const VertexId v : pieces.piece.ids()) {
      const VertexId old = change_.before.faces[change_.points[v].face][0];
      result[static_cast<std::size_t>(pieces.piece[v])] =
          of_old[static_cast<std::size_t>(old_pieces_.piece[old])];
    }
    return result;
  }

  const SurfaceChange& change_;
  FaceField<double> old_areas_;
  VertexPieces old_pieces_;
  std::vector<Part> parts_;
};

bool has_conserved(const SurfaceFields& fields) {
  const auto is_conserved = [](const auto& field) {
    return field.transfer == FieldTransfer::conserved;
  };
  return std::ranges::any_of(fields.on_vertices, is_conserved) ||
         std::ranges::any_of(fields.on_faces, is_conserved);
}

}  // namespace

ReplacedFields transferred_fields(const SurfaceFields& fields, const SurfaceChange& change) {
  ReplacedFields result;
  if (fields.empty()) return result;
  MENISCUS_ASSERT(change.points.size() == change.after.num_vertices(), "{} points of {} vertices",
                  change.points.size(), change.after.num_vertices());
  std::optional<Conservation> conservation;
  if (has_conserved(fields)) conservation.emplace(change);
  for (const CarriedField<VertexId>& field : fields.on_vertices) {
    const VertexInterpolant interpolant(change, field);
    VertexField<double> values(change.after.num_vertices());
    for (const VertexId v : values.ids()) values[v] = interpolant.at(change.points[v]);
    if (field.transfer == FieldTransfer::conserved) {
      const auto [low, high] = std::ranges::minmax(field.values);
      widen(result.excess, conservation->keep(values, field.values, interpolant));
      for (const double value : values) widen(result.excess, {value - high, low - value});
    }
    result.fields.on_vertices.push_back(
        {field.name, field.unit, field.transfer, std::move(values)});
  }
  if (fields.on_faces.empty()) return result;
  for (const CarriedField<FaceId>& field : fields.on_faces) {
    const FaceReconstruction reconstruction(change.before, change.topology, field.values);
    FaceField<double> values(change.after.num_faces(), 0.0);
    for (const FaceId f : values.ids())
      for (const SurfacePoint& point : sample_points(change, f))
        values[f] += 0.25 * reconstruction.value(point.face, change.walk.flat_point(point));
    if (field.transfer == FieldTransfer::conserved)
      widen(result.excess, conservation->keep(values, field.values, reconstruction));
    result.fields.on_faces.push_back({field.name, field.unit, field.transfer, std::move(values)});
  }
  return result;
}

}  // namespace meniscus
