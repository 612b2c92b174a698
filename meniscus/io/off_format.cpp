#include "meniscus/io/surface_formats.hpp"
#include "meniscus/io/text_scanner.hpp"

namespace meniscus::io {

PolygonSoup parse_off(const std::filesystem::path& path, std::string_view bytes) {
  TextScanner scanner(path, bytes);
  scanner.require_line("`OFF`");
  // COFF and NOFF add colours and normals after the coordinates; they are passed over.
  const std::string_view kind = scanner.words()[0];
  if (kind != "OFF" && kind != "COFF" && kind != "NOFF") scanner.fail("not an OFF file");
  const bool are_counts_here = scanner.words().size() > 1;
  if (!are_counts_here) scanner.require_line("the number of points");
  const std::size_t first = are_counts_here ? 1 : 0;
  const std::int64_t num_points = scanner.integer(first), num_faces = scanner.integer(first + 1);

  PolygonSoup soup;
  for (std::int64_t i = 0; i < num_points; ++i) {
    scanner.require_line("a point");
    soup.points.push_back(scanner.point(0));
  }
  for (std::int64_t f = 0; f < num_faces; ++f) {
    scanner.require_line("a face");
    const std::int64_t num_corners = scanner.integer(0);
    require_corners(scanner, num_corners);
    for (std::int64_t k = 1; k <= num_corners; ++k) {
      soup.corners.push_back(scanner.integer(static_cast<std::size_t>(k)));
    }
    soup.end_face();
  }
  return soup;
}

std::string format_off(const SurfaceMesh& mesh) {
  std::string text = fmt::format("OFF\n{} {} 0\n", mesh.num_vertices(), mesh.num_faces());
  for (const Vec3& x : mesh.x) text += fmt::format("{} {} {}\n", x[0], x[1], x[2]);
  for (const FaceVertices& f : mesh.faces) {
    text += fmt::format("3 {} {} {}\n", f[0].value, f[1].value, f[2].value);
  }
  return text;
}

}  // namespace meniscus::io
