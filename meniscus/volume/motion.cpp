#include "meniscus/volume/motion.hpp"

#include <utility>

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

/// The given motion on the interfaces, zero everywhere else.
Field<TetVertexId, Vec3> surface_motion(const TetMesh& mesh,
                                        std::span<const VertexField<Vec3>> interface_motion) {
  MENISCUS_ASSERT(interface_motion.size() == mesh.interfaces.size(), "{} motions for {} interfaces",
                  interface_motion.size(), mesh.interfaces.size());
  Field<TetVertexId, Vec3> w(mesh.num_vertices(), Vec3::Zero());
  for (std::size_t i = 0; i < mesh.interfaces.size(); ++i) {
    MENISCUS_ASSERT(interface_motion[i].size() == mesh.interfaces[i].num_vertices,
                    "a motion of another surface");
    for (const VertexId v : interface_motion[i].ids())
      w[mesh.interfaces[i].vertex(v)] = interface_motion[i][v];
  }
  return w;
}

}  // namespace

const std::vector<Spine>& VolumeMover::spines_of(const Scene& scene, const TetMesh& mesh) {
  if (spines_) return *spines_;
  std::vector<Spine> all;
  const Spines spines(scene.interfaces[0].mesh, scene.boundary.mesh);
  if (spines.exist())
    for (TetVertexId v = first_free_vertex(mesh); v.value < mesh.num_vertices(); ++v.value)
      all.push_back(spines.through(mesh.x[v]));
  spines_ = std::make_shared<const std::vector<Spine>>(std::move(all));
  return *spines_;
}

const HarmonicExtension& VolumeMover::extension_of(const TetMesh& mesh) {
  if (!pattern_) pattern_ = std::make_shared<HarmonicPattern>(mesh, first_free_vertex(mesh));
  if (!extension_) extension_ = std::make_shared<HarmonicExtension>(*pattern_, mesh);
  return *extension_;
}

Field<TetVertexId, Vec3> VolumeMover::velocity(const Scene& scene, const TetMesh& mesh,
                                               std::span<const VertexField<Vec3>> interface_motion,
                                               const Field<TetVertexId, Vec3>& fluid) {
  Field<TetVertexId, Vec3> w = surface_motion(mesh, interface_motion);
  const TetVertexId first_free = first_free_vertex(mesh);
  MENISCUS_ASSERT(first_free.is_valid(), "a mesh without an outer boundary");
  if (motion_ == VolumeMotion::lagrangian) {
    MENISCUS_ASSERT(fluid.size() == mesh.num_vertices(), "{} velocities for {} vertices",
                    fluid.size(), mesh.num_vertices());
    for (TetVertexId v = first_free; v.value < mesh.num_vertices(); ++v.value) w[v] = fluid[v];
    return w;
  }
  if (motion_ == VolumeMotion::spines && scene.interfaces.size() == 1) {
    if (const std::vector<Spine>& spines = spines_of(scene, mesh); !spines.empty()) {
      TetVertexId v = first_free;
      for (const Spine& spine : spines) {
        w[v] = spine.velocity(interface_motion[0]);
        ++v.value;
      }
      return w;
    }
  }
  if (first_free.value < mesh.num_vertices()) extension_of(mesh).extend(w);
  return w;
}

}  // namespace meniscus
