#include "meniscus/mesh/box_tree.hpp"

#include <numeric>

#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus {

Box bounding_box(const SurfaceMesh& mesh) {
  Box box;
  for (const Vec3& x : mesh.x) box.extend(x);
  return box;
}

BoxTree::BoxTree(std::span<const Box> boxes) : boxes_(boxes.begin(), boxes.end()) {
  std::vector<int> indices(boxes_.size());
  std::iota(indices.begin(), indices.end(), 0);
  tree_.init(indices.begin(), indices.end(), boxes_.begin(), boxes_.end());
}

std::vector<std::size_t> BoxTree::earlier_within(std::size_t i, double reach) const {
  std::vector<std::size_t> earlier;
  visit_within(boxes_[i], reach, [&](std::size_t j) {
    if (j < i) earlier.push_back(j);
  });
  std::ranges::sort(earlier);
  return earlier;
}

}  // namespace meniscus
