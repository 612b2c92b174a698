#include "python/bindings/snapshot.hpp"

namespace meniscus::python {

std::shared_ptr<const SurfaceSnapshot> surface_snapshot(const Evolution& evolution) {
  auto snapshot = std::make_shared<SurfaceSnapshot>();
  std::size_t vertices = 0, faces = 0;
  for (const Interface& interface : evolution.scene().interfaces) {
    snapshot->parts.push_back({interface.drop, interface.parent, interface.mesh, vertices, faces});
    vertices += static_cast<std::size_t>(interface.mesh.num_vertices());
    faces += static_cast<std::size_t>(interface.mesh.num_faces());
  }
  snapshot->data = surface_arrays(evolution);
  return snapshot;
}

std::shared_ptr<const VolumeSnapshot> volume_snapshot(const Evolution& evolution) {
  if (!evolution.state().mesh) return nullptr;
  return std::make_shared<VolumeSnapshot>(
      VolumeSnapshot{evolution.state().mesh->tetrahedra(), volume_arrays(evolution)});
}

}  // namespace meniscus::python
