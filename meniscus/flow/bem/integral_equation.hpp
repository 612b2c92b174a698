#pragma once

#include <span>
#include <vector>

#include "meniscus/flow/bem/near_field.hpp"
#include "meniscus/flow/bem/options.hpp"
#include "meniscus/mesh/rigid_motion.hpp"

namespace meniscus::bem {

/// The boundary-integral equation of Stokes flow with any number of interfaces in an unbounded
/// liquid (rallison1978; pozrikidis1992, chapter 5; here for any nesting). At x on interface k
///
///   s_k u(x) = μ_0 G·x − Σ_m 1/8π ∮_m q n·J dS + Σ_m d_m (K_m u)(x),     r = y − x,
///   J = I/r + rr/r³,   (K_m u)(x) = 1/4π PV∮_m u·T·n dS,   T = −6 rrr/r⁵,
///
/// with s_k = (μ_in + μ_out)/2 and d_k = (μ_out − μ_in)/2 of interface k, n out of the drop, and
/// the jump of traction q n − ∇_s σ. Here q = σκ − (b_in − b_out)·x, b the body forces, the
/// pressure being taken without its hydrostatic part. A tension σ that a surfactant lets vary adds
/// the single layer of ∇_s σ (`MarangoniLayer`). A closed surface has ∮ n·J dS = 0, and K_m times a
/// rigid motion is that motion times −1 on m, −2 inside it, 0 outside.
///
/// K has the eigenvalue 1 for every drop (left eigenvector n), which makes the equation singular
/// for μ_in → 0. It has −1 for each drop's six rigid motions, for μ_in → ∞. Both are moved to 0
/// (pozrikidis1992, chapter 4; kim1991): with P_m the projection onto the rigid motions of m, what
/// is solved is
///
///   s_k w − Σ_m d_m K_m (w − P_m w) + d_k n <n·(w − P_k w)>_k = right-hand side of u,
///
/// <…> being the mean over the interface, which vanishes for the solution; then u = w + R with
/// rigid R, from the outermost interface in,
///
///   μ_out,k R_k = −d_k P_k w − 2 Σ_{m around k} d_m (P_m w + R_m).
///
/// Unknowns are values at the vertices of all interfaces, x components first, then y, then z.
class IntegralEquation {
 public:
  /// Throws RunFailure where processes that share the work have been given different scenes.
  IntegralEquation(const Scene& scene, double t, const Options& options);

  [[nodiscard]] std::size_t num_unknowns() const { return 3 * rows_.size(); }
  /// Whether any interface divides liquids of unlike viscosity; else w is the right-hand side.
  [[nodiscard]] bool has_double_layer() const;
  /// Both sides are divided by s_k.
  [[nodiscard]] const std::vector<double>& right_hand_side() const { return right_hand_side_; }
  void apply(std::span<const double> w, std::span<double> result) const;
  /// u on every interface from the solution w.
  [[nodiscard]] std::vector<VertexField<Vec3>> velocity(std::span<const double> w) const;
  /// w from u: where to start when u is about known.
  [[nodiscard]] std::vector<double> unknowns(std::span<const VertexField<Vec3>> u) const;

 private:
  struct Contrast {
    double mean = 1.0;        ///< s
    double difference = 0.0;  ///< d
    double outer = 1.0;       ///< μ_out
  };
  void set_right_hand_side(const Scene& scene, double t, const std::vector<double>& q);
  [[nodiscard]] std::size_t surface_of(std::int32_t i) const;
  [[nodiscard]] Vec3 at(std::span<const double> w, std::int32_t i) const;
  void set(std::span<double> w, std::int32_t i, const Vec3& value) const;
  [[nodiscard]] SourceVectors deformation(std::span<const double> w) const;
  [[nodiscard]] double mean_normal_component(std::size_t m, const SourceVectors& v) const;
  [[nodiscard]] Vec3 double_layer(const SourceVectors& density, std::int32_t i) const;
  [[nodiscard]] std::vector<RigidMotion> rigid_parts(std::span<const double> w) const;
  [[nodiscard]] std::vector<std::size_t> outermost_first() const;

  BoundaryGeometry geometry_;
  SharedPoints shared_;
  std::vector<Contrast> contrast_;
  std::vector<RigidProjection> rigid_;
  std::vector<NearRow> rows_;  // of this process's own points
  std::vector<double> right_hand_side_;
};

}  // namespace meniscus::bem
