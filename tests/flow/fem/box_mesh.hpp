#pragma once

#include <functional>
#include <vector>

#include "meniscus/flow/fem/stokes_problem.hpp"
#include "meniscus/scene/scene.hpp"

namespace meniscus::fem {

/// A box [−1, 1]³ of n³ cubes, each cut in six tetrahedra (Kuhn), its outer boundary as a surface
/// with one patch per side: 0…5 for −x, +x, −y, +y, −z, +z.
struct BoxMesh {
  TetMesh mesh;
  OuterBoundary boundary;  ///< patches without conditions: the test gives them
};

struct BoxOptions {
  int n = 4;
  /// Region of a cell by its centroid.
  std::function<int(const Vec3&)> region = [](const Vec3&) { return 0; };
  double jitter = 0.0;  ///< interior vertices are moved by up to this fraction of the edge, those
                        ///< in the plane z = 0 within it
  Mat3 rotation = Mat3::Identity();
};
[[nodiscard]] BoxMesh box_mesh(const BoxOptions& options);

/// Faces between cells of region 1 and region 0, counter-clockwise seen from region 0.
[[nodiscard]] std::vector<std::array<TetVertexId, 3>> interface_faces(const TetMesh& mesh);

/// Adds the load −∫[n·T]·φ dS of a prescribed traction jump (outer minus inner) on the faces
/// between region 1 and region 0.
void add_traction_jump(const std::function<Vec3(const Vec3& x, const Vec3& n)>& jump,
                       StokesProblem& problem);

/// Gives every patch the same imposed velocity.
void impose_everywhere(OuterBoundary& boundary, std::function<Vec3(const Vec3&)> velocity,
                       bool is_linear_flow);

}  // namespace meniscus::fem
