#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "meniscus/surface/reconstructed_surface.hpp"

namespace meniscus {

/// Makes reconstructed surfaces and remembers the last ones. The flow, the scalars, the restoration
/// of volumes and the tables ask for those of the same vertices in turn.
class KnownSurfaces {
 public:
  /// Finds what `middles_on_splines` finds.
  using FindMiddles = std::function<std::vector<Vec3>(const SurfaceMesh&, const SurfaceTopology&,
                                                      const SmoothSurface&)>;
  KnownSurfaces() = default;
  /// Ranks that share out the middles must all ask for the same surfaces in the same order.
  explicit KnownSurfaces(FindMiddles on_splines) : on_splines_(std::move(on_splines)) {}

  [[nodiscard]] std::shared_ptr<const ReconstructedSurface> of(const SurfaceMesh& mesh,
                                                               SurfaceShape shape);
  /// Forgets those that nobody asked for since the last call.
  void forget_unasked();
  [[nodiscard]] std::size_t size() const { return known_.size(); }

 private:
  struct Known {
    std::shared_ptr<const ReconstructedSurface> surface;
    bool is_asked_for = true;
  };
  [[nodiscard]] ReconstructedSurface made(const SurfaceMesh& mesh, SurfaceShape shape) const;

  FindMiddles on_splines_;
  std::unordered_multimap<std::size_t, Known> known_;  // by a hash of the vertices
};

/// The surfaces of a scene's interfaces.
using InterfaceSurfaces = std::vector<std::shared_ptr<const ReconstructedSurface>>;

}  // namespace meniscus
