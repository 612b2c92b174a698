#pragma once

#include <span>
#include <vector>

#include "meniscus/mesh/surface_mesh.hpp"
#include "meniscus/report/run_data.hpp"

namespace meniscus::report {

/// The interface of one moment, with what colours it.
struct SurfaceFrame {
  double t = 0.0;
  SurfaceMesh mesh;
  VertexField<double> curvature;  ///< kappa = k1 + k2 [1/R0]; empty if the file has none
  FaceField<int> drop;            ///< id of the drop each face belongs to
};

/// At most `count` of the frames, about evenly spaced in time, the first and the last among them.
[[nodiscard]] std::vector<io::PvdEntry> spread_frames(std::span<const io::PvdEntry> frames,
                                                      int count);
/// The frame nearest to each of the times, each once.
[[nodiscard]] std::vector<io::PvdEntry> nearest_frames(std::span<const io::PvdEntry> frames,
                                                       std::span<const double> times);

/// Reads frames of a run; those that cannot be read join its faults instead.
[[nodiscard]] std::vector<SurfaceFrame> load_surfaces(RunData& run,
                                                      std::span<const io::PvdEntry> frames);

/// A mesh with about `num_faces` faces at most: vertices in one cell of a grid become their mean.
/// For pictures only: it need not be a manifold. Returned as it is when it is small enough.
[[nodiscard]] SurfaceFrame coarsened(const SurfaceFrame& frame, int num_faces);

}  // namespace meniscus::report
