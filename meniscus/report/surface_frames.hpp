#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "meniscus/mesh/surface_mesh.hpp"
#include "meniscus/report/run_data.hpp"

namespace meniscus::report {

/// A field that a reader can colour the interface by.
struct SurfaceQuantity {
  const char* name;   ///< of the array in the file
  const char* label;  ///< for readers
  const char* unit;
};
/// All of them, the one shown first in front.
[[nodiscard]] std::span<const SurfaceQuantity> surface_quantities();

/// The values of one of them.
struct SurfaceField {
  std::string name;
  VertexField<double> values;
};

/// The interface of one moment, with what colours it.
struct SurfaceFrame {
  double t = 0.0;
  SurfaceMesh mesh;
  VertexField<double> curvature;          ///< kappa = k1 + k2 [1/R0]; empty if the file has none
  FaceField<int> drop;                    ///< id of the drop each face belongs to
  std::vector<SurfaceField> fields = {};  ///< those of `surface_quantities` that the file has
};

/// At most `count` of the frames, about evenly spaced in time, the first and the last among them.
[[nodiscard]] std::vector<io::PvdEntry> spread_frames(std::span<const io::PvdEntry> frames,
                                                      int count);
/// The frame nearest to each of the times, each once.
[[nodiscard]] std::vector<io::PvdEntry> nearest_frames(std::span<const io::PvdEntry> frames,
                                                       std::span<const double> times);

/// Reads one frame. Throws InvalidInput naming the file and the fault.
[[nodiscard]] SurfaceFrame load_surface(const std::filesystem::path& path, double t);
/// Reads frames of a run; those that cannot be read join its faults instead.
[[nodiscard]] std::vector<SurfaceFrame> load_surfaces(RunData& run,
                                                      std::span<const io::PvdEntry> frames);

/// A mesh with about `num_faces` faces at most: vertices in one cell of a grid become their mean.
/// For pictures only: it need not be a manifold. Returned as it is when it is small enough.
[[nodiscard]] SurfaceFrame coarse_frame(const SurfaceFrame& frame, int num_faces);

}  // namespace meniscus::report
