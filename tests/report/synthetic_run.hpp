#pragma once

#include <filesystem>

namespace meniscus::test {

struct SyntheticRun {
  int num_drops = 1;
  int num_frames = 11;  ///< of the surface
  int num_steps = 60;   ///< rows of the history, less one
  int num_vertices = 200;
  int num_volume_frames = 0;
  bool is_curved = false;    ///< whether the ellipsoids' faces are
  bool has_scalars = false;  ///< a temperature, and a dye whose concentration jumps
};

/// Writes the files of a run as the program does, from a formula instead of a flow: balls that
/// stretch to ellipsoids of the same volume and turn towards the flow, with curvature exact.
void write_synthetic_run(const std::filesystem::path& folder, const SyntheticRun& run);

}  // namespace meniscus::test
