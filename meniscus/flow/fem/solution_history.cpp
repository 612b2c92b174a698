#include "meniscus/flow/fem/solution_history.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "meniscus/core/archive_entries.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/solver_archive.hpp"

namespace meniscus::fem {
namespace {

constexpr double kFurthest = 2.0;
const std::array<std::string, 2> kNames = {"flow/guess", "flow/guess/before"};

}  // namespace

StokesState SolutionHistory::at(double t) const {
  MENISCUS_ASSERT(!empty(), "no solution");
  StokesState result = states_.front();
  if (states_.size() < 2) return result;
  const StokesState& before = states_.back();
  const double way =
      std::clamp((t - times_.front()) / (times_.front() - times_.back()), -kFurthest, kFurthest);
  for (const NodeId i : result.v.ids()) result.v[i] += way * (result.v[i] - before.v[i]);
  for (std::size_t i = 0; i < result.p.size(); ++i)
    result.p[i] += way * (result.p[i] - before.p[i]);
  return result;
}

void SolutionHistory::add(StokesState state, double t) {
  if (!empty() && times_.front() == t) {
    states_.front() = std::move(state);
    return;
  }
  states_.insert(states_.begin(), std::move(state));
  times_.insert(times_.begin(), t);
  if (states_.size() <= kNames.size()) return;
  states_.pop_back();
  times_.pop_back();
}

void SolutionHistory::put_on_mesh(std::vector<StokesState> states) {
  MENISCUS_ASSERT(states.size() == states_.size(), "{} {}", states.size(), states_.size());
  states_ = std::move(states);
}

void SolutionHistory::clear() {
  states_.clear();
  times_.clear();
}

void SolutionHistory::save(Archive& archive) const {
  for (std::size_t k = 0; k < states_.size(); ++k) {
    fem::save(states_[k], archive, kNames[k]);
    archive.reals[kNames[k] + "/time"] = {times_[k]};
  }
}

void SolutionHistory::load(const Archive& archive, const StokesState& like) {
  clear();
  for (const std::string& name : kNames) {
    if (!archive.reals.contains(name + "/velocity")) break;
    states_.push_back(load_state(archive, name));
    times_.push_back(archive.reals.contains(name + "/time")
                         ? entry_of_size(archive.reals, name + "/time", 1).front()
                         : kLongAgo);
    if (states_.back().v.size() != like.v.size() || states_.back().p.size() != like.p.size())
      reject_input("checkpoint: {} does not fit the volume mesh", name);
  }
  if (states_.size() > 1 && !(times_.front() > kLongAgo && times_.front() != times_.back()))
    reject_input("checkpoint: flow/guess/time is missing, or that of flow/guess/before");
}

}  // namespace meniscus::fem
