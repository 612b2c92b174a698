#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "meniscus/core/vec.hpp"
#include "meniscus/evolve/drop_shape.hpp"
#include "meniscus/evolve/step_control.hpp"

namespace meniscus {

/// A bulk scalar as a whole.
struct ScalarTotals {
  double amount = 0.0;  ///< ∫γT dV [R0³]
  double boundary_rate =
      0.0;  ///< amount per time through the outer boundary, inwards, in the last step
  double source_rate = 0.0;           ///< amount per time of sources, in the last step
  double least = 0.0, largest = 0.0;  ///< of T at the nodes
};

/// The motion of liquids with inertia as a whole.
struct KineticTotals {
  double energy = 0.0;  ///< ½Σ∫ρv² dV [μ_out G R0³]
  double rate = 0.0;    ///< ∫ρv·Dv/Dt, what the flow gives it per time [μ_out G² R0³]
  /// What the transfer to a new mesh took in the step that led here.
  double momentum_lost = 0.0;  ///< |Σ∫ρv dV| over Σ∫ρ|v| dV
  double energy_lost = 0.0;    ///< [μ_out G R0³]
};

/// A row of history.csv: the state at t_step (docs/notation.md).
struct HistoryRow {
  std::int64_t step = 0;
  double t = 0.0, dt = 0.0;  ///< dt: the step that led here; 0 at step 0
  int drops = 0;
  std::int64_t surface_nodes = 0;
  std::optional<std::int64_t> nodes, tetrahedra;
  std::optional<double> min_gap, min_dihedral_deg;
  int linear_iterations = 0;                    ///< iterations of all solves since the previous row
  std::optional<double> power_in, dissipation;  ///< empty in an unbounded liquid
  double surface_rate = 0.0;
  std::optional<Mat3> stress;        ///< empty where the matrix is not Newtonian
  std::optional<double> step_error;  ///< estimate, of the step that led here [shortest edge]
  std::optional<StepBound> step_bound;
  std::optional<bool> is_mesh_kept;      ///< by the step that led here
  std::vector<ScalarTotals> scalars;     ///< by scalar of the scene
  std::optional<KineticTotals> kinetic;  ///< of liquids with inertia

  [[nodiscard]] std::optional<double> power_residual() const {
    if (!power_in || !dissipation) return std::nullopt;
    return *power_in - *dissipation - surface_rate - (kinetic ? kinetic->rate : 0.0);
  }
};

/// The surfactant on a drop. Concentrations are over the initial one, tensions over that at it.
struct SurfactantSpread {
  double amount = 0.0;             ///< Σ Γ_v S_v over the vertices [R0²]
  double least = 0.0, most = 0.0;  ///< concentrations, as interpolated over the faces
  double least_tension = 0.0;      ///< where the concentration is largest
};

/// A bulk scalar on a drop.
struct ScalarOnDrop {
  double amount = 0.0;  ///< ∫γT dV over the liquid just inside [R0³]
  /// Sherwood or Nusselt number 2R_d × mean outward flux density/(mean of the outer side −
  /// reference), the flux over the matrix's diffusivity. It is empty where that difference is zero.
  std::optional<double> transfer_number;
};

/// How a drop of liquids with inertia moves.
struct DropMotion {
  Vec3 velocity = Vec3::Zero();  ///< the mean over its volume [G R0]
  /// 2R ρ_out |velocity − v_imposed|/μ_out, R the radius of the sphere of its volume and v_imposed
  /// the imposed flow at its centroid.
  double reynolds = 0.0;
  double kinetic_energy = 0.0;  ///< ½∫ρv² dV [μ_out G R0³]
  double sphericity = 0.0;      ///< area of the sphere of its volume over its own
};

struct DropRow {
  int drop = 0;
  int parent = -1;
  double volume_drift = 0.0;       ///< V/V0 − 1
  double volume_correction = 0.0;  ///< largest shift by the last restoration of volume [R0]
  DropShape shape;
  /// (area/π)^½ of the section of the thinnest neck thinner than half of the sphere of the same
  /// volume [R0]. It is empty where there is none, and in runs without breakup.
  std::optional<double> neck_radius;
  std::optional<SurfactantSpread> surfactant;  ///< empty where there is none
  std::vector<ScalarOnDrop> scalars;           ///< by scalar of the scene
  std::optional<DropMotion> motion;            ///< of liquids with inertia
};

}  // namespace meniscus
