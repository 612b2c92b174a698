#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "meniscus/mesh/surface_tree.hpp"
#include "meniscus/solids/remesh_target.hpp"
#include "meniscus/surface/foreseen_vertices.hpp"
#include "meniscus/surface/remesh.hpp"

namespace meniscus {

inline constexpr int kMostPasses = 10;   // one to three are usual; more where a floor bends the law
inline constexpr int kMostFailures = 5;  // of passes, where nothing else is left to try

[[nodiscard]] const char* option_name(RemeshTarget::By by);
/// Throws InvalidInput if the target would take too many vertices.
void require_affordable(const RemeshTarget& target, double num_vertices);

/// One piece as it came (evened out if it was rough), turned so that its volume is positive.
struct Piece {
  SurfaceMesh mesh;
  double volume;
  bool is_cavity;
  bool is_rough = false;
};

/// The best result of a search: no pieces, and the fault reported, if no pass succeeded.
struct Found {
  std::vector<SurfaceMesh> pieces;
  double miss = std::numeric_limits<double>::infinity();  ///< |ln(measure/target)|
  TargetReport report;
};

/// The largest |ln(measure/target)| at which a search ends.
[[nodiscard]] double band(RemeshTarget::By by);

/// The next setting: first as if the measure were proportional to it, then by the secant of the two
/// passes before in logarithms. Floors and gradation bend the law; its slope stays in bounds.
[[nodiscard]] double next_setting(double setting, double measure, double last_setting,
                                  double last_measure, double aim);

/// Remeshes scaled pieces to a target scaled alike.
class TargetSearch {
 public:
  /// Ends at the `most_failures`-th pass that fails.
  TargetSearch(std::vector<Piece> pieces, const RemeshTarget& target, double rough_edge,
               int most_failures);
  [[nodiscard]] Found run() const;

 private:
  struct Reference {
    SurfaceMesh tessellation;
    std::unique_ptr<SurfaceTree> tree;   // of the piece
    VertexField<double> unit_length;     // l0 for a chordal error of 1
    VertexField<double> largest_length;  // 1/max|k|
  };

  void build_references();
  [[nodiscard]] double first_setting() const;
  [[nodiscard]] RemeshOptions options(std::size_t i, double setting) const;
  [[nodiscard]] std::function<double(const Vec3&)> chordal_lengths(std::size_t i,
                                                                   double setting) const;
  [[nodiscard]] std::optional<Fault> remesh_all(double setting,
                                                std::vector<SurfaceMesh>& remeshed) const;
  [[nodiscard]] double measure_of(const std::vector<SurfaceMesh>& remeshed) const;

  std::vector<Piece> pieces_;
  RemeshTarget target_;
  double rough_edge_;
  int most_failures_;
  std::vector<Reference> references_;
};

}  // namespace meniscus
