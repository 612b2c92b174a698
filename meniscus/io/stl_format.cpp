#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "meniscus/core/error.hpp"
#include "meniscus/io/binary.hpp"
#include "meniscus/io/surface_formats.hpp"
#include "meniscus/io/text_scanner.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus::io {
namespace {

// Binary STL: 80 bytes of any text, the number of triangles, then 50 bytes for each. These are
// normal and three corners as 12 floats, and 2 bytes without meaning.
constexpr std::size_t header_size = 80, preamble_size = 84, facet_size = 50, normal_size = 12;

/// Faces whose equal corners become one point.
class CornerMerger {
 public:
  void add_corner(const Vec3& x) {
    const std::array<double, 3> key = {x[0] + 0.0, x[1] + 0.0, x[2] + 0.0};  // −0 is 0
    const auto next = static_cast<std::int64_t>(soup_.points.size());
    if (!x.allFinite()) {  // NaN has no place in the order of keys: a point of its own, refused
                           // later
      soup_.points.push_back(x);
      soup_.corners.push_back(next);
      return;
    }
    const auto [found, is_new] = point_.try_emplace(key, next);
    if (is_new) soup_.points.push_back(x);
    soup_.corners.push_back(found->second);
  }
  /// How many corners were added since the last face.
  [[nodiscard]] std::size_t num_corners() const {
    return soup_.corners.size() - (soup_.ends.empty() ? 0 : soup_.ends.back());
  }
  void end_face(int tag) {
    soup_.end_face();
    soup_.tags.push_back(tag);
  }
  [[nodiscard]] PolygonSoup take() { return std::move(soup_); }

 private:
  PolygonSoup soup_;
  std::map<std::array<double, 3>, std::int64_t> point_;
};

/// A point this near an earlier one, over the extent of all, becomes that one. So it does within
/// two units of single precision at the largest coordinate.
constexpr double kSeam = 1e-6, kSingle = 0x1p-22;

/// Numbers points afresh, the same for those within `distance` of an earlier one.
class SeamWelder {
 public:
  explicit SeamWelder(double distance) : distance_(distance) {}

  std::int64_t number_of(const Vec3& x) {
    const Cell least = cell_of(x.array() - distance_), most = cell_of(x.array() + distance_);
    for (std::int64_t i = least[0]; i <= most[0]; ++i)
      for (std::int64_t j = least[1]; j <= most[1]; ++j)
        for (std::int64_t k = least[2]; k <= most[2]; ++k)
          if (const auto in_cell = by_cell_.find({i, j, k}); in_cell != by_cell_.end())
            for (const std::int64_t other : in_cell->second)
              if ((points_[static_cast<std::size_t>(other)] - x).norm() <= distance_) return other;
    const auto number = static_cast<std::int64_t>(points_.size());
    points_.push_back(x);
    by_cell_[cell_of(x)].push_back(number);
    return number;
  }
  [[nodiscard]] std::vector<Vec3> take_points() { return std::move(points_); }

 private:
  using Cell = std::array<std::int64_t, 3>;
  /// Cells are so large that most points see no other than their own.
  [[nodiscard]] Cell cell_of(const Vec3& x) const {
    const Vec3 place = x / (16.0 * distance_);
    return {std::int64_t(std::floor(place[0])), std::int64_t(std::floor(place[1])),
            std::int64_t(std::floor(place[2]))};
  }

  double distance_;
  std::vector<Vec3> points_;
  std::map<Cell, std::vector<std::int64_t>> by_cell_;
};

/// Merges the points along seams. Faces that lose a side go.
PolygonSoup welded(const PolygonSoup& soup) {
  Eigen::AlignedBox3d box;
  double largest = 0.0;
  for (const Vec3& x : soup.points) {
    box.extend(x);
    largest = std::max(largest, x.cwiseAbs().maxCoeff());
  }
  const double distance =
      soup.points.empty() ? 0.0 : std::max(kSeam * box.sizes().maxCoeff(), kSingle * largest);
  const auto are_near = [&](const Vec3& x) { return x.cwiseAbs().maxCoeff() < 1e18 * distance; };
  if (!(distance > 0.0) || !std::ranges::all_of(soup.points, are_near)) return soup;
  SeamWelder welder(distance);
  std::vector<std::int64_t> number;
  number.reserve(soup.points.size());
  for (const Vec3& x : soup.points) number.push_back(welder.number_of(x));
  PolygonSoup result;
  result.points = welder.take_points();
  for (std::size_t f = 0; f < soup.num_faces(); ++f) {
    std::vector<std::int64_t> corners;
    for (const std::int64_t corner : soup.face(f))
      if (const std::int64_t next = number[static_cast<std::size_t>(corner)];
          corners.empty() || corners.back() != next)
        corners.push_back(next);
    if (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
    if (corners.size() < 3) continue;
    result.corners.insert(result.corners.end(), corners.begin(), corners.end());
    result.end_face();
    result.tags.push_back(soup.tags[f]);
  }
  return result;
}

/// Whether the length is that of a binary file. (Some of them begin with "solid" all the same.)
bool is_binary(std::string_view bytes) {
  if (bytes.size() < preamble_size) return false;
  const auto count = load<std::uint32_t>(bytes.substr(header_size), std::endian::little);
  return bytes.size() == preamble_size + facet_size * std::size_t{count};
}

PolygonSoup parse_binary(std::string_view bytes) {
  CornerMerger merger;
  for (std::size_t facet = preamble_size; facet < bytes.size(); facet += facet_size) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      Vec3 x;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t at = facet + normal_size + (3 * corner + i) * sizeof(float);
        x[static_cast<Eigen::Index>(i)] = load<float>(bytes.substr(at), std::endian::little);
      }
      merger.add_corner(x);
    }
    merger.end_face(0);
  }
  return merger.take();
}

PolygonSoup parse_ascii(TextScanner& scanner) {
  CornerMerger merger;
  int num_solids = 0;
  bool is_solid_open = false;
  while (scanner.next_line()) {
    const std::string_view keyword = scanner.words()[0];
    if (keyword == "solid") {
      ++num_solids;
      is_solid_open = true;
    } else if (keyword == "endsolid") {
      is_solid_open = false;
    } else if (keyword == "vertex") {
      merger.add_corner(scanner.point(1));
    } else if (keyword == "endfacet") {
      require_corners(scanner, static_cast<std::int64_t>(merger.num_corners()));
      merger.end_face(num_solids - 1);
    } else if (keyword != "facet" && keyword != "outer" && keyword != "endloop") {
      scanner.fail("`{}` is no keyword of STL", printable(keyword));
    }
  }
  if (is_solid_open) scanner.fail("the file ends where `endsolid` is expected");
  return merger.take();
}

void store_point(std::string& bytes, const Vec3& x) {
  for (const double coordinate : x) store(bytes, static_cast<float>(coordinate));
}

/// Throws InvalidInput where single precision leaves a face no area or has no such number.
void require_single_precision(const std::filesystem::path& path, const SurfaceMesh& mesh) {
  SurfaceMesh rounded = mesh;
  for (Vec3& x : rounded.x) x = x.cast<float>().cast<double>();
  if (!is_finite(rounded) || find_degenerate_face(rounded))
    reject_input("{}: STL has single precision, too coarse for this surface; write .ply",
                 path.string());
}

}  // namespace

PolygonSoup parse_stl(const std::filesystem::path& path, std::string_view bytes) {
  if (is_binary(bytes)) return welded(parse_binary(bytes));
  TextScanner scanner(path, bytes);
  TextScanner first = scanner;
  if (!first.next_line() || first.words()[0] != "solid") {
    reject_input(
        "{}: not an STL file, or cut short: neither begins with `solid` nor has the length "
        "of a binary one",
        path.string());
  }
  return welded(parse_ascii(scanner));
}

std::string format_stl(const std::filesystem::path& path, const SurfaceMesh& mesh) {
  require_single_precision(path, mesh);
  std::string bytes = "STL, binary, written by Meniscus";
  bytes.resize(header_size, '\0');
  store(bytes, static_cast<std::uint32_t>(mesh.num_faces()));
  for (const FaceId f : mesh.faces.ids()) {
    store_point(bytes, face_area_vector(mesh, f).stableNormalized());
    for (const VertexId v : mesh.faces[f]) store_point(bytes, mesh.x[v]);
    store(bytes, std::uint16_t{0});
  }
  return bytes;
}

}  // namespace meniscus::io
