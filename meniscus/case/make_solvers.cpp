#include "meniscus/case/case.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/flow/bem/boundary_integral_flow.hpp"
#include "meniscus/flow/fem/finite_element_flow.hpp"
#include "meniscus/transport/bulk/finite_element_scalars.hpp"

namespace meniscus {

CaseSolvers make_solvers(const Case& c) {
  MENISCUS_ASSERT((c.method == FlowMethod::boundary_integral) ==
                      (c.domain.shape == DomainCase::Shape::unbounded),
                  "elements need a boundary, boundary integrals have none");
  if (c.method == FlowMethod::boundary_integral)
    return {bem::make_boundary_integral_flow(c.boundary_integral), nullptr};
  auto elements = std::make_shared<fem::KnownElements>(c.flow_solver.elements);
  return {fem::make_finite_element_flow(c.flow_solver, elements),
          c.scalars.empty() ? nullptr : bulk::make_finite_element_scalars(elements)};
}

std::unique_ptr<FlowSolver> make_flow_solver(const Case& c) { return make_solvers(c).flow; }

std::optional<MovingMesh> make_moving_mesh(const Case& c) {
  if (c.method == FlowMethod::boundary_integral) return std::nullopt;
  MovingMeshOptions options = c.volume_mesh;
  options.takes_over_vertices = c.reynolds == 0.0 && c.scalars.empty();
  return MovingMesh(options);
}

}  // namespace meniscus
