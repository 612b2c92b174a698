#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "meniscus/core/archive.hpp"
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
  /// Changes a mesh's scale. The surface of the new vertices is known then from that of the old
  /// ones, without new fits.
  void scale(SurfaceMesh& mesh, SurfaceShape shape, const Dilation& dilation);
  /// Forgets those that nobody asked for since the last call.
  void forget_unasked();
  [[nodiscard]] std::size_t size() const { return known_.size(); }

  /// Saves what a mesh's surface was scaled from, as fits to the scaled vertices differ from it by
  /// round-off. Nothing where it was not scaled.
  void save(const SurfaceMesh& mesh, Archive& archive, const std::string& path) const;
  /// Makes the surface that was saved for a mesh. Throws InvalidInput where another mesh's was.
  void load(const SurfaceMesh& mesh, const Archive& archive, const std::string& path);

 private:
  struct Known {
    std::shared_ptr<const ReconstructedSurface> surface;
    std::shared_ptr<const ReconstructedSurface> unscaled = nullptr;  // none where it was fitted
    Dilation dilation = {};
    bool is_asked_for = true;
  };
  using KnownByHash = std::unordered_multimap<std::size_t, Known>;  // of the vertices

  [[nodiscard]] KnownByHash::iterator find(const SurfaceMesh& mesh, SurfaceShape shape);
  [[nodiscard]] std::shared_ptr<const ReconstructedSurface> made(const SurfaceMesh& mesh,
                                                                 SurfaceShape shape) const;
  Known& add(Known known);
  Known& add_scaled(std::shared_ptr<const ReconstructedSurface> unscaled, const Dilation& dilation);

  ShareNumbers share_ = own_numbers;
  KnownByHash known_;
};

/// The surfaces of a scene's interfaces.
using InterfaceSurfaces = std::vector<std::shared_ptr<const ReconstructedSurface>>;

}  // namespace meniscus
