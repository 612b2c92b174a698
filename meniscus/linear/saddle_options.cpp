#include "meniscus/linear/saddle_options.hpp"

#include <fmt/format.h>

#include "meniscus/linear/petsc_objects.hpp"

namespace meniscus::linear {
namespace {

// For systems with a consistent mass matrix: three Chebyshev steps on [1/2, 5/2]. That is the
// spectrum of the mass matrix of linear tetrahedra over its diagonal (wathen1987). They reduce the
// error to 0.11.
constexpr const char* kPressureMass =
    " -p_ksp_type chebyshev -p_ksp_max_it 3 -p_ksp_norm_type none"
    " -p_ksp_chebyshev_eigenvalues 0.5,2.5 -p_pc_type jacobi";

}  // namespace

bool has_hypre() {
  PetscBool has = PETSC_FALSE;
  petsc_check(PetscHasExternalPackage("hypre", &has), "PetscHasExternalPackage");
  return has == PETSC_TRUE;
}

std::string multigrid_options(const std::string& prefix, bool is_hypre) {
  if (!is_hypre) return fmt::format(" -{0}pc_type gamg -{0}pc_gamg_threshold 0.02", prefix);
  // HMIS coarsening, ext+i interpolation of at most 4 entries, one forward Gauss–Seidel sweep
  // before and one backward sweep after. This is the fastest variant tried on scalar Laplacians of
  // tetrahedral meshes, and as good per iteration as an exact solve.
  return fmt::format(
      " -{0}pc_type hypre -{0}pc_hypre_boomeramg_coarsen_type HMIS"
      " -{0}pc_hypre_boomeramg_interp_type ext+i -{0}pc_hypre_boomeramg_P_max 4"
      " -{0}pc_hypre_boomeramg_relax_type_down l1-Gauss-Seidel"
      " -{0}pc_hypre_boomeramg_relax_type_up backward-l1-Gauss-Seidel",
      prefix);
}

std::string aggressive_coarsening(const std::string& prefix) {
  return fmt::format(" -{0}pc_hypre_boomeramg_agg_nl 1 -{0}pc_hypre_boomeramg_agg_num_paths 2",
                     prefix);
}

std::string default_options(SaddleMethod method, bool is_by_degree, bool is_hypre) {
  const std::string algebraic = is_by_degree ? "v_mg_coarse_" : "v_";
  std::string multigrid = " -v_ksp_type preonly" + multigrid_options(algebraic, is_hypre);
  // One smoothing step gives as few iterations as two or three, and is the cheapest.
  if (is_by_degree)
    multigrid +=
        " -v_mg_levels_ksp_type chebyshev -v_mg_levels_ksp_max_it 1 -v_mg_levels_pc_type jacobi"
        " -v_mg_coarse_ksp_type preonly";
  const std::string pressure_laplacian = " -l_ksp_type preonly" + multigrid_options("l_", is_hypre);
  switch (method) {
    case SaddleMethod::block:
      return "-ksp_type fgmres -ksp_gmres_restart 60"
             " -ksp_gmres_cgs_refinement_type refine_ifneeded" +
             multigrid + (is_hypre ? aggressive_coarsening(algebraic) : "") + kPressureMass +
             pressure_laplacian;
    case SaddleMethod::minres:
      return "-ksp_type minres" + multigrid + kPressureMass + pressure_laplacian;
    case SaddleMethod::paper_gmres:
      return "-ksp_type gmres -ksp_gmres_restart 100 -ksp_pc_side right";
    case SaddleMethod::mumps:
      break;
  }
  return "-ksp_type fgmres -f_ksp_type preonly -f_pc_type cholesky"
         " -f_pc_factor_mat_solver_type mumps -f_mat_mumps_icntl_14 50";
}

std::string name(SaddleMethod method) {
  switch (method) {
    case SaddleMethod::block:
      return "block";
    case SaddleMethod::paper_gmres:
      return "paper-gmres";
    case SaddleMethod::minres:
      return "minres";
    case SaddleMethod::mumps:
      break;
  }
  return "mumps";
}

}  // namespace meniscus::linear
