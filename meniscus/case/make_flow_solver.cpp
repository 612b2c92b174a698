#include "meniscus/case/case.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/flow/bem/boundary_integral_flow.hpp"
#include "meniscus/flow/fem/finite_element_flow.hpp"
#include "meniscus/transport/bulk/finite_element_scalars.hpp"

namespace meniscus {

std::unique_ptr<FlowSolver> make_flow_solver(const Case& c) {
  MENISCUS_ASSERT((c.method == FlowMethod::boundary_integral) ==
                      (c.domain.shape == DomainCase::Shape::unbounded),
                  "elements need a boundary, boundary integrals have none");
  return c.method == FlowMethod::boundary_integral
             ? bem::make_boundary_integral_flow(c.boundary_integral)
             : fem::make_finite_element_flow(c.flow_solver);
}

std::unique_ptr<ScalarSolver> make_scalar_solver(const Case& c) {
  if (c.scalars.empty()) return nullptr;
  return bulk::make_finite_element_scalars(c.flow_solver.elements);
}

std::optional<MovingMesh> make_moving_mesh(const Case& c) {
  if (c.method == FlowMethod::boundary_integral) return std::nullopt;
  return MovingMesh(c.volume_mesh);
}

}  // namespace meniscus
