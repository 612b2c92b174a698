#pragma once

#include <array>
#include <optional>
#include <vector>

#include "meniscus/transport/bulk/scalar_step.hpp"
#include "meniscus/transport/bulk/transport_matrices.hpp"
#include "meniscus/transport/carrier_surface.hpp"

namespace meniscus::bulk {

/// By interface, values at those of its nodes that the scalars have, numbered as the
/// `CarrierSurface` does; empty where nothing is exchanged.
using ByInterface = std::vector<std::vector<double>>;

/// The exchange of a species with the surfactants of interfaces (`Adsorption`): per area and time
///   j = Bi [K c (1 − XΓ) − Γ]
/// goes from the liquid outside to the surface, at every node that the scalars have there. In a
/// stage of length τ that begins with the concentration B, Γ = B + τj.
class InterfaceExchange {
 public:
  /// Of scalar k on the way of a motion; on interfaces as they are at `positions`. The scene at its
  /// end holds what the surfactants were carried to, and what they were expected to adsorb.
  InterfaceExchange(const ScalarMotion& motion, const NodePositions& positions, std::size_t k);

  [[nodiscard]] bool empty() const { return is_empty_; }
  /// Whether j has a product of c and Γ.
  [[nodiscard]] bool is_linear() const { return is_linear_; }

  /// Γ after a share of the way, without what is adsorbed on it.
  [[nodiscard]] ByInterface carried(double share) const;
  /// Adds what the liquid loses to the equations of a stage, the product taken at the guess of Γ.
  void add_to(MatrixValues& system, std::vector<double>& right, double stage,
              const ByInterface& begin, const ByInterface& guess) const;
  /// j in a stage that led to T.
  [[nodiscard]] ByInterface rates(std::span<const double> T, double stage, const ByInterface& begin,
                                  const ByInterface& guess) const;
  /// ∮φ_v j dS at the vertices, the mean over both ends of the step; φ_v as in `SurfaceMass`.
  [[nodiscard]] std::vector<VertexField<double>> uptake(const ByInterface& rates) const;
  /// What the liquid loses per time to that uptake.
  [[nodiscard]] double loss(std::span<const VertexField<double>> uptake) const;

 private:
  /// An entry of the matrix ∮φ_i φ_n dS.
  struct Entry {
    std::size_t place = 0;  // in the values of the space's graph
    std::size_t row = 0;    // i, of the space
    std::size_t node = 0;   // n, of the interface
    double value = 0.0;
  };
  struct Side {
    double biot = 0.0, adsorption = 0.0, depth = 0.0, packing = 0.0;  // X
    CarrierSurface at_start, at_end;
    std::vector<std::size_t> in_space = {};  // of each node
    std::vector<Entry> entries = {};
  };
  /// The nodes of a side, and what it adds to the equations where they are at `positions`.
  static void set_nodes(Side& side, const ScalarSpace& space, const fem::FaceNodeTable& faces,
                        const NodePositions& positions);
  [[nodiscard]] static VertexField<double> uptake(const Side& side,
                                                  const std::vector<double>& rates);
  [[nodiscard]] double slope(const Side& side, double stage, double guess) const;

  std::vector<std::optional<Side>> sides_;  // none where nothing is exchanged
  ByInterface start_, end_;
  bool is_empty_ = true, is_linear_ = true;
};

}  // namespace meniscus::bulk
