#include "meniscus/app/simulation.hpp"

#include <cmath>

#include <fmt/format.h>

#include "meniscus/app/frames.hpp"
#include "meniscus/app/interrupt.hpp"
#include "meniscus/app/ranks.hpp"
#include "meniscus/app/wording.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/core/log.hpp"
#include "meniscus/io/archive_file.hpp"
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
    judge.past().add(t[row], std::move(drops));
    drops.clear();
  }
}

}  // namespace

Simulation::Simulation(Evolution evolution, std::optional<RunDirectory> directory,
                       const OutputOptions& output, Description describe)
    : evolution_(std::move(evolution)),
      directory_(std::move(directory)),
      output_(output),
      describe_(std::move(describe)),
      timed_(seconds()) {
  check_field_names(evolution_);
}

void Simulation::load(const Archive& archive) {
  const auto next = archive.reals.find("output/next");
  if (next == archive.reals.end() || next->second.size() != 2)
    reject_input("checkpoint lacks \"output/next\"");
  next_surface_frame_ = next->second[0];
  next_volume_frame_ = next->second[1];
  if (judge_ && judge_->past().is_empty()) judge_->past().load(archive);
}

Outcome Simulation::run(Progress& progress) {
  for (;;) {
    if (!evolution_.is_finished() && any_rank(is_interrupted())) {
      keep_state();
      write_checkpoint();
      return Outcome::stopped;
    }
    record_state([&](const HistoryRow& history, const std::vector<DropRow>& drops) {
      progress.show(history, drops);
    });
    if (has_ended()) return Outcome::done;
    advance();
  }
}

HistoryRow Simulation::record_state(const RowObserver& show) {
  keep_state();
  if (!is_begun_ || evolution_.is_finished() || is_after_event_ ||
      evolution_.step() % output_.checkpoint_every == 0)
    write_checkpoint();
  is_begun_ = true;
  solve();
  const Rows rows = evolution_.rows();  // whole on rank 0
  const std::string volume_frame = begin_volume_frame();
  on_first_and_last_rank(
      [&] {
        judge(rows);
        write_surface_frame();
      },
      [&] { write_volume_frame(volume_frame); });
  on_first_rank([&] { record(rows, !volume_frame.empty(), show); });
  has_ended_ = evolution_.is_finished();
  if (judge_ && !has_ended_) {
    has_ended_ = any_rank(end_.has_value());
    if (has_ended_) write_checkpoint();
  }
  return rows.history;
}

void Simulation::solve() {
  const Report solved = evolution_.solve();
  if (solved.ok()) return;
  write_checkpoint();
  throw RunFailure(
      fmt::format("the flow at t = {:.6g} could not be solved: {}", evolution_.t(), solved.text()));
}

void Simulation::advance() {
  const FieldExcess excess = evolution_.state().field_excess;
  if (const Report advanced = evolution_.advance(); !advanced.ok()) {
    write_checkpoint();
    throw RunFailure(advanced.text());
  }
  for (const TopologyEvent& event : evolution_.events())
    log::info("{}", text_of(event, evolution_.t()));
  log_growth(excess, evolution_.state().field_excess, evolution_.t());
  // Checkpoints are written around an event: before its step and after it.
  is_after_event_ = !evolution_.events().empty();
  if (is_after_event_) write_checkpoint();
}

void Simulation::set_surroundings(const Scene& surroundings, Description describe) {
  evolution_.set_surroundings(surroundings);
  describe_ = std::move(describe);
  if (is_first_rank()) describe_(state_);
  solve();
}

void Simulation::keep_state() {
  if (!is_first_rank()) return;
  const PhaseTimer timer(output_times_, "output");
  state_ = {};
  evolution_.save(state_);
  state_.reals["output/next"] = {next_surface_frame_, next_volume_frame_};
  if (judge_) judge_->past().save(state_);
  describe_(state_);
}

void Simulation::write_checkpoint() {
  on_first_rank([&] {
    if (!directory_) return;
    const PhaseTimer timer(output_times_, "output");
    directory_->write_checkpoint(state_, state_.integers.at("evolution/step").front());
  });
}

void Simulation::write_checkpoint(const std::filesystem::path& file) {
  on_first_rank([&] { io::write_archive(file, state_); });
}

void Simulation::stop_when(const StopRules& rules) {
  if (!rules.any()) return;
  judge_.emplace(rules);
  on_first_rank([&] {
    if (directory_) judge_past(*judge_, directory_->path() / io::RunFiles::drops);
  });
}

/// The file of the frame of the volume that is due; empty where none is. Collective.
std::string Simulation::begin_volume_frame() {
  std::string file;
  on_first_rank([&] {
    const bool is_due = evolution_.t() >= next_volume_frame_ || evolution_.is_finished();
    if (directory_ && evolution_.state().mesh && is_due)
      file = directory_->begin_volume_frame(evolution_).string();
  });
  return text_of_first_rank(std::move(file));
}

void Simulation::judge(const Rows& rows) {
  if (judge_)
    end_ = judge_->judge(rows.history.t, rows.drops, evolution_.events(), evolution_.scene(),
                         {evolution_.step_length(), evolution_.motion()});
  if (evolution_.is_finished() && !end_) end_ = RunEnd{Ending::time, ""};
}

void Simulation::write_surface_frame() {
  const double t = evolution_.t();
  if (t < next_surface_frame_ && !end_) return;
  const PhaseTimer timer(output_times_, "output");
  if (directory_) directory_->add_surface_frame(evolution_);
  next_surface_frame_ = next_multiple(output_.interval, t);
}

void Simulation::write_volume_frame(const std::string& file) {
  if (file.empty()) return;
  const PhaseTimer timer(output_times_, "output");
  meniscus::write_volume_frame(file, evolution_);
}

/// Lists the frames and adds the rows, when the frames are complete.
void Simulation::record(const Rows& rows, bool has_volume_frame, const RowObserver& show) {
  const auto& [history, drops] = rows;
  const double t = evolution_.t();
  const bool is_last = end_.has_value(), has_mesh = evolution_.state().mesh.has_value();
  if (is_last && directory_ && has_mesh && !has_volume_frame) {  // that a rule ends here
    write_volume_frame(directory_->begin_volume_frame(evolution_).string());
    has_volume_frame = true;
  }
  {
    const PhaseTimer timer(output_times_, "output");
    if (has_volume_frame) directory_->list_volume_frame(evolution_);
    if (t >= next_volume_frame_ || is_last)
      next_volume_frame_ = output_.volume ? next_multiple(output_.volume_interval, t) : HUGE_VAL;
    if (directory_) directory_->add_rows(history, drops);
    if (directory_) directory_->add_events(history, evolution_.events());
  }
  if (observer_) time_phase(output_times_, "output", [&] { observer_(directory()); });
  const auto now = seconds();
  auto spent = now;
  MENISCUS_ASSERT(spent.size() == timed_.size(), "{} phases, {} before", spent.size(),
                  timed_.size());
  for (std::size_t i = 0; i < spent.size(); ++i) spent[i].second -= timed_[i].second;
  timed_ = now;
  if (directory_) directory_->add_timing(history.step, history.t, spent);
  if (show) show(history, drops);
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
