#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "meniscus/core/archive.hpp"
#include "meniscus/flow/flow_solver.hpp"
#include "meniscus/topology/events.hpp"

namespace meniscus {

/// What evolves: the liquids and interfaces at one time, and the mesh of their insides.
struct State {
  double t = 0.0;
  double dt = 0.0;        ///< of the step that led to t
  std::int64_t step = 0;  ///< number of steps to t
  Scene scene;
  std::optional<MovingMesh> mesh;  ///< none where the flow solver needs none
  /// Changes whenever that of the interfaces or of the mesh does.
  std::int64_t connectivity = 0;
  Vec3 start_centroid = Vec3::Zero();  ///< of the drops at step 0
  std::vector<double> volume_shift;    ///< by interface: that by the last restoration of volume
  /// Largest shift of a vertex by a restoration of volume in the step that led to t, over the mean
  /// edge there.
  double shift_over_edge = 0.0;
  /// Steps are not made shorter for the sake of that shift: it did not help.
  bool tolerates_shift = false;
  std::vector<TopologyEvent> events;  ///< of the step that led to t
  /// The most that carried fields left the range they had, in any step so far.
  FieldExcess field_excess;
  int iterations = 0;  ///< linear ones since the last solve at the start of a step

  [[nodiscard]] FlowDomain domain() const {
    return {scene, mesh ? &mesh->tetrahedra() : nullptr, connectivity};
  }
};

/// Puts fields on the interfaces, one list for each; all lists have the same names. Throws
/// InvalidInput naming what does not fit (`check_fields`).
void set_interface_fields(State& state, std::vector<SurfaceFields> fields);

/// Bit for bit. The surroundings (imposed flow, outer boundary) and the mesh's options are no part
/// of the archive: loading keeps those that the state has.
void save(const State& state, Archive& archive);
/// Throws InvalidInput when the archive is damaged or does not fit.
void load(State& state, const Archive& archive);

}  // namespace meniscus
