#pragma once

#include <vector>

#include "meniscus/flow/flow_solver.hpp"
#include "meniscus/io/vtk_file.hpp"

namespace meniscus {

/// The values of bulk scalars on a volume mesh, under the scalars' names.
struct ScalarArrays {
  std::vector<io::NamedArray> on_vertices;  ///< T of heat
  std::vector<io::NamedArray> on_corners;   ///< c = γT of species by cell corner, as γ jumps
};
/// `scalars` are those of the scene on its mesh; none where a mesh has not got them yet.
[[nodiscard]] ScalarArrays scalars_in_volume(const Scene& scene, const TetMesh& mesh,
                                             const BulkScalars& scalars);

/// The values of bulk scalars at the vertices of all interfaces, one interface after the other.
/// They are T of heat, c of a species on the outer side.
[[nodiscard]] std::vector<io::NamedArray> scalars_on_interfaces(const Scene& scene,
                                                                const TetMesh& mesh,
                                                                const BulkScalars& scalars);

}  // namespace meniscus
