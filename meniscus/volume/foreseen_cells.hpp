#pragma once

#include <functional>

#include "meniscus/scene/scene.hpp"
#include "meniscus/volume/tetrahedralize.hpp"

namespace meniscus {

/// How many tetrahedra a mesh will have, before it is made.
struct ForeseenCells {
  double number = 0.0;      ///< within a factor of 3; a lower bound where it is too many
  Vec3 finest{0, 0, 0};     ///< where the shortest edge is wanted
  double least_size = 0.0;  ///< the shortest edge wanted [R0]
  [[nodiscard]] bool is_too_many() const;
};

/// The largest number of cells that is made: a mesh of three million vertices. TetGen takes some 8
/// GB for it and the flow more than ten times as much.
inline constexpr double kMostCells = 2e7;

/// ∫ dV/(cell_volume h³/(6√2)) over the box around the outer boundary, and what the vertices of the
/// surfaces take at least. h = size(x) is taken constant over boxes of a few h. Ends where it
/// exceeds `kMostCells`; a size that is no positive number, or below the precision of the
/// coordinates, counts as too many.
[[nodiscard]] ForeseenCells foresee_cells(const Scene& scene,
                                          const std::function<double(const Vec3&)>& size,
                                          double cell_volume);

/// Says that there would be too many, with the place.
[[nodiscard]] std::string too_many(const ForeseenCells& cells);

}  // namespace meniscus
