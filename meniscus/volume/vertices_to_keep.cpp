#include "meniscus/volume/vertices_to_keep.hpp"

#include <algorithm>

#include "meniscus/linear/shared_work.hpp"

namespace meniscus {
namespace {

/// A vertex nearer than this to a surface, or to another one between the surfaces, is not kept, in
/// edges wanted there. With these the number of cells stays that of meshes from none. With 0.5 and
/// 0.6 it grows by a tenth over a run.
constexpr double kFromSurface = 0.6;
constexpr double kApart = 0.8;

/// The edge wanted at each vertex between the surfaces, 0 at those near or on a surface. Found by
/// the processes of the law together.
Field<TetVertexId, double> sizes_off_surfaces(const TetMesh& mesh, const SizeLaw& law) {
  const std::int32_t first_free = first_free_vertex(mesh).value;
  const auto count = static_cast<std::size_t>(mesh.num_vertices() - first_free);
  const std::vector<double> found =
      linear::shared_numbers(law.communicator(), count, 1, [&](std::size_t first, std::size_t end) {
        std::vector<double> sizes;
        sizes.reserve(end - first);
        for (const Vec3& x :
             mesh.x.span().subspan(static_cast<std::size_t>(first_free) + first, end - first)) {
          const SizeAt at = law.at(x);
          sizes.push_back(at.distance >= kFromSurface * at.size ? at.size : 0.0);
        }
        return sizes;
      });
  Field<TetVertexId, double> size(mesh.num_vertices(), 0.0);
  std::ranges::copy(found, size.begin() + first_free);
  return size;
}

/// Drops one of every two neighbours that are too near each other.
void thin_out(const TetMesh& mesh, Field<TetVertexId, double>& size) {
  for (const CellVertices& v : mesh.cells)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const double wanted = size[v[i]];
        if (wanted > 0.0 && size[v[j]] > 0.0 &&
            (mesh.x[v[i]] - mesh.x[v[j]]).squaredNorm() < kApart * kApart * wanted * wanted)
          size[v[i]] = 0.0;
      }
}

}  // namespace

std::vector<SizedVertex> vertices_to_keep(const TetMesh& mesh, const SizeLaw& law) {
  if (mesh.x.empty()) return {};
  Field<TetVertexId, double> size = sizes_off_surfaces(mesh, law);
  thin_out(mesh, size);
  std::vector<SizedVertex> kept;  // those with a size
  for (const TetVertexId v : mesh.x.ids())
    if (size[v] > 0.0) kept.push_back({mesh.x[v], size[v]});
  return kept;
}

}  // namespace meniscus
