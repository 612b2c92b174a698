#pragma once

#include <vector>

#include "meniscus/evolve/measures.hpp"
#include "meniscus/evolve/options.hpp"
#include "meniscus/evolve/scalar_motion.hpp"

namespace meniscus {

/// The rows of history.csv and drops.csv of one instant.
struct Rows {
  HistoryRow history;
  std::vector<DropRow> drops;
};

/// Makes the rows of a state. It refers to what it is given.
class RowMaker {
 public:
  /// `scalars` are the measures of the state's bulk scalars.
  RowMaker(const State& state, const EvolutionOptions& options, std::vector<ScalarMeasures> scalars,
           Carriers& carriers);

  /// All rows, once the flow was solved; `motion` is the velocity of the interfaces' vertices. The
  /// processes of the options share the measures, and the first of them alone has the drops.
  /// Collective.
  [[nodiscard]] Rows rows(const FlowSolution& flow, const InterfaceMotion& motion) const;
  /// The drops of `rows`, on any process.
  [[nodiscard]] std::vector<DropRow> moving_drop_rows(const FlowSolution& flow) const;
  /// Those of drops.csv alone, which need no flow.
  [[nodiscard]] std::vector<DropRow> drop_rows() const;

 private:
  const State& state_;
  const EvolutionOptions& options_;
  std::vector<ScalarMeasures> scalars_;
  Carriers& carriers_;
  InterfaceSurfaces faces_;
};

}  // namespace meniscus
