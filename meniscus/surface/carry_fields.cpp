#include "meniscus/surface/carry_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_tree.hpp"
#include "meniscus/surface/face_reconstruction.hpp"
#include "meniscus/surface/keep_amounts.hpp"

namespace meniscus {
namespace {

/// Each side of an old face is cut in this many, to find out what its parts go to.
constexpr int kCuts = 4;

template <class IdType>
FieldRange range_of(const Field<IdType, double>& values) {
  if (values.empty()) return {};
  const auto [low, high] = std::ranges::minmax(values);
  return {low, high};
}

template <class IdType>
void move_field(CarriedField<IdType>& field, const Field<IdType, double>& before,
                const Field<IdType, double>& after, FieldExcess& excess) {
  if (field.transfer != FieldTransfer::conserved) return;
  const FieldRange range = range_of(field.values);
  for (const IdType i : field.values.ids()) {
    double& value = field.values[i];
    value *= before[i] / after[i];
    widen(excess, {value - range.high, range.low - value});
  }
}

/// The elements of a surface found by the positions of their corners.
class ElementsByPosition {
 public:
  explicit ElementsByPosition(const SurfaceMesh& mesh) {
    for (const VertexId v : mesh.x.ids()) vertices_.emplace(key(mesh.x[v]), v);
    for (const FaceId f : mesh.faces.ids()) faces_.emplace(sorted_corners(mesh.faces[f]), f);
  }
  /// Invalid where there is none.
  [[nodiscard]] VertexId vertex(const Vec3& x) const {
    const auto found = vertices_.find(key(x));
    return found == vertices_.end() ? VertexId() : found->second;
  }
  [[nodiscard]] FaceId face(const FaceVertices& corners) const {
    const auto found = faces_.find(sorted_corners(corners));
    return found == faces_.end() ? FaceId() : found->second;
  }

 private:
  using Key = std::tuple<double, double, double>;
  static Key key(const Vec3& x) { return {x.x(), x.y(), x.z()}; }
  static FaceVertices sorted_corners(FaceVertices corners) {
    std::ranges::sort(corners);
    return corners;
  }
  std::map<Key, VertexId> vertices_;
  std::map<FaceVertices, FaceId> faces_;
};

/// For each element of one surface the element of another in the same place; invalid: none.
struct SameElements {
  VertexField<VertexId> vertices;
  FaceField<FaceId> faces;
};
SameElements same_elements(const SurfaceMesh& from, const SurfaceMesh& to) {
  const ElementsByPosition elements(to);
  SameElements same;
  for (const Vec3& x : from.x) same.vertices.add(elements.vertex(x));
  for (const FaceVertices& v : from.faces)
    same.faces.add(elements.face({same.vertices[v[0]], same.vertices[v[1]], same.vertices[v[2]]}));
  return same;
}

Vec3 point(const SurfaceMesh& mesh, FaceId f, const Vec3& weights) {
  const FaceVertices& v = mesh.faces[f];
  return weights[0] * mesh.x[v[0]] + weights[1] * mesh.x[v[1]] + weights[2] * mesh.x[v[2]];
}

double value_at(const SurfaceMesh& mesh, const VertexField<double>& values, FaceId f,
                const Vec3& weights) {
  const FaceVertices& v = mesh.faces[f];
  return weights[0] * values[v[0]] + weights[1] * values[v[1]] + weights[2] * values[v[2]];
}

/// A part of an old face that is gone, and what it goes to.
struct Part {
  FaceId from;
  Vec3 weights;  ///< barycentric, in `from`
  double area;
  SurfaceTree::Hit to;
};

/// How a surface has taken the place of another.
class Replacement {
 public:
  Replacement(const SurfaceMesh& before, const SurfaceMesh& after)
      : before_(before),
        after_(after),
        topology_(before),
        kept_(same_elements(before, after)),
        old_(same_elements(after, before)),
        centers_(part_centers(kCuts)),
        old_tree_(before),
        old_areas_(face_areas(before)) {
    find_parts();
  }

  [[nodiscard]] VertexField<double> values_nearby(const VertexField<double>& values) const {
    VertexField<double> result(after_.num_vertices());
    for (const VertexId v : result.ids()) {
      if (old_.vertices[v].is_valid()) {
        result[v] = values[old_.vertices[v]];
        continue;
      }
      const SurfaceTree::Hit hit = old_tree_.closest(after_.x[v]);
      const FieldRange range = range_at(values, hit.face);
      result[v] =
          std::clamp(value_at(before_, values, hit.face, hit.weights), range.low, range.high);
    }
    return result;
  }
  [[nodiscard]] FaceField<double> values_nearby(const FaceField<double>& values) const {
    const FaceReconstruction linear(before_, topology_, values);
    FaceField<double> result(after_.num_faces(), 0.0);
    for (const FaceId f : result.ids()) {
      if (old_.faces[f].is_valid()) {
        result[f] = values[old_.faces[f]];
        continue;
      }
      FieldRange range{HUGE_VAL, -HUGE_VAL};
      for (const Vec3& center : centers_) {
        const SurfaceTree::Hit hit = old_tree_.closest(point(after_, f, center));
        const double value = linear.value(hit.face, hit.point);
        range = {std::min(range.low, value), std::max(range.high, value)};
        result[f] += value / static_cast<double>(centers_.size());
      }
      result[f] = std::clamp(result[f], range.low, range.high);
    }
    return result;
  }

  /// The amounts of a field that the elements of the new surface receive.
  [[nodiscard]] VertexField<double> received_amounts(const VertexField<double>& values) const {
    VertexField<double> amounts(after_.num_vertices(), 0.0);
    for (const FaceId f : before_.faces.ids())
      if (kept_.faces[f].is_valid())
        for (const VertexId v : before_.faces[f])
          amounts[kept_.vertices[v]] += old_areas_[f] / 3.0 * values[v];
    for (const Part& part : parts_) {
      const double amount = part.area * value_at(before_, values, part.from, part.weights);
      for (int k = 0; k < 3; ++k)
        amounts[after_.faces[part.to.face][static_cast<std::size_t>(k)]] +=
            part.to.weights[k] * amount;
    }
    return amounts;
  }
  [[nodiscard]] FaceField<double> received_amounts(const FaceField<double>& values) const {
    FaceField<double> amounts(after_.num_faces(), 0.0);
    for (const FaceId f : before_.faces.ids())
      if (kept_.faces[f].is_valid()) amounts[kept_.faces[f]] += old_areas_[f] * values[f];
    for (const Part& part : parts_) amounts[part.to.face] += part.area * values[part.from];
    return amounts;
  }

 private:
  [[nodiscard]] FieldRange range_at(const VertexField<double>& values, FaceId f) const {
    const auto [a, b, c] = before_.faces[f];
    const auto [low, high] = std::minmax({values[a], values[b], values[c]});
    return {low, high};
  }
  void find_parts() {
    const SurfaceTree tree(after_);
    for (const FaceId f : before_.faces.ids()) {
      if (kept_.faces[f].is_valid()) continue;
      const double area = old_areas_[f] / static_cast<double>(centers_.size());
      for (const Vec3& center : centers_)
        parts_.push_back({f, center, area, tree.closest(point(before_, f, center))});
    }
  }

  const SurfaceMesh &before_, &after_;
  SurfaceTopology topology_;  // of `before_`
  SameElements kept_, old_;
  std::vector<Vec3> centers_;
  SurfaceTree old_tree_;
  FaceField<double> old_areas_;
  std::vector<Part> parts_;
};

template <class IdType>
std::vector<CarriedField<IdType>> new_fields(const std::vector<CarriedField<IdType>>& fields,
                                             const Replacement& replacement,
                                             const Shares<IdType>& shares, FieldExcess& excess) {
  std::vector<CarriedField<IdType>> result;
  for (const CarriedField<IdType>& field : fields) {
    Field<IdType, double> values = replacement.values_nearby(field.values);
    if (field.transfer == FieldTransfer::conserved)
      widen(excess, keep_amounts(values, replacement.received_amounts(field.values), shares,
                                 range_of(field.values)));
    result.push_back({field.name, field.unit, field.transfer, std::move(values)});
  }
  return result;
}

template <class IdType>
void append(std::vector<CarriedField<IdType>>& whole,
            const std::vector<CarriedField<IdType>>& part) {
  for (std::size_t k = 0; k < whole.size(); ++k)
    for (const double value : part[k].values) whole[k].values.add(value);
}

/// The values of `count` elements from `first` on.
template <class IdType>
std::vector<CarriedField<IdType>> section(const std::vector<CarriedField<IdType>>& whole,
                                          std::int32_t first, std::int32_t count) {
  std::vector<CarriedField<IdType>> part;
  for (const CarriedField<IdType>& field : whole) {
    Field<IdType, double> values(count);
    for (const IdType i : values.ids()) values[i] = field.values[IdType{first + i.value}];
    part.push_back({field.name, field.unit, field.transfer, std::move(values)});
  }
  return part;
}

template <class IdType>
bool have_same(const std::vector<CarriedField<IdType>>& a,
               const std::vector<CarriedField<IdType>>& b) {
  return std::ranges::equal(a, b, [](const auto& first, const auto& second) {
    return first.name == second.name && first.transfer == second.transfer;
  });
}

}  // namespace

std::vector<Vec3> part_centers(int cuts) {
  std::vector<Vec3> centers;
  for (int i = 0; i < cuts; ++i)
    for (int j = 0; i + j < cuts; ++j)
      for (const double third : {1.0 / 3.0, 2.0 / 3.0}) {
        const double a = (i + third) / cuts, b = (j + third) / cuts;
        if (i + j + 2.0 * third < cuts) centers.emplace_back(1.0 - a - b, a, b);
      }
  return centers;
}

void widen(FieldExcess& excess, const FieldExcess& other) {
  excess.above = std::max(excess.above, other.above);
  excess.below = std::max(excess.below, other.below);
}

void follow(FieldExcess& excess, const FieldExcess& next) {
  excess.above += next.above;
  excess.below += next.below;
}

FieldExcess move_fields(SurfaceFields& fields, const SurfaceMesh& before,
                        const SurfaceMesh& after) {
  FieldExcess excess;
  if (fields.empty()) return excess;
  MENISCUS_ASSERT(before.faces == after.faces, "fields are moved between meshes of other faces");
  const VertexField<double> vertices_before = vertex_areas(before),
                            vertices_after = vertex_areas(after);
  const FaceField<double> faces_before = face_areas(before), faces_after = face_areas(after);
  for (auto& field : fields.on_vertices) move_field(field, vertices_before, vertices_after, excess);
  for (auto& field : fields.on_faces) move_field(field, faces_before, faces_after, excess);
  return excess;
}

ReplacedFields replaced_fields(const SurfaceFields& fields, const SurfaceMesh& before,
                               const SurfaceMesh& after) {
  return replaced_fields(fields, before, after, after);
}

ReplacedFields replaced_fields(const SurfaceFields& fields, const SurfaceMesh& before,
                               const SurfaceMesh& after, const SurfaceMesh& settled) {
  ReplacedFields result;
  if (fields.empty()) return result;
  MENISCUS_ASSERT(after.faces == settled.faces, "settled on other faces");
  const Replacement replacement(before, after);
  result.fields.on_vertices =
      new_fields(fields.on_vertices, replacement, vertex_shares(settled), result.excess);
  result.fields.on_faces =
      new_fields(fields.on_faces, replacement, face_shares(settled), result.excess);
  return result;
}

SurfaceFields joined_fields(std::span<const SurfaceFields> parts) {
  if (parts.empty()) return {};
  SurfaceFields whole = parts.front();
  for (const SurfaceFields& part : parts.subspan(1)) {
    MENISCUS_ASSERT(have_same_fields(whole, part), "two interfaces have other fields");
    append(whole.on_vertices, part.on_vertices);
    append(whole.on_faces, part.on_faces);
  }
  return whole;
}

std::vector<SurfaceFields> split_fields(const SurfaceFields& whole,
                                        std::span<const SurfaceMesh> pieces) {
  std::vector<SurfaceFields> parts;
  std::int32_t vertices = 0, faces = 0;
  for (const SurfaceMesh& piece : pieces) {
    parts.push_back({section(whole.on_vertices, vertices, piece.num_vertices()),
                     section(whole.on_faces, faces, piece.num_faces())});
    vertices += piece.num_vertices();
    faces += piece.num_faces();
  }
  for (const auto& field : whole.on_vertices)
    MENISCUS_ASSERT(field.values.size() == vertices, "{} values for {} vertices",
                    field.values.size(), vertices);
  for (const auto& field : whole.on_faces)
    MENISCUS_ASSERT(field.values.size() == faces, "{} values for {} faces", field.values.size(),
                    faces);
  return parts;
}

bool have_same_fields(const SurfaceFields& a, const SurfaceFields& b) {
  return have_same(a.on_vertices, b.on_vertices) && have_same(a.on_faces, b.on_faces);
}

}  // namespace meniscus
