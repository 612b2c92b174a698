#include <algorithm>

#include "meniscus/io/surface_formats.hpp"
#include "meniscus/io/text_scanner.hpp"

namespace meniscus::io {
namespace {

/// The point of a corner "v", "v/vt", "v//vn" or "v/vt/vn": counted from 1, or back from the last
/// point if negative.
std::int64_t corner_point(const TextScanner& scanner, std::string_view word,
                          std::size_t num_points) {
  const std::int64_t index = scanner.integer(word.substr(0, word.find('/')));
  if (index == 0) scanner.fail("a corner names point 0; points count from 1");
  return index > 0 ? index - 1 : static_cast<std::int64_t>(num_points) + index;
}

/// The rank of a group among those that have faces, in the order they first get one.
int group_tag(std::vector<std::string_view>& groups, std::string_view group) {
  const auto found = std::ranges::find(groups, group);
  const auto tag = static_cast<int>(found - groups.begin());
  if (found == groups.end()) groups.push_back(group);
  return tag;
}

}  // namespace

PolygonSoup parse_obj(const std::filesystem::path& path, std::string_view bytes) {
  TextScanner scanner(path, bytes);
  PolygonSoup soup;
  std::vector<std::string_view> groups;
  std::string_view group;
  while (scanner.next_line()) {
    const std::vector<std::string_view>& words = scanner.words();
    if (words[0] == "v") soup.points.push_back(scanner.point(1));
    if (words[0] == "g") group = words.size() > 1 ? words[1] : std::string_view();
    if (words[0] != "f") continue;  // normals, texture, materials, lines: not a surface's shape
    require_corners(scanner, static_cast<std::int64_t>(words.size()) - 1);
    for (std::size_t k = 1; k < words.size(); ++k) {
      soup.corners.push_back(corner_point(scanner, words[k], soup.points.size()));
    }
    soup.end_face();
    soup.tags.push_back(group_tag(groups, group));
  }
  return soup;
}

std::string format_obj(const SurfaceMesh& mesh) {
  std::string text;
  for (const Vec3& x : mesh.x) text += fmt::format("v {} {} {}\n", x[0], x[1], x[2]);
  for (const FaceVertices& f : mesh.faces) {
    text += fmt::format("f {} {} {}\n", f[0].value + 1, f[1].value + 1, f[2].value + 1);
  }
  return text;
}

}  // namespace meniscus::io
