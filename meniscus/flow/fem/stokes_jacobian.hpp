#pragma once

#include <array>
#include <vector>

#include "meniscus/flow/fem/node_graph.hpp"
#include "meniscus/flow/fem/stokes_problem.hpp"
#include "meniscus/linear/saddle_system.hpp"

namespace meniscus::fem {

/// The Jacobian of R(u) as a saddle system, assembled in place on a sparsity that is made once per
/// mesh topology. At constrained vertices the unknowns are in the constraint's frame.
class StokesJacobian {
 public:
  StokesJacobian(const TetMesh& mesh, const PressureSpace& pressure);

  /// Fills the matrices for the geometry, viscosities and constraints of the problem. Linear cost.
  void assemble(const StokesProblem& problem);
  /// A view of the last assembly.
  [[nodiscard]] linear::SaddleSystem system() const;

 private:
  void choose_laplacians(const Constraints& constraints);
  void add_free_cell(const StokesProblem& problem, CellId c);
  void add_constrained_cell(const StokesProblem& problem, CellId c);
  void add_pressure_blocks(const struct CellMatrices& matrices, CellId c);

  /// A scalar Laplacian with the vertices eliminated where a velocity component is fixed.
  struct Laplacian {
    std::vector<bool> is_fixed;
    std::vector<double> values;
  };

  PressureSpace pressure_;
  NodeGraph velocity_graph_, pressure_graph_;
  ScalarPattern A_pattern_, B_pattern_;
  std::vector<double> A_, B_, C_, pressure_mass_;
  std::vector<Laplacian> laplacians_;
  std::array<int, 3> laplacian_of_ = {0, 0, 0};
  bool constant_pressure_is_null_ = false;
};

}  // namespace meniscus::fem
