#include "meniscus/volume/settle_debts.hpp"

#include <algorithm>
#include <cmath>

#include "meniscus/core/error.hpp"
#include "meniscus/volume/facets.hpp"

namespace meniscus {
namespace {

// Debts of unlike sign lie a face of the interface or two apart; each sweep reaches one cell.
constexpr int kSpreadSweeps = 6, kPaySweeps = 12;

/// Neumaier's compensated sum.
class Sum {
 public:
  void add(double x) {
    const double sum = sum_ + x;
    lost_ += std::abs(sum_) >= std::abs(x) ? (sum_ - sum) + x : (x - sum) + sum_;
    sum_ = sum;
  }
  [[nodiscard]] double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0.0, lost_ = 0.0;
};

/// Every cell passes an eighth of its debt through each facet that it has in its group.
void spread(CellField<double>& debt, const GroupNeighbours& neighbours) {
  CellField<double> next = debt;
  for (const CellId c : debt.ids()) {
    if (debt[c] == 0.0) continue;
    const double share = 0.125 * debt[c];
    for (const CellId j : neighbours[c]) {
      if (!j.is_valid()) continue;
      next[j] += share;
      next[c] -= share;
    }
  }
  debt = std::move(next);
}

void pay(IndebtedField& field, const CellField<double>& volume) {
  for (const CellId c : field.value.ids()) {
    const double old = field.value[c];
    const double wanted = old + field.debt[c] / volume[c];
    const ValueRange& range = field.range[c];
    MENISCUS_ASSERT(range.low <= range.high, "cell {} may have no value", c.value);
    // A value outside its range may return to it, and go no further out.
    const double low = std::min(range.low, old), high = std::max(range.high, old);
    field.value[c] = std::clamp(wanted, low, high);
    field.debt[c] -= (field.value[c] - old) * volume[c];
  }
}

}  // namespace

GroupNeighbours group_neighbours(const TetMesh& mesh, const CellField<std::int32_t>& group) {
  const FacetTable facets(mesh);
  GroupNeighbours neighbours;
  for (const CellId c : mesh.cells.ids()) {
    std::array<CellId, 4> inside = facets.neighbours(c);
    for (CellId& j : inside)
      if (j.is_valid() && group[j] != group[c]) j = CellId{};
    neighbours.add(inside);
  }
  return neighbours;
}

void settle_debts(IndebtedField& field, const CellField<double>& volume,
                  const GroupNeighbours& neighbours) {
  MENISCUS_ASSERT(field.debt.size() == volume.size() && neighbours.size() == volume.size(),
                  "{} debts and {} neighbourhoods of {} cells", field.debt.size(),
                  neighbours.size(), volume.size());
  for (int sweep = 0; sweep < kSpreadSweeps; ++sweep) spread(field.debt, neighbours);
  for (int sweep = 0; sweep < kPaySweeps; ++sweep) {
    pay(field, volume);
    spread(field.debt, neighbours);
  }
  pay(field, volume);
}

double amount_of(const CellField<double>& value, const CellField<double>& volume,
                 const std::vector<CellId>& cells) {
  Sum sum;
  for (const CellId c : cells) sum.add(value[c] * volume[c]);
  return sum.value();
}

void settle_amount(CellField<double>& value, const CellField<double>& volume,
                   const std::vector<CellId>& cells, const ValueRange& range, double amount) {
  Sum measure;
  for (const CellId c : cells) measure.add(volume[c]);
  MENISCUS_ASSERT(measure.value() > 0.0, "{} cells measure {}", cells.size(), measure.value());
  const double missing = amount - amount_of(value, volume, cells);
  const double bound = missing > 0.0 ? range.high : range.low;
  Sum room;
  for (const CellId c : cells) room.add((bound - value[c]) * volume[c]);
  if (missing != 0.0 && missing * room.value() > 0.0) {
    const double theta = std::min(1.0, missing / room.value());
    for (const CellId c : cells) value[c] += theta * (bound - value[c]);
  }
  const double density = (amount - amount_of(value, volume, cells)) / measure.value();
  // What is left after θ < 1 is round-off; it must not push values over their range.
  const bool is_excess =
      std::abs(missing) > std::abs(room.value()) || missing * room.value() <= 0.0;
  if (!is_excess) return;
  for (const CellId c : cells) value[c] += density;
}

}  // namespace meniscus
