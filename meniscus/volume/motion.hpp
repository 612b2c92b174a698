#pragma once

#include <memory>
#include <span>
#include <vector>

#include "meniscus/scene/scene.hpp"
#include "meniscus/volume/harmonic_extension.hpp"
#include "meniscus/volume/spines.hpp"

namespace meniscus {

/// How the vertices between the surfaces follow them (§4.4 of hooper2001).
enum class VolumeMotion { spines, lagrangian, harmonic };

/// The velocity of every mesh vertex, asked for repeatedly while a mesh moves: `interface_motion`
/// on the interfaces, zero on the outer boundary, and between them
///  * spines: along the ray from the drop's centre (one star-shaped drop; elsewhere harmonic),
///  * lagrangian: the fluid's velocity `fluid`,
///  * harmonic: the solution of ∇·(|K|⁻¹∇w) = 0.
/// Spines, and the matrix and multigrid of the harmonic motion, are kept as long as the mesh stands
/// where it did. The matrix's pattern is kept as long as the mesh is only moved.
class VolumeMover {
 public:
  explicit VolumeMover(VolumeMotion motion) : motion_(motion) {}

  [[nodiscard]] Field<TetVertexId, Vec3> velocity(
      const Scene& scene, const TetMesh& mesh, std::span<const VertexField<Vec3>> interface_motion,
      const Field<TetVertexId, Vec3>& fluid);
  /// The first is to be called when vertices have moved, the second when the mesh was replaced.
  void forget_positions() {
    spines_.reset();
    extension_.reset();
  }
  void forget_mesh() {
    forget_positions();
    pattern_.reset();
  }

 private:
  [[nodiscard]] const std::vector<Spine>& spines_of(const Scene& scene, const TetMesh& mesh);
  [[nodiscard]] const HarmonicExtension& extension_of(const TetMesh& mesh);

  VolumeMotion motion_;
  std::shared_ptr<const std::vector<Spine>> spines_;  // of the vertices between, where they exist
  std::shared_ptr<const HarmonicPattern> pattern_;
  std::shared_ptr<const HarmonicExtension> extension_;
};

}  // namespace meniscus
