#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "meniscus/core/fault.hpp"
#include "meniscus/mesh/carried_fields.hpp"
#include "meniscus/mesh/tet_mesh.hpp"
#include "meniscus/scene/imposed_flow.hpp"
#include "meniscus/scene/scalar.hpp"
#include "meniscus/scene/surfactant.hpp"
#include "meniscus/scene/viscosity.hpp"

namespace meniscus {

/// What fills one region. Region 0 is the matrix; region i + 1 is what interface i encloses.
struct Liquid {
  double viscosity = 1.0;  ///< over the matrix's [μ_out]
  double density = 0.0;    ///< Re times that over the matrix's [μ_out/(G R0²)]; 0: no inertia
  Vec3 body_force = Vec3::Zero();          ///< force per volume [μ_out G / R0]
  ViscosityLaw law = {};                   ///< multiplies the viscosity
  std::vector<ScalarLiquid> scalars = {};  ///< by scalar of the scene
};

/// A closed interface between the liquid inside it and the one outside. n points out.
struct Interface {
  int drop = 0;     ///< id in drops.csv: never reused
  int parent = -1;  ///< drop it came from in an event; −1 for a drop of the case
  SurfaceMesh mesh;
  RegionId inside, outside;
  /// Tension ratio / Ca: surface tension, of a surface with surfactant that at Γ = 1 [μ_out G R0];
  /// 0 for Ca = inf.
  double tension = 1.0;
  double C0 = 8.75;     ///< resolution: C0 = N0/4π in ρ = C0⟨κ⟩² (eq. 1 of hooper2001)
  double volume = 0.0;  ///< the volume every remesh restores [R0³]
  double initial_volume = 0.0;  ///< the reference of volume_drift
  SurfaceFields fields = {};    ///< what lives on it; of the same list on every interface
  /// Its concentration is the field `kSurfactantField` (interface_tension.hpp).
  std::optional<Surfactant> surfactant = {};
  /// What bulk scalars multiply the tension by at the vertices; empty: nothing.
  VertexField<double> tension_factor = {};
};

/// v given on a patch; `velocity` maps a point of the patch and a time to v [G R0].
struct ImposedVelocity {
  std::function<Vec3(const Vec3& x, double t)> velocity;
  bool is_linear_flow = false;  ///< v = G·x of the case's imposed flow: net flux exactly zero
};
/// n·v = 0 and no tangential traction (the z-faces of the shear box).
struct NoPenetration {};
/// T·n given, constant on the patch [μ_out G]: an open boundary.
struct ImposedTraction {
  Vec3 traction = Vec3::Zero();
};
using BoundaryCondition = std::variant<ImposedVelocity, NoPenetration, ImposedTraction>;

using PatchId = Id<struct PatchTag>;
struct Patch {
  std::string name;
  BoundaryCondition condition;
  /// The point of the smooth wall near a point between vertices; empty where the faces are the
  /// wall.
  std::function<Vec3(const Vec3& x)> on_smooth_wall = {};
  std::vector<ScalarCondition> scalars = {};  ///< by scalar of the scene
};

/// The closed surface around everything, its faces oriented outward, divided in tagged patches.
/// Where patches meet, a vertex obeys ImposedVelocity first, then every NoPenetration.
struct OuterBoundary {
  SurfaceMesh mesh;
  FaceField<PatchId> patch;
  Field<PatchId, Patch> patches;
};

/// All that a flow solver needs to know: the geometry at one instant, the liquids, the flow.
struct Scene {
  double Ca = 1.0;  ///< μ_out G R0/σ; infinite: no surface tension
  ImposedFlow flow;
  Field<RegionId, Liquid> liquids;  ///< by region
  std::vector<Interface> interfaces;
  std::vector<Scalar> scalars = {};
  /// What liquids with inertia begin with [G R0]; empty: the imposed flow.
  std::function<Vec3(const Vec3& x)> initial_velocity = {};
  bool is_unbounded = false;  ///< no outer boundary: boundary integrals only
  OuterBoundary boundary;
};

/// ∮_patches v·n dS of the imposed velocities at time t, interpolated linearly on the faces [G
/// R0³].
[[nodiscard]] double imposed_flux(const Scene& scene, double t);
[[nodiscard]] bool has_open_patch(const Scene& scene);
/// Whether a liquid has a density.
[[nodiscard]] bool has_inertia(const Scene& scene);
/// Numbers the regions afresh. Region i + 1 lies within interface i. Outside it lies that of the
/// innermost interface around it, found by the place of its first vertex; else region 0. Interfaces
/// must not meet.
void assign_regions(Scene& scene);
/// Names the first place where interfaces touch each other or the boundary, lie outside it, or nest
/// otherwise than `inside`/`outside` say. None when the scene is sound.
[[nodiscard]] std::optional<Fault> find_conflict(const Scene& scene);

}  // namespace meniscus
