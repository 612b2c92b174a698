#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "meniscus/core/vec.hpp"

namespace meniscus {

/// Points and faces of any number of corners, as files give them. Faces may be turned either way,
/// and nothing says how they hang together.
struct PolygonSoup {
  std::vector<Vec3> points;
  std::vector<std::int64_t> corners;  ///< numbers of points, face by face
  std::vector<std::size_t> ends;      ///< one past the last corner of each face
  std::vector<int> tags;              ///< one per face, or none

  [[nodiscard]] std::size_t num_faces() const { return ends.size(); }
  [[nodiscard]] std::span<const std::int64_t> face(std::size_t f) const {
    const std::size_t begin = f == 0 ? 0 : ends[f - 1];
    return std::span(corners).subspan(begin, ends[f] - begin);
  }
  /// Makes a face of the corners that were added since the last one.
  void end_face() { ends.push_back(corners.size()); }
};

}  // namespace meniscus
