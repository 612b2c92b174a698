#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "meniscus/core/vec.hpp"
#include "meniscus/evolve/drop_shape.hpp"
#include "meniscus/evolve/step_control.hpp"

namespace meniscus {

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
  std::optional<bool> is_mesh_kept;  ///< by the step that led here

  [[nodiscard]] std::optional<double> power_residual() const {
    if (!power_in || !dissipation) return std::nullopt;
    return *power_in - *dissipation - surface_rate;
  }
};

/// The surfactant on a drop. Concentrations are over the initial one, tensions over that at it.
struct SurfactantSpread {
  double amount = 0.0;             ///< Σ Γ_v S_v over the vertices [R0²]
  double least = 0.0, most = 0.0;  ///< concentrations, as interpolated over the faces
  double least_tension = 0.0;      ///< where the concentration is largest
};

struct DropRow {
  int drop = 0;
  int parent = -1;
  double volume_drift = 0.0;       ///< V/V0 − 1
  double volume_correction = 0.0;  ///< largest shift by the last restoration of volume [R0]
  DropShape shape;
  /// (area/π)^½ of the section of the thinnest neck thinner than half of the sphere of the same
  /// volume [R0]; empty where there is none, and in runs without breakup.
  std::optional<double> neck_radius;
  std::optional<SurfactantSpread> surfactant;  ///< empty where there is none
};

}  // namespace meniscus
