#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "meniscus/core/archive.hpp"
#include "meniscus/evolve/step_control.hpp"
#include "meniscus/flow/flow_solver.hpp"
#include "meniscus/topology/events.hpp"

namespace meniscus {

/// The evolving state: liquids and interfaces at one time, and the volume mesh.
struct State {
  double t = 0.0;
  double dt = 0.0;        ///< [1/G] length of the step that led to t
  std::int64_t step = 0;  ///< number of steps to t
  StepRecord record;      ///< of the step that led to t
  Scene scene;
  BulkScalars scalars;             ///< of the scene, on the mesh
  std::optional<NodalFlow> flow;   ///< of liquids with inertia, on the mesh; none before the first
  std::optional<MovingMesh> mesh;  ///< none where the flow solver needs none
  /// A number that changes whenever the connectivity of an interface or of the mesh changes.
  std::int64_t connectivity = 0;
  Vec3 start_centroid = Vec3::Zero();  ///< [R0] centroid of the drops at step 0
  std::vector<double> volume_shift;  ///< [R0] by interface: shift of the last restoration of volume
  /// Largest shift of a vertex by volume restorations in the step that led to t, relative to the
  /// mean edge at the vertex.
  double shift_over_edge = 0.0;
  /// Steps are no longer shortened because of a large shift, since that did not help.
  bool tolerates_shift = false;
  std::vector<TopologyEvent> events;  ///< of the step that led to t
  /// Largest excess of carried fields over their range in any step so far.
  FieldExcess field_excess;
  /// What the transfer to a new mesh took from the flow in the step that led to t.
  double momentum_lost = 0.0, energy_lost = 0.0;
  int iterations = 0;  ///< linear iterations since the last solve at the start of a step

  /// Of the interfaces. They follow from these but for round-off, by which surfaces that were
  /// scaled differ.
  std::shared_ptr<KnownSurfaces> surfaces = std::make_shared<KnownSurfaces>();

  [[nodiscard]] FlowDomain domain() const {
    return {.scene = scene,
            .mesh = mesh ? &mesh->tetrahedra() : nullptr,
            .connectivity = connectivity,
            .scalars = scalars.empty() ? nullptr : &scalars,
            .known = flow ? &*flow : nullptr,
            .surfaces = surfaces.get()};
  }
};

/// Sets the carried fields of the interfaces, one list per interface; all lists have the same
/// names. The concentration of a surfactant stays beside them. Throws InvalidInput naming what does
/// not fit (`check_fields`).
void set_interface_fields(State& state, std::vector<SurfaceFields> fields);

/// Saves a state bit for bit. Imposed flow, outer boundary and mesh options are not saved: loading
/// keeps those of the given state.
void save(const State& state, Archive& archive);
/// Loads a state. Throws InvalidInput when the archive is damaged or does not fit.
void load(State& state, const Archive& archive);

}  // namespace meniscus
