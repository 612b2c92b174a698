#include "meniscus/volume/mesh_overlay.hpp"

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

// Below this share of a cell what its intersections miss is their round-off, not space.
constexpr double kLeastShare = 1e-9;

CellField<double> cell_volumes(const TetMesh& mesh) {
  CellField<double> volume;
  for (const CellId c : mesh.cells.ids()) {
    volume.add(signed_volume(mesh, c));
    MENISCUS_ASSERT(volume[c] > 0.0, "cell {} of volume {}", c.value, volume[c]);
  }
  return volume;
}

CellField<HalfSpaceTet> shapes(const TetMesh& mesh) {
  CellField<HalfSpaceTet> all;
  for (const CellId c : mesh.cells.ids()) all.add(HalfSpaceTet(corners(mesh, c)));
  return all;
}

std::vector<Intersection> intersections(const GroupedMesh& before, const GroupedMesh& after) {
  const CellField<HalfSpaceTet> old_shapes = shapes(before.mesh), new_shapes = shapes(after.mesh);
  std::vector<Intersection> all;
  for (const CellId c : after.mesh.cells.ids()) {
    const HalfSpaceTet& shape = new_shapes[c];
    for (const CellId old : before.tree(after.group[c]).near(shape.corners())) {
      const VolumeMoments part = tet_overlap(old_shapes[old], shape);
      if (part.volume > 0.0) all.push_back({old, c, part});
    }
  }
  return all;
}

/// What the intersections leave of the cells of `self`; `cell_of` picks its cell of each.
template <class CellOf>
std::vector<Gap> find_gaps(const GroupedMesh& self, const GroupedMesh& other,
                           const std::vector<Intersection>& parts, const CellOf& cell_of) {
  CellField<VolumeMoments> covered(self.mesh.num_cells());
  for (const Intersection& i : parts) {
    covered[cell_of(i)].volume += i.part.volume;
    covered[cell_of(i)].moment += i.part.moment;
  }
  std::vector<Gap> gaps;
  for (const CellId c : self.mesh.cells.ids()) {
    const double volume = self.volume[c] - covered[c].volume;
    if (volume <= kLeastShare * self.volume[c]) continue;
    const Vec3 moment = tet_moments(corners(self.mesh, c)).moment - covered[c].moment;
    const Vec3 at = closest_point(corners(self.mesh, c), moment / volume).point;
    const CellTree::Hit hit = other.tree(self.group[c]).closest(at);
    gaps.push_back({c, hit.cell, hit.at.point, volume});
  }
  return gaps;
}

}  // namespace

GroupedMesh::GroupedMesh(const TetMesh& tetrahedra, const CellField<std::int32_t>& groups,
                         std::int32_t num_groups)
    : mesh(tetrahedra),
      group(groups),
      cells(cells_by_group(groups, num_groups)),
      volume(cell_volumes(tetrahedra)) {
  for (const auto& members : cells) trees.push_back(std::make_unique<CellTree>(mesh, members));
}

MeshOverlay::MeshOverlay(const TetMesh& old, const TetMesh& now, const RegionSources& sources)
    : groups(group_regions(old, now, sources)),
      before(old, groups.before, groups.num_groups),
      after(now, groups.after, groups.num_groups) {}

void MeshOverlay::intersect() {
  parts = intersections(before, after);
  uncovered = find_gaps(after, before, parts, [](const Intersection& i) { return i.after; });
  lost = find_gaps(before, after, parts, [](const Intersection& i) { return i.before; });
}

}  // namespace meniscus
