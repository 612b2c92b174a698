#pragma once

#include <functional>
#include <optional>
#include <span>

#include "meniscus/surface/carry_fields.hpp"
#include "meniscus/surface/remesh.hpp"

namespace meniscus {

/// A surface that takes the place of another, and the fields of that other.
struct Replacement {
  CarryingSurface surface;
  FieldExcess excess;
};

/// A shape in the place of a surface: at the volume asked for [R0³] (0: its own), with the fields
/// of the surface. None where it is unsound (`find_defect`).
[[nodiscard]] std::optional<Replacement> sound_replacement(const SurfaceMesh& mesh,
                                                           const SurfaceFields& fields,
                                                           const SurfaceMesh& shape, double volume);

/// One way to replace a surface that cannot be remeshed.
struct Remedy {
  std::function<std::optional<SurfaceMesh>()> shape;  ///< none where the remedy does not apply
  double volume = 0.0;         ///< to restore to the shape [R0³]; 0: its own is right
  bool keeps_shape = false;    ///< other triangles on the same faces, no less sound than they were
  double smoothed_over = 0.0;  ///< [R0] length that the whole surface is smoothed over
};

/// How a surface was remeshed, and what of it was replaced first.
struct [[nodiscard]] MendReport {
  RemeshReport remesh;
  bool is_mended = false;      ///< the shape or its triangles were changed first
  int closed_holes = 0;        ///< holes through the drop that went with a crevice
  double smoothed_over = 0.0;  ///< [R0] length that the whole surface was smoothed over
};

/// The policy of all repairs. Remedies are tried in their order, the mildest first. The first is
/// taken whose surface is sound, can be remeshed and has no more holes than there were. `mesh` and
/// `fields` become it. None, and they stay, where no remedy does.
[[nodiscard]] std::optional<MendReport> apply_first(SurfaceMesh& mesh, SurfaceFields& fields,
                                                    std::span<const Remedy> remedies,
                                                    const RemeshOptions& options);

}  // namespace meniscus
