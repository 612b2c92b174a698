#pragma once

#include <string>

#include "meniscus/linear/communicator.hpp"
#include "meniscus/linear/saddle_solver.hpp"
#include "meniscus/volume/tetrahedralize.hpp"

namespace meniscus::fem {

/// The pairs of spaces: velocity, then pressure.
enum class Elements {
  p1_p1,  ///< linear and linear, stabilised (PSPG): the paper's
  p2_p1,  ///< quadratic and linear (Taylor–Hood), isoparametric: curved at curved surfaces
};

/// The volume mesh that elements are worth. The linear ones take the paper's; the quadratic ones,
/// whose error is that of the cells around the drops, take small cells there.
[[nodiscard]] inline VolumeMeshOptions suited_volume_mesh(Elements elements) {
  VolumeMeshOptions options;
  if (elements == Elements::p1_p1) return options;
  options.grading = Grading::gaussian;
  // The relaxation's error falls with the cells' volume, and is below 5e-4 for 400 vertices on the
  // drop with 1.5 (docs/validation-stokes.md).
  options.cell_volume = 1.5;
  options.curves_interfaces = true;
  return options;
}

/// Discrete forms of the capillary force Ca⁻¹∫κ n·φ dS (§4.2 of hooper2001).
enum class CapillaryForm {
  weak,      ///< ∫(I − nn):∇φ dS, eq. 15
  nodal,     ///< κ_i n_i ΔS_i with κ, n of the paraboloid fit, eqs 16–17
  balanced,  ///< ∫κ_h φ n dS, κ_h the P1 field of fitted κ, n of the faces: exact zero flow for
             ///< constant κ
};

using LinearSolver = linear::SaddleMethod;

struct Options {
  Elements elements = Elements::p1_p1;
  CapillaryForm capillary = CapillaryForm::weak;
  LinearSolver linear = LinearSolver::block;
  double rtol = 1e-6;  ///< relative residual of the linear solve
  int max_iterations = 2000;
  linear::Processes processes = linear::Processes::alone;
  std::string petsc_options;  ///< further PETSc options, as on its command line
};

}  // namespace meniscus::fem
