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
  KnownSurfaces() = default;
  /// Ranks that share out the fits and middles of splined surfaces must all ask for the same
  /// surfaces in the same order.
  explicit KnownSurfaces(ShareNumbers share) : share_(std::move(share)) {}

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

  ShareNumbers share_ = own_numbers;
  std::unordered_multimap<std::size_t, Known> known_;  // by a hash of the vertices
};

/// The surfaces of a scene's interfaces.
using InterfaceSurfaces = std::vector<std::shared_ptr<const ReconstructedSurface>>;

}  // namespace meniscus
