#pragma once

#include <filesystem>
#include <vector>

#include "meniscus/evolve/evolution.hpp"
#include "meniscus/io/vtk_file.hpp"

namespace meniscus {

/// Throws InvalidInput when a bulk scalar or a field has the name of an array that frames always
/// hold. So it does when a field has that of a scalar.
void check_field_names(const Evolution& evolution);

/// The arrays of a surface frame: on vertices and faces of all interfaces, one after the other.
[[nodiscard]] io::MeshData surface_arrays(const Evolution& evolution);
/// The arrays of a volume frame.
struct VolumeArrays {
  io::MeshData data;
  std::vector<io::NamedArray> on_corners;  ///< by cell corner: what is double valued on interfaces
};
[[nodiscard]] VolumeArrays volume_arrays(const Evolution& evolution);

/// Writes all interfaces with curvature κ, normal velocity, velocity, vertex density, drop id,
/// carried fields and bulk scalars. The pressure jump p_out − p_in is written where the solver has
/// a pressure. Flat faces make a .vtp, curved ones a .vtu of quadratic triangles. `path` has no
/// extension; returns the file's, with it.
std::filesystem::path write_surface_frame(const std::filesystem::path& path,
                                          const Evolution& evolution);
/// Writes the volume mesh with velocity, pressure and concentrations of species (double valued on
/// interfaces), region, drop id, cell quality, carried fields and temperatures. Cells with curved
/// edges, those of quadratic elements at interfaces and walls, are quadratic.
void write_volume_frame(const std::filesystem::path& path, const Evolution& evolution);

}  // namespace meniscus
