#include "meniscus/flow/fem/flow_transfer.hpp"

#include <algorithm>
#include <array>

#include "meniscus/flow/fem/region_motions.hpp"

namespace meniscus::fem {
namespace {

/// Momentum and kinetic energy of all regions.
RegionMotion total_motion(const MovingLiquids& liquids, std::span<const Vec3> v,
                          double* gross = nullptr) {
  RegionMotion sum;
  for (const RegionMotion& each :
       region_motions(liquids.scene, liquids.mesh, liquids.space, liquids.positions, v, gross)) {
    sum.momentum += each.momentum;
    sum.kinetic_energy += each.kinetic_energy;
  }
  return sum;
}

}  // namespace

StageProjection::StageProjection(StokesSolver& solver, StokesProblem problem,
                                 KeptPreconditioner& preconditioner, PhaseTimes& times)
    : solver_(solver),
      problem_(std::move(problem)),
      preconditioner_(preconditioner),
      times_(times) {}

StokesReport StageProjection::apply(Field<NodeId, Vec3>& v) {
  using linear::Preconditioner;
  StokesReport report = solver_.project(
      problem_, v, preconditioner_.at ? Preconditioner::kept : Preconditioner::fresh, times_);
  // The stages of generalised liquids make their own.
  if (report.ok() && report.iterations > 0 && !preconditioner_.at && !problem_.is_generalised())
    preconditioner_ = {problem_.positions, 0, problem_.inertia->duration, {}};
  return report;
}

Field<NodeId, Vec3> StageProjection::uniform_off_walls(const Vec3& value) const {
  Field<NodeId, Vec3> field(positions().x.size(), value);
  for (const NodeConstraint& constraint : problem_.constraints.all())
    field[constraint.node].setZero();
  return field;
}

Vec3 momentum(const MovingLiquids& liquids, std::span<const Vec3> v) {
  return total_motion(liquids, v).momentum;
}

std::optional<Fault> keep_momentum(const MovingLiquids& liquids, StageProjection& projection,
                                   const Vec3& momentum, Field<NodeId, Vec3>& v) {
  constexpr double kLeast = 1e-4;  // of the momentum of a uniform field: walls hold the rest
  const auto momentum_in = [&](const Field<NodeId, Vec3>& of) {
    return fem::momentum(liquids, of.span());
  };
  double scale = 0.0, mass = 0.0;
  for (const Vec3& each : v) scale = std::max(scale, each.norm());
  if (scale == 0.0) return {};
  const auto give = [&](const std::array<Field<NodeId, Vec3>, 3>& fields, const Mat3& momenta) {
    const Vec3 share =
        momenta.completeOrthogonalDecomposition().solve(momentum - momentum_in(v)).eval();
    for (const NodeId i : v.ids())
      for (int k = 0; k < 3; ++k) v[i] += share[k] * fields[static_cast<std::size_t>(k)][i];
  };
  const Vec3 now = momentum_in(v);
  std::array<Field<NodeId, Vec3>, 3> fields, uniform;
  Mat3 momenta, momenta_of_uniform;
  for (int k = 0; k < 3; ++k) {
    Field<NodeId, Vec3> moved = v;
    for (Vec3& each : moved) each += scale * Vec3::Unit(k);
    mass = std::max(mass, (momentum_in(moved) - now).norm());
    if (StokesReport report = projection.apply(moved); !report.ok()) return report.fault;
    for (const NodeId i : moved.ids()) moved[i] -= v[i];
    momenta.col(k) = momentum_in(moved);
    fields[static_cast<std::size_t>(k)] = std::move(moved);
    uniform[static_cast<std::size_t>(k)] = projection.uniform_off_walls(Vec3::Unit(k));
    momenta_of_uniform.col(k) = momentum_in(uniform[static_cast<std::size_t>(k)]);
  }
  if (momenta.norm() >= kLeast * mass) give(fields, momenta);
  give(uniform, momenta_of_uniform);
  return {};
}

MotionLost motion_lost(const MovingLiquids& before, std::span<const Vec3> v_before,
                       const MovingLiquids& after, std::span<const Vec3> v_after) {
  double gross = 0.0;
  const RegionMotion had = total_motion(before, v_before, &gross),
                     has = total_motion(after, v_after);
  return {gross > 0.0 ? (had.momentum - has.momentum).norm() / gross : 0.0,
          had.kinetic_energy - has.kinetic_energy};
}

}  // namespace meniscus::fem
