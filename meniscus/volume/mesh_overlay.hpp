#pragma once

#include <memory>
#include <vector>

#include "meniscus/volume/cell_tree.hpp"
#include "meniscus/volume/region_groups.hpp"

namespace meniscus {

/// What an old and a new cell have in common.
struct Intersection {
  CellId before, after;
  VolumeMoments part;
};

/// A part of a cell that the other mesh does not cover, as an amount given or taken at a cell.
struct Gap {
  CellId cell;     ///< the cell that has it
  CellId nearest;  ///< the cell of the other mesh nearest to the part
  Vec3 at;         ///< a point of `nearest` near the part
  double volume = 0.0;
};

/// A mesh with its cells by group, and a tree over those of each group.
struct GroupedMesh {
  const TetMesh& mesh;
  const CellField<std::int32_t>& group;
  std::vector<std::vector<CellId>> cells;
  CellField<double> volume;
  std::vector<std::unique_ptr<CellTree>> trees;

  GroupedMesh(const TetMesh& tetrahedra, const CellField<std::int32_t>& groups,
              std::int32_t num_groups);
  [[nodiscard]] const CellTree& tree(std::int32_t g) const {
    return *trees[static_cast<std::size_t>(g)];
  }
};

/// What all fields share of a change from one mesh to another. The meshes must outlive it.
struct MeshOverlay {
  RegionGroups groups;
  GroupedMesh before, after;
  std::vector<Intersection> parts;
  std::vector<Gap> uncovered, lost;  ///< of the new mesh; of the old one

  MeshOverlay(const TetMesh& old, const TetMesh& now, const RegionSources& sources);
  MeshOverlay(const MeshOverlay&) = delete;  // its meshes refer to its groups
  /// Finds the intersections and gaps.
  void intersect();
};

}  // namespace meniscus
