#pragma once

#include <filesystem>
#include <string>

#include "meniscus/case/case.hpp"
#include "meniscus/mesh/shapes.hpp"

namespace meniscus {

/// Reads the surface file that a key names, mended if wished (`surface_of`), and makes its
/// coordinates dimensionless by [scale]. `warn` is told what was done to its faces.
/// Throws InvalidInput naming the line when the file cannot be read or the surface is not closed
/// or meets itself.
[[nodiscard]] TaggedSurface read_case_surface(const Case& c, const std::string& path,
                                              const FileShape& file, const WarningListener& warn);

/// The shape of one drop in the newest checkpoint-<step>.h5 of a run's folder. It is read from the
/// archive entries interfaces/<i>/x (3|V| reals), interfaces/<i>/faces (3|F| integers) and
/// interfaces/<i>/ids, the first of which is the drop's.
[[nodiscard]] SurfaceMesh read_run_surface(const Case& c, const std::string& path,
                                           const RunShape& shape);

/// The initial surface of a drop at its position, at the resolution of its N0.
[[nodiscard]] SurfaceMesh initial_surface(const Case& c, int drop, const WarningListener& warn);

}  // namespace meniscus
