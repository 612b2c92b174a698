#pragma once

#include <array>
#include <numbers>

#include "meniscus/core/named_constant.hpp"

namespace meniscus {

/// [mean edge at the vertex] A step whose restoration of volumes shifts a vertex farther is tried
/// again at half its length. Remeshing by itself shifts vertices by less than a tenth of this
/// (tests/surface/remesh_test.cpp).
inline constexpr double kMostShiftOverEdge = 0.01;
/// Shortening a step is given up when more than this fraction of the shift remains. A shift caused
/// by the step's length falls by a factor of 2 or more.
inline constexpr double kShiftLeft = 0.9;
/// A step is refused if it changes a drop's volume by a factor outside these bounds. A converged
/// flow keeps volumes to about a thousandth.
inline constexpr double kLeastVolumeKept = 0.5, kMostVolumeKept = 2.0;

/// The semi-implicit scheme damps what this share of a step would change, 1 − 1/√2: short waves
/// then vanish in a long step (docs/time-stepping.md).
inline constexpr double kDampedShare = 1.0 - 0.5 * std::numbers::sqrt2;
/// q0 of b(q) = q²/(q + q0), what damping adds to a wave that changes by q in the damped share of a
/// step. It is q²/q0 for q below q0: explicit steps bear such waves, and damping would make slow
/// motions late. Above ½ waves that tension moves as fast as the exact flow could grow.
inline constexpr double kUndampedShare = 0.5;
/// [1/R²] What damping adds to −Δ_s, which has 6 in the slowest mode of a sphere (radius R). With 1
/// slow motions would be less late. But then a sheared drop in steps as long as slip allows turns
/// away from its angle. Boundary integrals, Ca = 0.2, 110 vertices: by 1.3° in 21 steps.
inline constexpr double kSphereStiffness = 6.0;
/// How much more waves on flat faces are damped. Where the drop is viscous, linear elements let the
/// shortest decay up to a fifth faster than the exact flow does. With 1.1 a deformed drop of a
/// hundredfold viscosity became unstable (tests/evolve/semi_implicit_long_test.cpp).
inline constexpr double kFacetedStiffness = 1.2;
/// How much more waves are damped with quadratic elements around drops without viscosity. There
/// these let the shortest decay 1.26 times as fast as the exact flow does, around vertices of seven
/// edges. With 1 a sheared drop of a hundredth became unstable. With 1.2 one with noise on its
/// vertices gains energy in ten times the explicit step (tests/evolve/semi_implicit_long_test.cpp).
inline constexpr double kThinDropStiffness = 1.1;
/// How far a turning moves a shape along its normals, relative to the turning itself, squared.
/// Below this a shape is too round to have a spin. So are ellipsoids of D below 0.02.
inline constexpr double kRoundness = 1e-3;
/// [shortest edge] The tolerance of the error in a step where a case does not set one.
inline constexpr double kDefaultTolerance = 0.03;
/// The relative residual of elements in Stokes flow of clean drops under error control, where a
/// case does not set one: a part of the tolerance within bounds. With three times as much a drop
/// near rest drifts: the flow of the last step is exact enough for the next, and its error adds up.
/// The two norms differ (`fem::residual_weights`).
struct ResidualLaw {
  double over_tolerance, least, most;
};
inline constexpr ResidualLaw kResidualOfQuadratic{1.0 / 15000.0, 2e-7, 2e-6},
    kResidualOfLinear{1e-4, 1e-6, 3e-6};
/// [1/G] The longest step under error control where a case does not set one.
inline constexpr double kDefaultLongestStep = 1.0;
/// [(ρ_out R0³/σ)^½] The same where tension alone drives liquids with inertia and this is longer: a
/// fortieth of the slowest period, 2π(5/24)^½ for equal densities.
inline constexpr double kDefaultLongestWave = 0.07;
/// [R0] Drops that have gone so far from their place in a flow that keeps nothing there have left.
inline constexpr double kLeft = 1.0;
/// Edges around a neck where a case does not say how many and faces are splined. In a thinning
/// filament the flow's power is then off by 2 % of what tension gives in the median, by 7 % at
/// most. With ten it is off by 29 to 58 %.
inline constexpr int kDefaultNeckEdges = 15;
/// A mesh that is kept is validated as a whole after this many steps. In every step its cells keep
/// their orientation and its surfaces those of the scene.
inline constexpr int kStepsBetweenChecks = 10;
/// The next step aims at this fraction of the tolerance. The estimate of a step varies that much
/// from the last one's, as interfaces are remeshed between them.
inline constexpr double kAimedShare = 0.6;
/// Steps grow by no more than this factor.
inline constexpr double kMostGrowth = 2.0;
/// [shortest edge] The way of a vertex that a step aims at, which the meshes must bear.
inline constexpr double kAimedDisplacement = 0.4;
/// [shortest edge] The way of the liquid past a vertex that a step aims at is `kSlipAtOne`
/// ρ^(−1/3), within bounds (`aimed_slip`). A step would make a convected wave grow by the fourth
/// power of its way. Tension damps it over 1/ρ of it. At 1.35 the worst wave neither grows nor
/// decays.
inline constexpr double kSlipAtOne = 1.1, kLeastSlip = 0.35, kMostSlip = 1.4;
/// [radius] What a step takes from a neck.
inline constexpr double kAimedNeckLoss = 0.1;
/// [shortest edge] A step without error control is wrong where its estimated error is larger. With
/// the paper's factor of ½ it is 0.005, with 2 it is 0.06; short waves that grow make it larger.
inline constexpr double kMostError = 0.1;
/// A step is refused where it exceeds what it aimed at by more than this factor.
inline constexpr double kMostExcess = 2.0;
/// [shortest edge of the tetrahedra] The way of liquids with inertia past the mesh that a step aims
/// at. Stages are implicit, so that it bounds errors alone.
inline constexpr double kAimedCourant = 2.0;
/// The largest number of stages of a Runge–Kutta–Chebyshev step.
inline constexpr int kMostStages = 24;
/// A run begins, and goes on after an event or a jump of the flow, with this fraction of the
/// midpoint rule's longest stable step.
inline constexpr double kFirstShare = 0.5;
/// The share of tension's gross power that a step's change of energy may be off by.
inline constexpr double kMostEnergyShare = 0.02;
/// What round-off may change of the energy, relative to it.
inline constexpr double kEnergyRoundOff = 1e-10;

inline constexpr std::array kEvolveConstants{
    NamedConstant{"most-shift-over-edge", kMostShiftOverEdge},
    NamedConstant{"shift-left", kShiftLeft},
    NamedConstant{"least-volume-kept", kLeastVolumeKept},
    NamedConstant{"most-volume-kept", kMostVolumeKept},
    NamedConstant{"damped-share", kDampedShare},
    NamedConstant{"undamped-share", kUndampedShare},
    NamedConstant{"sphere-stiffness", kSphereStiffness},
    NamedConstant{"faceted-stiffness", kFacetedStiffness},
    NamedConstant{"thin-drop-stiffness", kThinDropStiffness},
    NamedConstant{"roundness", kRoundness},
    NamedConstant{"aimed-share", kAimedShare},
    NamedConstant{"most-growth", kMostGrowth},
    NamedConstant{"aimed-displacement", kAimedDisplacement},
    NamedConstant{"slip-at-one", kSlipAtOne},
    NamedConstant{"least-slip", kLeastSlip},
    NamedConstant{"most-slip", kMostSlip},
    NamedConstant{"aimed-neck-loss", kAimedNeckLoss},
    NamedConstant{"aimed-courant", kAimedCourant},
    NamedConstant{"most-error", kMostError},
    NamedConstant{"most-excess", kMostExcess},
    NamedConstant{"most-stages", kMostStages},
    NamedConstant{"first-share", kFirstShare},
    NamedConstant{"most-energy-share", kMostEnergyShare}};

}  // namespace meniscus
