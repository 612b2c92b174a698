#pragma once

#include <vector>

#include "meniscus/transport/bulk/scalar_step.hpp"
#include "meniscus/transport/bulk/transport_matrices.hpp"

namespace meniscus::bulk {

/// By interface, values at the vertices; empty where nothing is exchanged.
using ByInterface = std::vector<VertexField<double>>;

/// The exchange of a species with the surfactants of interfaces (`Adsorption`): per area and time
///   j = Bi [K c (1 − XΓ) − Γ]
/// goes from the liquid outside to the surface, linear between the vertices. In a stage of length τ
/// that begins with the concentration B, Γ = B + τj.
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
  /// j at the vertices in a stage that led to T.
  [[nodiscard]] ByInterface rates(std::span<const double> T, double stage, const ByInterface& begin,
                                  const ByInterface& guess) const;
  /// ∮φ_v j dS.
  [[nodiscard]] ByInterface uptake(const ByInterface& rates) const;
  /// What the liquid loses per time.
  [[nodiscard]] double loss(const ByInterface& rates) const;

 private:
  /// An entry of the matrix ∮φ_i φ_v dS.
  struct Entry {
    std::size_t place = 0;  // in the values of the space's graph
    std::size_t node = 0;   // i
    VertexId vertex;        // v
    double value = 0.0;
  };
  struct Side {
    double biot = 0.0, adsorption = 0.0, depth = 0.0, packing = 0.0;  // X
    std::vector<std::size_t> node;                                    // of each vertex
    std::vector<Entry> entries;
    /// ∮φ_v φ_w dS by faces.
    std::vector<std::array<VertexId, 3>> faces;
    std::vector<Mat3> masses;
  };
  [[nodiscard]] double slope(const Side& side, double stage, double guess) const;

  std::vector<Side> sides_;
  ByInterface start_, end_;
  bool is_empty_ = true, is_linear_ = true;
};

}  // namespace meniscus::bulk
