#pragma once

#include "meniscus/flow/fem/node_positions.hpp"
#include "meniscus/flow/fem/options.hpp"
#include "meniscus/scene/scene.hpp"

namespace meniscus::fem {

/// Adds the force −σ∫κ n φ_i dS of an interface on the fluid at each of its nodes (inward on a
/// sphere) [μ_out G R0²]. See eqs 15–17 of hooper2001. Balanced: κ by the paraboloid fit (P1), or
/// by the osculating one (P2). The nodal form, a lumped rule, exists for P1 alone. Where a
/// surfactant lets σ vary, the weak form alone holds its gradient.
void add_capillary_force(const Interface& interface, CapillaryForm form, const FaceNodeTable& faces,
                         const NodePositions& positions, Field<NodeId, Vec3>& force);
/// −σ∫(I − nn):∇φ_i dS: the rate at which −σ times the area of the elements' surface grows.
void add_weak_force(double tension, const FaceNodeTable& faces, const NodePositions& positions,
                    Field<NodeId, Vec3>& force);
/// The same for a σ of the velocity's degree, given at the nodes of the faces. −∫σ(I − nn):∇φ_i dS
/// is ∫(∇_s σ − σκ n) φ_i dS.
void add_weak_force(const Field<NodeId, double>& tension, const FaceNodeTable& faces,
                    const NodePositions& positions, Field<NodeId, Vec3>& force);
/// σ at the nodes of an interface's faces, zero elsewhere. At the middles of edges it is
/// interpolated from the vertices around (`edge_stencils`): Γ could leave its range there.
[[nodiscard]] Field<NodeId, double> node_tension(const Interface& interface,
                                                 const FaceNodeTable& faces,
                                                 const NodePositions& positions);
/// −σ∫κ_h n φ_i dS for a field κ_h of the velocity's degree, given at the nodes. For constant κ_h
/// it is a discrete pressure gradient: no flow.
void add_balanced_force(double tension, const Field<NodeId, double>& kappa,
                        const FaceNodeTable& faces, const NodePositions& positions,
                        Field<NodeId, Vec3>& force);

}  // namespace meniscus::fem
