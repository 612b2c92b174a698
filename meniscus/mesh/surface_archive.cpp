#include "meniscus/mesh/surface_archive.hpp"

#include "meniscus/core/archive_entries.hpp"

namespace meniscus {
namespace {

std::string positions_path(const std::string& path) { return path + "/x"; }
std::string faces_path(const std::string& path) { return path + "/faces"; }

}  // namespace

void save(const SurfaceMesh& mesh, Archive& archive, const std::string& path) {
  archive.reals[positions_path(path)] = flat(mesh.x);
  std::vector<std::int64_t>& faces = archive.integers[faces_path(path)];
  for (const FaceVertices& f : mesh.faces)
    faces.insert(faces.end(), {f[0].value, f[1].value, f[2].value});
}

SurfaceMesh load_surface(const Archive& archive, const std::string& path) {
  SurfaceMesh mesh;
  mesh.x = vectors<VertexId>(entry_of_rows(archive.reals, positions_path(path), 3));
  const auto& faces = entry_of_rows(archive.integers, faces_path(path), 3);
  const auto vertex = [&](std::int64_t v) {
    if (v < 0 || v >= mesh.num_vertices())
      reject_input("checkpoint entry \"{}\" names vertex {} of {}", faces_path(path), v,
                   mesh.num_vertices());
    return VertexId{static_cast<std::int32_t>(v)};
  };
  for (std::size_t k = 0; k < faces.size(); k += 3)
    mesh.faces.add({vertex(faces[k]), vertex(faces[k + 1]), vertex(faces[k + 2])});
  return mesh;
}

}  // namespace meniscus
