#pragma once

#include <functional>
#include <optional>

#include "meniscus/core/archive.hpp"
#include "meniscus/core/fault.hpp"
#include "meniscus/core/timer.hpp"
#include "meniscus/mesh/carried_fields.hpp"
#include "meniscus/volume/field_transfer.hpp"
#include "meniscus/volume/motion.hpp"
#include "meniscus/volume/tetrahedralize.hpp"

namespace meniscus {

struct MovingMeshOptions {
  VolumeMeshOptions tetrahedra;
  VolumeMotion motion = VolumeMotion::spines;
  /// Whether a new mesh begins with the vertices of the one before, which halves its cost. What is
  /// interpolated from each mesh to the next then has 1.5 to 2.6 times the error. An example is a
  /// spot in shear: after ten meshes its second moments are off by 1.2 instead of 0.5 %.
  bool takes_over_vertices = true;
};

/// What following the interfaces made of the mesh; on failure it is as it was.
struct [[nodiscard]] MeshChange : Report {
  /// Where the vertices of the mesh before are now; invalid for those without a counterpart.
  Field<TetVertexId, TetVertexId> old_to_new = {};
  TetMesh before = {};         ///< the mesh as it stood
  RegionSources sources = {};  ///< which liquid each region of the new mesh took
};

/// The tetrahedra of all regions, which move with the interfaces of a scene. The mesh knows where
/// its vertices stood when the step began and with what velocity they left. Evolution owns it and
/// lends it to the flow solver. Fields that live on the tetrahedra ride on it.
class MovingMesh {
 public:
  /// Makes the tetrahedra of a scene, from those before or from none; `tetrahedralize` but in
  /// tests.
  using Mesher =
      std::function<VolumeMeshReport(const Scene&, const TetMesh& before, TetMesh& mesh)>;
  explicit MovingMesh(const MovingMeshOptions& options);
  MovingMesh(VolumeMotion motion, Mesher mesher, bool takes_over_vertices = true)
      : mover_(motion), mesher_(std::move(mesher)), takes_over_vertices_(takes_over_vertices) {}

  [[nodiscard]] const TetMesh& tetrahedra() const { return mesh_; }
  /// As it stood when the step began; of the same connectivity until it follows.
  [[nodiscard]] const TetMesh& start() const { return start_; }
  /// w of every vertex, from the last `move` [G R0]; empty before the first.
  [[nodiscard]] const Field<TetVertexId, Vec3>& velocity() const { return velocity_; }

  /// Remembers where everything stands: what `move` starts from and `undo` returns to.
  void begin_step(const Scene& scene);
  /// Places the vertices at x_start + dt w. On interfaces w is `interface_velocity`; between them
  /// it follows the options (`VolumeMover`), with the liquid's velocity for Lagrangian motion.
  /// `start` is the scene where the step began. Fails, and leaves the mesh as it was, when a cell
  /// would be inverted.
  Report move(const Scene& start, std::span<const VertexField<Vec3>> interface_velocity,
              const Field<TetVertexId, Vec3>& liquid_velocity, double dt);
  /// The smallest dihedral angle of the cells as they stand; found once for each of their places.
  [[nodiscard]] double smallest_angle_deg() const;
  /// Whether the cells are still as good as when the mesh was made: their smallest dihedral angle
  /// is at least 0.7 of what it was.
  [[nodiscard]] bool is_fit() const;
  /// Puts everything back where it stood when the step began.
  void undo();
  /// Places the vertices of the interfaces exactly where a scene of the same connectivity has them.
  void place_interfaces(const Scene& scene);
  /// Fits the mesh to interfaces that were remeshed, or whose topology changed. The fields are
  /// carried from where the mesh stands; `sources` says which liquid each region took.
  MeshChange follow(const Scene& scene, const RegionSources& sources = {});

  /// What lives on the mesh: it rides along, and is put back with the mesh (docs/fields.md).
  [[nodiscard]] const VolumeFields& fields() const { return fields_; }
  /// Throws InvalidInput naming what does not fit (`check_fields`).
  void set_fields(VolumeFields fields);
  /// By how much conserved fields have left the range they had since the step began.
  [[nodiscard]] const FieldExcess& field_excess() const { return excess_; }

  void save(Archive& archive) const;
  /// Throws InvalidInput when the archive's mesh is damaged or does not fit the scene.
  void load(const Archive& archive, const Scene& scene);

  [[nodiscard]] const PhaseTimes& times() const { return times_; }

 private:
  struct NewMesh {
    VolumeMeshReport report;
    TetMesh mesh;
    double angle_deg = 0.0;  // the smallest dihedral angle
  };
  [[nodiscard]] NewMesh mesh_anew(const Scene& scene) const;

  VolumeMover mover_;
  Mesher mesher_;
  bool takes_over_vertices_;
  TetMesh mesh_, start_;
  // The smallest dihedral angle of the mesh when it was made; and of that which the step began
  // with.
  double made_angle_deg_ = 0.0, start_made_angle_deg_ = 0.0;
  mutable std::optional<double> angle_deg_;  // that of the mesh as it stands, once asked for
  Field<TetVertexId, Vec3> velocity_;
  VolumeFields fields_, start_fields_;
  FieldExcess excess_;
  mutable PhaseTimes times_;  // times are not part of the state
};

}  // namespace meniscus
