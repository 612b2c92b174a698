#include "meniscus/evolve/measures.hpp"

#include <cmath>
#include <numbers>

#include "meniscus/core/archive_entries.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/evolve/drop_stress.hpp"
#include "meniscus/mesh/sphere_radius.hpp"
#include "meniscus/mesh/surface_tree.hpp"
#include "meniscus/scene/interface_tension.hpp"
#include "meniscus/scene/scene_gap.hpp"
#include "meniscus/topology/necks.hpp"

namespace meniscus {
namespace {

/// The radius of the circle of the same area as the thinnest neck's section. Necks are thinner than
/// half of the sphere of the same volume. It is taken on the smooth surface where faces are curved.
std::optional<double> thinnest_neck(const Interface& interface, const ReconstructedSurface& faces) {
  const SurfaceMesh& mesh = interface.mesh;
  const SurfaceTree tree(mesh);
  const double sphere = sphere_radius(interface.volume);
  const std::vector<Neck> necks =
      find_necks(mesh, tree, Side::inside, 0.5 * sphere, SurfaceMotion());
  if (necks.empty()) return std::nullopt;
  const Neck& neck = necks.front();
  double area = neck.area;
  if (faces.smooth()) {
    const SectionResult there =
        section_around(mesh, tree, neck.center, neck.axis, 4.0 * neck.radius);
    if (there.kind == SectionKind::closed) area = smooth_area(there.section, mesh, *faces.smooth());
  }
  return std::sqrt(area / std::numbers::pi);
}

/// The power spent against tension: σ dS/dt, for which the motion along the normal is enough where
/// σ is constant.
double tension_power(const Interface& interface, const ReconstructedSurface& faces,
                     const VertexField<Vec3>& motion, const VertexField<Vec3>& velocity) {
  if (has_varying_tension(interface))
    return faces.tension_power(vertex_tension(interface), velocity);
  return interface.tension * faces.area_rate(motion);
}

/// How a drop's surfactant is spread.
SurfactantSpread surfactant_spread(const Interface& interface,
                                   const VertexField<double>& concentration,
                                   const ReconstructedSurface& faces, Carriers& carriers) {
  SurfactantSpread spread;
  spread.amount = carriers.of(interface.mesh)->mass.total(concentration);
  const auto [least, most] = faces.range_of(concentration);
  spread.least = least;
  spread.most = most;
  VertexField<double> tension = concentration;
  for (double& each : tension) each = relative_tension(interface.surfactant->state, each).value;
  spread.least_tension = faces.range_of(tension).least;
  return spread;
}

}  // namespace

InterfaceSurfaces reconstructed_interfaces(const Scene& scene, SurfaceShape shape,
                                           KnownSurfaces& known) {
  InterfaceSurfaces faces;
  faces.reserve(scene.interfaces.size());
  for (const Interface& interface : scene.interfaces)
    faces.push_back(known.of(interface.mesh, shape));
  return faces;
}

InterfaceTotals interface_totals(const State& state, const FlowSolution& flow,
                                 const InterfaceMotion& motion, const InterfaceSurfaces& faces) {
  const Scene& scene = state.scene;
  MENISCUS_ASSERT(motion.size() == scene.interfaces.size(), "{} motions of {} interfaces",
                  motion.size(), scene.interfaces.size());
  InterfaceTotals totals;
  totals.min_gap = smallest_gap(scene);
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i)
    totals.surface_rate +=
        tension_power(scene.interfaces[i], *faces[i], motion[i], flow.velocity[i]);
  const bool varies = std::ranges::any_of(
      scene.scalars, [](const Scalar& each) { return each.viscosity_exponent != 0.0; });
  if (is_newtonian(scene.liquids[RegionId{0}].law) && !varies)
    totals.stress = drop_stress(scene, flow.velocity, faces, flow.excess_stress);
  return totals;
}

void save(const InterfaceTotals& totals, Archive& archive) {
  if (totals.min_gap) archive.reals["min_gap"] = {*totals.min_gap};
  archive.reals["surface_rate"] = {totals.surface_rate};
  if (totals.stress)
    archive.reals["stress"].assign(totals.stress->reshaped().begin(),
                                   totals.stress->reshaped().end());
}

InterfaceTotals load_interface_totals(const Archive& archive) {
  InterfaceTotals totals;
  totals.surface_rate = entry_of_size(archive.reals, "surface_rate", 1).front();
  if (archive.reals.contains("min_gap"))
    totals.min_gap = entry_of_size(archive.reals, "min_gap", 1).front();
  if (archive.reals.contains("stress"))
    totals.stress = Mat3(entry_of_size(archive.reals, "stress", 9).data());
  return totals;
}

HistoryRow history_row(const State& state, const FlowSolution& flow,
                       const InterfaceTotals& totals) {
  const Scene& scene = state.scene;
  HistoryRow row;
  row.step = state.step;
  row.t = state.t;
  row.dt = state.dt;
  if (state.step > 0) {
    row.step_error = state.record.error;
    row.step_bound = state.record.bound;
    row.is_mesh_kept = state.record.is_mesh_kept;
  }
  row.drops = static_cast<int>(scene.interfaces.size());
  for (const Interface& interface : scene.interfaces)
    row.surface_nodes += interface.mesh.num_vertices();
  if (state.mesh) {
    const TetMesh& mesh = state.mesh->tetrahedra();
    row.nodes = mesh.num_vertices();
    row.tetrahedra = mesh.num_cells();
    row.min_dihedral_deg = state.mesh->smallest_angle_deg();
  }
  row.min_gap = totals.min_gap;
  row.linear_iterations = state.iterations;
  if (flow.power) {
    row.power_in = flow.power->in;
    row.dissipation = flow.power->dissipation;
  }
  row.surface_rate = totals.surface_rate;
  row.stress = totals.stress;
  if (has_inertia(scene)) {
    row.kinetic = KineticTotals{.rate = flow.power ? flow.power->kinetic_rate : 0.0,
                                .momentum_lost = state.momentum_lost,
                                .energy_lost = state.energy_lost};
    for (const RegionMotion& each : flow.motions) row.kinetic->energy += each.kinetic_energy;
  }
  return row;
}

std::vector<DropRow> drop_rows(const State& state, const InterfaceSurfaces& faces,
                               double breakup_radius, Carriers& carriers) {
  std::vector<DropRow> rows;
  MENISCUS_ASSERT(state.volume_shift.size() == state.scene.interfaces.size(),
                  "{} shifts of {} interfaces", state.volume_shift.size(),
                  state.scene.interfaces.size());
  for (std::size_t i = 0; i < state.scene.interfaces.size(); ++i) {
    const Interface& interface = state.scene.interfaces[i];
    DropRow& row = rows.emplace_back();
    row.drop = interface.drop;
    row.parent = interface.parent;
    row.shape = drop_shape(interface.mesh, state.scene.flow.family(), *faces[i]);
    row.volume_drift = row.shape.volume / interface.initial_volume - 1.0;
    row.volume_correction = state.volume_shift[i];
    if (const VertexField<double>* concentration = surfactant_concentration(interface))
      row.surfactant = surfactant_spread(interface, *concentration, *faces[i], carriers);
    if (breakup_radius > 0.0) row.neck_radius = thinnest_neck(interface, *faces[i]);
  }
  return rows;
}

std::optional<DropMotion> drop_motion(const Scene& scene, double t, std::size_t i,
                                      const DropShape& shape, const FlowSolution& flow) {
  const Interface& interface = scene.interfaces[i];
  const auto region = static_cast<std::size_t>(interface.inside.value);
  if (region >= flow.motions.size()) return {};
  const RegionMotion& inside = flow.motions[region];
  const double radius = sphere_radius(shape.volume);
  const Vec3 relative = inside.mean_velocity - scene.flow.velocity(shape.centroid, t);
  return DropMotion{inside.mean_velocity,
                    2.0 * radius * scene.liquids[RegionId{0}].density * relative.norm(),
                    inside.kinetic_energy, 4.0 * std::numbers::pi * radius * radius / shape.area};
}

}  // namespace meniscus
