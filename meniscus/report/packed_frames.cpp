#include "meniscus/report/packed_frames.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>

#include "meniscus/core/error.hpp"
#include "meniscus/report/packing.hpp"

namespace meniscus::report {
namespace {

using Json = nlohmann::ordered_json;

// The regular tetrahedron has the largest possible smallest dihedral angle, 70.5 degrees.
constexpr double best_quality = 72.0;
constexpr int most_regions = 255;

std::vector<std::uint16_t> grid_indices(std::span<const double> values, const Grid16& grid) {
  std::vector<std::uint16_t> indices;
  indices.reserve(values.size());
  for (const double value : values) indices.push_back(grid.index(value));
  return indices;
}

/// One coordinate of all points.
template <class Points>
std::vector<double> coordinate(const Points& points, int axis) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(std::ranges::distance(points)));
  for (const auto& x : points) values.push_back(x[axis]);
  return values;
}

Json in_json(const Vec3& x) { return Json::array({x.x(), x.y(), x.z()}); }

/// The bits of a ten-bit number, two zeros between neighbours.
std::uint32_t bits_three_apart(std::uint32_t value) {
  std::uint32_t result = 0;
  for (unsigned int bit = 0; bit < 10; ++bit) result |= (value >> bit & 1U) << (3 * bit);
  return result;
}

/// The vertices in Morton order on a grid of 2^10 cells per side (interleaved bits of the
/// coordinates). Vertices close in space are mostly close in the order.
std::vector<VertexId> order_along_curve(const VertexField<Vec3>& x,
                                        const std::array<Grid16, 3>& grids) {
  VertexField<std::uint32_t> code(x.size(), 0);
  for (const VertexId v : x.ids()) {
    for (unsigned int k = 0; k < 3; ++k)
      code[v] |= bits_three_apart(grids[k].index(x[v][static_cast<int>(k)]) >> 6U) << k;
  }
  const auto ids = x.ids();
  std::vector<VertexId> order(ids.begin(), ids.end());
  std::ranges::stable_sort(order, {}, [&](VertexId v) { return code[v]; });
  return order;
}

template <class T>
std::vector<T> values_in_order(const Field<VertexId, T>& values,
                               const std::vector<VertexId>& order) {
  MENISCUS_ASSERT(values.size() == static_cast<std::int32_t>(order.size()),
                  "{} values in an order of {}", values.size(), order.size());
  std::vector<T> result;
  result.reserve(order.size());
  for (const VertexId v : order) result.push_back(values[v]);
  return result;
}

/// A face by the ranks of its vertices, and the middles of its edges 01, 12, 20 where it is curved.
struct RankedFace {
  std::array<std::uint32_t, 3> corners{};
  std::array<Vec3, 3> middles{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
};

/// The faces by the vertices' ranks in `order`, smallest corner first, sorted.
std::vector<RankedFace> sorted_faces(const SurfaceFrame& frame,
                                     const std::vector<VertexId>& order) {
  VertexField<std::uint32_t> rank(frame.mesh.num_vertices());
  for (std::size_t i = 0; i < order.size(); ++i) rank[order[i]] = static_cast<std::uint32_t>(i);
  std::vector<RankedFace> faces;
  for (const FaceId f : frame.mesh.faces.ids()) {
    RankedFace& face = faces.emplace_back();
    std::ranges::transform(frame.mesh.faces[f], face.corners.begin(),
                           [&](VertexId v) { return rank[v]; });
    if (!frame.middles.empty()) face.middles = frame.middles[f];
    const auto first = std::ranges::min_element(face.corners) - face.corners.begin();
    std::ranges::rotate(face.corners, face.corners.begin() + first);
    std::ranges::rotate(face.middles, face.middles.begin() + first);
  }
  std::ranges::stable_sort(faces, {}, &RankedFace::corners);
  return faces;
}

void add_corners(Package& package, const std::vector<RankedFace>& faces, bool is_wide) {
  std::array<std::vector<std::uint32_t>, 3> columns;
  std::uint32_t before = 0;
  for (const RankedFace& face : faces) {
    const auto [a, b, c] = face.corners;
    columns[0].push_back(a - std::exchange(before, a));
    columns[1].push_back(b - a);
    columns[2].push_back(c - a);
  }
  for (const std::vector<std::uint32_t>& column : columns) {
    if (is_wide)
      package.add(column);
    else
      package.add(std::vector<std::uint16_t>(column.begin(), column.end()));
  }
}

/// An edge by the ranks of its ends, and its middle.
struct RankedEdge {
  std::uint32_t a = 0, b = 0;
  Vec3 middle = Vec3::Zero();
};

/// The edges in the order in which faces first name them.
std::vector<RankedEdge> edges_of(const std::vector<RankedFace>& faces) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> known;
  std::vector<RankedEdge> edges;
  for (const RankedFace& face : faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax({face.corners[k], face.corners[(k + 1) % 3]});
      if (known.insert({a, b}).second) edges.push_back({a, b, face.middles[k]});
    }
  return edges;
}

/// How far each edge's middle is from that of the straight edge between the packed ends, in steps
/// of the grid, modulo 2^16.
std::vector<std::uint16_t> middle_offsets(const std::vector<RankedEdge>& edges,
                                          const std::vector<std::uint16_t>& ends, int axis,
                                          const Grid16& grid) {
  const double step = (grid.high - grid.low) / Grid16::steps;
  constexpr double kMost = 32767.0;
  std::vector<std::uint16_t> offsets;
  for (const RankedEdge& edge : edges) {
    const double straight = grid.low + 0.5 * step * (ends[edge.a] + ends[edge.b]);
    const double offset = step > 0.0 ? (edge.middle[axis] - straight) / step : 0.0;
    offsets.push_back(static_cast<std::uint16_t>(std::lround(std::clamp(offset, -kMost, kMost))));
  }
  return offsets;
}

std::uint8_t quality_byte(double degrees) {
  const double share = std::isfinite(degrees) ? std::clamp(degrees / best_quality, 0.0, 1.0) : 0.0;
  return static_cast<std::uint8_t>(std::lround(255.0 * share));
}

/// The grids on which a cut is packed.
struct CutGrids {
  std::array<Grid16, 2> points;
  std::vector<Grid16> fields;
};

CutGrids grids_of(const MeshCut& cut) {
  CutGrids grids{
      {Grid16::around(coordinate(cut.points, 0)), Grid16::around(coordinate(cut.points, 1))}, {}};
  for (const CutField& field : cut.fields) grids.fields.push_back(Grid16::around(field.values));
  return grids;
}

Json header_of(const MeshCut& cut, const CutGrids& grids) {
  Json fields = Json::array();
  for (std::size_t k = 0; k < cut.fields.size(); ++k)
    fields.push_back({{"name", cut.fields[k].name},
                      {"low", grids.fields[k].low},
                      {"high", grids.fields[k].high}});
  return {{"axes", cut.axes},
          {"normal", cut.normal},
          {"offset", cut.offset},
          {"polygons", cut.polygons.size()},
          {"points", cut.points.size()},
          {"low", {grids.points[0].low, grids.points[1].low}},
          {"high", {grids.points[0].high, grids.points[1].high}},
          {"drops", cut.drops},
          {"window", {cut.low[0], cut.low[1], cut.high[0], cut.high[1]}},
          {"quality", best_quality},
          {"fields", fields}};
}

/// The colour range of each field over all cuts.
std::map<std::string, ValueRange> ranges_of(const std::vector<MeshCut>& cuts) {
  std::map<std::string, std::vector<double>> values;
  for (const MeshCut& cut : cuts)
    for (const CutField& field : cut.fields)
      values[field.name].insert(values[field.name].end(), field.values.begin(), field.values.end());
  std::map<std::string, ValueRange> ranges;
  for (const auto& [name, all] : values) ranges[name] = color_range(all);
  return ranges;
}

void add_cut(Package& package, const MeshCut& cut, const CutGrids& grids) {
  std::vector<std::uint8_t> corners, regions, qualities;
  for (const CutPolygon& polygon : cut.polygons) {
    corners.push_back(static_cast<std::uint8_t>(polygon.num_points));
    regions.push_back(static_cast<std::uint8_t>(std::clamp(polygon.region, 0, most_regions)));
    qualities.push_back(quality_byte(polygon.min_dihedral_deg));
  }
  package.add(corners);
  package.add(regions);
  package.add(qualities);
  for (int k = 0; k < 2; ++k) {
    package.add_differences(
        grid_indices(coordinate(cut.points, k), grids.points[static_cast<std::size_t>(k)]));
  }
  for (std::size_t k = 0; k < cut.fields.size(); ++k)
    package.add_differences(grid_indices(cut.fields[k].values, grids.fields[k]));
}

}  // namespace

PackedFrame packed_surface(const SurfaceFrame& frame) {
  PackedFrame result{.t = frame.t, .bytes = {}};
  result.num_faces = result.num_faces_of_run = frame.mesh.num_faces();
  result.is_curved = !frame.middles.empty();
  const bool is_wide = frame.mesh.num_vertices() > 65536;
  std::array<Grid16, 3> grids;
  for (int k = 0; k < 3; ++k) {
    Grid16& grid = grids[static_cast<std::size_t>(k)];
    grid = Grid16::around(coordinate(frame.mesh.x, k));
    result.low[k] = grid.low;
    result.high[k] = grid.high;
  }
  std::vector<Grid16> field_grids;
  Json fields = Json::array();
  for (const SurfaceField& field : frame.fields) {
    const Grid16& grid = field_grids.emplace_back(Grid16::around(field.values.span()));
    fields.push_back({{"name", field.name}, {"low", grid.low}, {"high", grid.high}});
    result.ranges[field.name] = color_range(field.values.span());
  }
  const std::vector<VertexId> order = order_along_curve(frame.mesh.x, grids);
  const std::vector<RankedFace> faces = sorted_faces(frame, order);
  const std::vector<RankedEdge> curved =
      frame.middles.empty() ? std::vector<RankedEdge>() : edges_of(faces);
  const Json header{{"t", frame.t},
                    {"vertices", frame.mesh.num_vertices()},
                    {"faces", frame.mesh.num_faces()},
                    {"middles", curved.size()},
                    {"wide", is_wide},
                    {"low", in_json(result.low)},
                    {"high", in_json(result.high)},
                    {"fields", fields}};
  Package package(header.dump());
  add_corners(package, faces, is_wide);
  const std::vector<Vec3> points = values_in_order(frame.mesh.x, order);
  std::array<std::vector<std::uint16_t>, 3> indices;
  for (std::size_t k = 0; k < 3; ++k) {
    indices[k] = grid_indices(coordinate(points, static_cast<int>(k)), grids[k]);
    package.add_differences(indices[k]);
  }
  if (!curved.empty())
    for (std::size_t k = 0; k < 3; ++k)
      package.add(middle_offsets(curved, indices[k], static_cast<int>(k), grids[k]));
  for (std::size_t i = 0; i < frame.fields.size(); ++i) {
    package.add_differences(
        grid_indices(values_in_order(frame.fields[i].values, order), field_grids[i]));
  }
  result.bytes = package.bytes();
  return result;
}

PackedFrame packed_cuts(double t, const std::vector<MeshCut>& cuts) {
  std::vector<CutGrids> grids;
  Json headers = Json::array();
  for (const MeshCut& cut : cuts) {
    grids.push_back(grids_of(cut));
    headers.push_back(header_of(cut, grids.back()));
  }
  Package package(Json{{"t", t}, {"cuts", headers}}.dump());
  for (std::size_t i = 0; i < cuts.size(); ++i) add_cut(package, cuts[i], grids[i]);
  return {.t = t, .bytes = package.bytes(), .ranges = ranges_of(cuts)};
}

}  // namespace meniscus::report
