#include "meniscus/evolve/rows.hpp"

#include <array>
#include <utility>

#include "meniscus/linear/shared_work.hpp"

namespace meniscus {

RowMaker::RowMaker(const State& state, const EvolutionOptions& options,
                   std::vector<ScalarMeasures> scalars, Carriers& carriers)
    : state_(state),
      options_(options),
      scalars_(std::move(scalars)),
      carriers_(carriers),
      faces_(reconstructed_interfaces(state.scene, options.surface, *state.surfaces)) {}

Rows RowMaker::rows(const FlowSolution& flow, const InterfaceMotion& motion) const {
  InterfaceTotals totals;
  Rows rows;
  // The two take about the same time. The first is left on the first rank, which writes its rows.
  linear::share_work(
      linear::Communicator::of(options_.processes), std::array{1.0, 1.0},
      [&](std::size_t k, Archive& archive) {
        if (k == 0) {
          rows.drops = moving_drop_rows(flow);
        } else {
          totals = interface_totals(state_, flow, motion, faces_);
          save(totals, archive);
        }
      },
      [&](std::size_t k, const Archive& archive) {
        if (k == 1) totals = load_interface_totals(archive);
      });
  rows.history = history_row(state_, flow, totals);
  rows.history.scalars = scalar_totals(scalars_, state_.scalars);
  return rows;
}

std::vector<DropRow> RowMaker::moving_drop_rows(const FlowSolution& flow) const {
  std::vector<DropRow> rows = drop_rows();
  for (std::size_t i = 0; i < rows.size(); ++i)
    rows[i].motion = drop_motion(state_.scene, state_.t, i, rows[i].shape, flow);
  return rows;
}

std::vector<DropRow> RowMaker::drop_rows() const {
  std::vector<DropRow> rows =
      meniscus::drop_rows(state_, faces_, options_.topology.breakup_radius, carriers_);
  for (std::size_t i = 0; i < rows.size(); ++i)
    rows[i].scalars = scalars_on_drop(state_.scene, i, scalars_);
  return rows;
}

}  // namespace meniscus
