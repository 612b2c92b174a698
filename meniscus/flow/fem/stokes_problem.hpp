#pragma once

#include <vector>

#include "meniscus/flow/fem/constraints.hpp"
#include "meniscus/mesh/tet_mesh.hpp"

namespace meniscus::fem {

/// One instant of two-phase Stokes flow, ready to discretise:
///   ∫(−p∇·φ + 2μ D(v):D(φ)) − ∫f·φ − load(φ) = 0   for every φ that vanishes where v is fixed,
///   −∫ψ∇·v − Σ_K τ∫∇ψ·(∇p − f) = 0                 for every ψ
/// (eqs 10, 11 of hooper2001 with 2μ D:D and a consistent stabilisation).
struct StokesProblem {
  explicit StokesProblem(const TetMesh& on)
      : mesh(on),
        viscosity(on.num_cells(), 1.0),
        body_force(on.num_cells(), Vec3::Zero()),
        load(on.num_vertices(), Vec3::Zero()),
        constraints(on.num_vertices()) {}

  const TetMesh& mesh;
  CellField<double> viscosity;    ///< [μ_out]
  CellField<Vec3> body_force;     ///< f [μ_out G / R0]
  Field<TetVertexId, Vec3> load;  ///< further forces on the fluid, by vertex [μ_out G R0²]
  Constraints constraints;
  bool has_open_boundary = false;  ///< otherwise the pressure is known up to a constant
};

/// v at the vertices, p at the nodes of the pressure space.
struct StokesState {
  Field<TetVertexId, Vec3> v;  ///< [G R0]
  std::vector<double> p;       ///< [μ_out G]
};

}  // namespace meniscus::fem
