#pragma once

#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus {

/// A distance found by sampling: the true one is not smaller. It is not larger by more than `error`
/// as far as the samples tell (see `directed_distance`).
struct SampledDistance {
  double distance = 0.0;  ///< attained between `from` and `to`
  double error = 0.0;
  Vec3 from = Vec3::Zero();  ///< the point of the first surface farthest from the second
  Vec3 to = Vec3::Zero();    ///< the point of the second surface nearest to `from`
};

struct DistanceOptions {
  double relative_error = 0.01;  ///< of the distance: where the search ends
  double absolute_error = 1e-6;  ///< of the diagonal of both surfaces' box: where it ends too
  int max_splits = 300'000;      ///< beyond, the error reached is reported, however large
};

/// The largest distance of a point of a's faces (not of its vertices alone) from b:
///   max_{p ∈ a} min_{q ∈ b} |p − q|.
/// Faces of a are sampled at corners and centre. Along a face of normal n the distance changes by
/// |n × m| per length, m the direction to the nearest point (where that lies inside a face of b,
/// its normal); what the largest slope among the samples can add between them bounds the distance
/// over the face. Faces whose bound exceeds what has been found are quartered, the worst first,
/// until none does by more than the error allowed. Between samples the slope is not known: a spike
/// of b narrower than their distance can be missed. Deterministic.
[[nodiscard]] SampledDistance directed_distance(const SurfaceMesh& a, const SurfaceMesh& b,
                                                const DistanceOptions& options = {});

/// The Hausdorff distance: the larger of the two directed ones.
[[nodiscard]] SampledDistance hausdorff_distance(const SurfaceMesh& a, const SurfaceMesh& b,
                                                 const DistanceOptions& options = {});

}  // namespace meniscus
