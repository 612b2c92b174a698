#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "meniscus/core/fault.hpp"
#include "meniscus/mesh/surface_mesh.hpp"
#include "meniscus/mesh/surface_tree.hpp"
#include "meniscus/surface/constants.hpp"
#include "meniscus/surface/surface_fields.hpp"

namespace meniscus {

/// How far the number of vertices that a surface asks for may be from those it has, over some 12 of
/// them, before it is remeshed.
struct KeptDensity {
  double fewest = 0.7, most = 1.3;  ///< asked for, over those there
  double whole = 0.05;              ///< |asked for/there − 1| of the whole surface
};
/// Where a remeshed surface asks for new tetrahedra, and curved faces bear uneven vertices. Flat
/// ones do not: with these D in shear at Ca = 0.2 (110 vertices) is 4.2 % off instead of 2.9 %.
inline constexpr KeptDensity kKeptByCurvedElements{.fewest = 0.625, .most = 1.6, .whole = 0.1};

struct RemeshOptions {
  double C0 = 8.75;               ///< ρ = C0⟨κ⟩² (eq. 1); C0 = N0/4π
  double volume = 0.0;            ///< volume to restore [R0³]; 0: that of the surface as given
  bool restores_volume = true;    ///< false: the change is reported and left
  double edge_floor = 0.0;        ///< [R0] no edge is asked to be shorter
  double edge_ceiling = 1e300;    ///< [R0] no edge is asked to be longer
  double gradation = kGradation;  ///< largest |∇l0| of the rest length
  int min_vertices =
      kFewestVertices;  ///< however small or round the drop, its C0 is raised to give this many
  int max_sweeps = 20;
  /// Whether vertices end on splines (`SplinePatch`), O(h⁶), instead of the patches of
  /// `SmoothSurface`, O(h⁴): for smooth surfaces that are remeshed again and again.
  bool on_splines = false;
  /// Springs are at rest when every vertex is within this fraction of its l0 of its own rest. 0:
  /// what makes the result independent of the history, 0.006 (1000/N)^½ for N > 1000 vertices. A
  /// strain that varies over the whole surface moves no vertex by more than strain × l0/R.
  double spring_tolerance = 0.0;
  /// Further upper bound on the rest length at a point (gaps, user sizes) [R0]; may be empty.
  std::function<double(const Vec3& x)> size_bound = {};
  /// What else makes the result unfit (such as `find_self_intersection`); may be empty.
  std::function<std::optional<Fault>(const SurfaceMesh&)> find_fault = {};
  KeptDensity kept = {};    ///< what `is_fit` allows
  double neck_edges = 0.0;  ///< edges asked for around a neck or a thread; 0: none
  double gap_layers = 0.0;  ///< layers of tetrahedra asked for where sheets are close; 0: none
  /// Other surfaces that may be close; they must outlive the call.
  std::vector<const SurfaceTree*> neighbours = {};
  void validate() const;  ///< Throws InvalidInput naming field, value, range.
};

/// Options for a density of C0 = N0/4π vertices, edges of `edge_floor` [R0] or more, and a result
/// that does not meet itself. All options of the program start from these.
[[nodiscard]] RemeshOptions sound_remeshing(double C0, double edge_floor = 0.0);

/// On failure the surface was left as it was.
struct [[nodiscard]] RemeshReport : Report {
  int splits = 0, collapses = 0, flips = 0, sweeps = 0;
  double volume_change = 0.0;           ///< relative, by remeshing, before the correction
  double volume_shift = 0.0;            ///< largest shift of a vertex by the correction [R0]
  double volume_shift_over_edge = 0.0;  ///< of each vertex, over the mean edge there
  double min_angle_deg = 0.0;
  double expected_vertices = 0.0;  ///< ∮ρ dS of eq. 2 on the result
  FieldExcess field_excess = {};   ///< of conserved fields over the range they had
};

/// Rebuilds the triangulation of a closed surface for a vertex density ρ = C0⟨κ⟩²; restores its
/// volume. It adds and removes vertices, reconnects them (Delaunay) and moves them by springs
/// (cristini2001). Transactional: on failure the mesh is unchanged and the report says why.
RemeshReport remesh(SurfaceMesh& mesh, const RemeshOptions& options);
/// Remeshes a surface with its fields; on failure both are unchanged.
RemeshReport remesh(SurfaceMesh& mesh, const RemeshOptions& options, SurfaceFields& fields);

/// Whether a surface that has moved since it was remeshed may stay as it is. Then its vertices are
/// near their density (`has_fit_density`), and no face has an angle below 20°. Surfaces that cannot
/// be remeshed are unfit.
[[nodiscard]] bool is_fit(const SurfaceMesh& mesh, const RemeshOptions& options);

/// Mean length of the edges at each vertex [R0].
[[nodiscard]] VertexField<double> mean_edges(const SurfaceMesh& mesh);

}  // namespace meniscus
