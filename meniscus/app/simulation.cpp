#include "meniscus/app/simulation.hpp"

#include <cmath>

#include <fmt/format.h>

#include "meniscus/app/frames.hpp"
#include "meniscus/app/interrupt.hpp"
#include "meniscus/app/ranks.hpp"
#include "meniscus/app/wording.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/core/log.hpp"
#include "meniscus/io/run_files.hpp"

namespace meniscus {
namespace {

/// The first multiple of `interval` after t.
double next_multiple(double interval, double t) {
  MENISCUS_ASSERT(interval > 0.0, "an interval of {:g}", interval);
  return interval * (std::floor(t / interval) + 1.0);
}

/// Gives a judge the rows of drops.csv.
void judge_past(StopJudge& judge, const std::filesystem::path& file) {
  const io::Table table = io::read_table(file);
  const std::vector<double> t = table.column("t"), drop = table.column("drop"),
                            L = table.column("L");
  std::vector<DropLength> drops;
  for (std::size_t row = 0; row < t.size(); ++row) {
    drops.push_back({static_cast<int>(std::lround(drop[row])), L[row]});
    if (row + 1 < t.size() && t[row + 1] == t[row]) continue;
    judge.add(t[row], std::move(drops));
    drops.clear();
  }
}

}  // namespace

Simulation::Simulation(Evolution evolution, std::optional<RunDirectory> directory,
                       const OutputOptions& output, std::function<void(Archive&)> describe)
    : evolution_(std::move(evolution)),
      directory_(std::move(directory)),
      output_(output),
      describe_(std::move(describe)),
      timed_(seconds()) {
  check_field_names(evolution_);
}

void Simulation::load_schedule(const Archive& archive) {
  const auto next = archive.reals.find("output/next");
  if (next == archive.reals.end() || next->second.size() != 2)
    reject_input("checkpoint lacks \"output/next\"");
  next_surface_frame_ = next->second[0];
  next_volume_frame_ = next->second[1];
}

Outcome Simulation::run(Progress& progress) {
  bool is_after_event = false;
  for (bool is_first = true;; is_first = false) {
    const bool is_last = evolution_.is_finished(),
               is_stopped = !is_last && any_rank(is_interrupted());
    const Archive state = is_first_rank() ? state_before_solve() : Archive();
    if (is_first || is_last || is_stopped || is_after_event ||
        evolution_.step() % output_.checkpoint_every == 0)
      write_checkpoint(state);
    if (is_stopped) return Outcome::stopped;
    if (const Report solved = evolution_.solve(); !solved.ok()) {
      write_checkpoint(state);
      throw RunFailure(fmt::format("the flow at t = {:.6g} could not be solved: {}", evolution_.t(),
                                   solved.text()));
    }
    on_first_rank([&] { record(progress, is_last); });
    if (is_last) return Outcome::done;
    if (judge_ && any_rank(end_.has_value())) {
      write_checkpoint(state);
      return Outcome::done;
    }
    const FieldExcess excess = evolution_.state().field_excess;
    if (const Report advanced = evolution_.advance(); !advanced.ok()) {
      write_checkpoint(state);
      throw RunFailure(advanced.text());
    }
    for (const TopologyEvent& event : evolution_.events())
      log::info("{}", text_of(event, evolution_.t()));
    log_growth(excess, evolution_.state().field_excess, evolution_.t());
    // Checkpoints are written around an event: before its step and after it.
    is_after_event = !evolution_.events().empty();
    if (is_after_event) write_checkpoint(state);
  }
}

Archive Simulation::state_before_solve() {
  const PhaseTimer timer(output_times_, "output");
  Archive archive;
  evolution_.save(archive);
  archive.reals["output/next"] = {next_surface_frame_, next_volume_frame_};
  describe_(archive);
  return archive;
}

void Simulation::write_checkpoint(const Archive& state) {
  on_first_rank([&] {
    const PhaseTimer timer(output_times_, "output");
    directory_->write_checkpoint(state, state.integers.at("evolution/step").front());
  });
}

void Simulation::stop_when(const StopRules& rules) {
  if (!rules.any()) return;
  judge_.emplace(rules);
  on_first_rank([&] { judge_past(*judge_, directory_->path() / io::RunFiles::drops); });
}

void Simulation::record(Progress& progress, bool is_last) {
  MENISCUS_ASSERT(directory_.has_value(), "a rank without the run's folder records");
  const auto [history, drops] = evolution_.rows();
  if (judge_) end_ = judge_->judge(history.t, drops, evolution_.events(), evolution_.scene());
  if (is_last && !end_) end_ = RunEnd{Ending::time, ""};
  is_last = end_.has_value();
  {
    const PhaseTimer timer(output_times_, "output");
    const double t = evolution_.t();
    if (t >= next_surface_frame_ || is_last) {
      directory_->add_surface_frame(evolution_);
      next_surface_frame_ = next_multiple(output_.interval, t);
    }
    if (t >= next_volume_frame_ || is_last) {
      directory_->add_volume_frame(evolution_);
      next_volume_frame_ = output_.volume ? next_multiple(output_.volume_interval, t) : HUGE_VAL;
    }
    directory_->add_rows(history, drops);
    directory_->add_events(history, evolution_.events());
  }
  if (observer_) time_phase(output_times_, "output", [&] { observer_(*directory_); });
  const auto now = seconds();
  auto spent = now;
  MENISCUS_ASSERT(spent.size() == timed_.size(), "{} phases, {} before", spent.size(),
                  timed_.size());
  for (std::size_t i = 0; i < spent.size(); ++i) spent[i].second -= timed_[i].second;
  timed_ = now;
  directory_->add_timing(history.step, history.t, spent);
  progress.show(history, drops);
}

double Simulation::seconds_in(const std::string& phase) const {
  return evolution_.seconds_in(phase) + output_times_[phase];
}

PhaseSeconds Simulation::seconds() const {
  PhaseSeconds all;
  const bool has_scalars = !evolution_.scene().scalars.empty();
  for (const std::string phase : timed_phases(has_scalars))
    all.emplace_back(phase, seconds_in(phase));
  return all;
}

}  // namespace meniscus
