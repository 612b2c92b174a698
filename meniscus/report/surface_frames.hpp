#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "meniscus/mesh/surface_mesh.hpp"
#include "meniscus/report/run_data.hpp"

namespace meniscus::report {

/// The arrays with one value for each of `size` points.
[[nodiscard]] std::vector<const io::NamedArray*> one_value_arrays(
    const std::vector<io::NamedArray>& arrays, std::size_t size);

/// The values of one quantity on a surface.
struct SurfaceField {
  std::string name;
  VertexField<double> values;
};

/// The interface at one time with its fields.
struct SurfaceFrame {
  double t = 0.0;
  SurfaceMesh mesh;
  FaceField<int> drop;                    ///< id of the drop each face belongs to
  std::vector<SurfaceField> fields = {};  ///< all arrays of one value per vertex
  /// The points over the middles of the edges 01, 12, 20 of curved faces; empty where all are flat.
  FaceField<std::array<Vec3, 3>> middles = {};
};

/// All frames, or `count` about evenly spaced in their order, including the first and the last.
[[nodiscard]] std::vector<io::PvdEntry> evenly_spaced_frames(std::span<const io::PvdEntry> frames,
                                                             int count);
/// Numbers of `count` > 1 of `size` > `count` things, evenly spaced, the first and the last too.
[[nodiscard]] std::vector<std::size_t> evenly_spaced_numbers(std::size_t size, std::size_t count);
/// The frames nearest to the given times, without repetition.
[[nodiscard]] std::vector<io::PvdEntry> nearest_frames(std::span<const io::PvdEntry> frames,
                                                       std::span<const double> times);

/// Reads one frame. Throws InvalidInput naming the file and the fault.
[[nodiscard]] SurfaceFrame load_surface(const std::filesystem::path& path, double t);
/// Reads frames of a run. Unreadable files are added to the run's faults instead.
[[nodiscard]] std::vector<SurfaceFrame> load_surfaces(RunData& run,
                                                      std::span<const io::PvdEntry> frames);

/// A frame with at most about `num_faces` faces: the vertices in one cell of a grid become their
/// mean, and faces are flat. For pictures only: the result may not be a manifold. A frame that is
/// small enough is returned unchanged.
[[nodiscard]] SurfaceFrame coarse_frame(const SurfaceFrame& frame, int num_faces);

}  // namespace meniscus::report
