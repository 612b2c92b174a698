#include "meniscus/flow/fem/kept_preconditioner.hpp"

#include <utility>

#include "meniscus/core/archive_entries.hpp"
#include "meniscus/flow/fem/solver_archive.hpp"

namespace meniscus::fem {

void KeptPreconditioner::drop_unless_of_stage(double stage_duration) {
  constexpr double kMostRatio = 2.0;
  if (stage_duration > kMostRatio * duration || kMostRatio * stage_duration < duration) at.reset();
}

void KeptPreconditioner::decide(const StokesProblem& problem, const StokesReport& report,
                                bool is_kept, Field<NodeId, Vec3> convects) {
  constexpr int kWorthOfOne = 3;
  const bool is_own = report.ok() && report.failed_solvers.empty() && report.iterations > 0 &&
                      !problem.is_generalised();  // whose steps make their own
  if (is_kept && report.ok() && report.iterations == 0) return;
  if (is_kept && is_own && iterations == 0) iterations = report.iterations;
  if (is_kept && is_own && report.iterations <= iterations + kWorthOfOne) return;
  at.reset();
  if (is_kept || !is_own) return;
  at = problem.positions;
  duration = problem.inertia ? problem.inertia->duration : 0.0;
  convecting = std::move(convects);
  iterations = report.iterations;
}

void KeptPreconditioner::save(Archive& archive) const {
  if (!at) return;
  save_positions(*at, archive, "flow/preconditioner");
  archive.integers["flow/preconditioner/iterations"] = {iterations};
  if (duration > 0.0) archive.reals["flow/preconditioner/duration"] = {duration};
  if (!convecting.empty()) archive.reals["flow/preconditioner/velocity"] = flat(convecting);
}

KeptPreconditioner load_preconditioner(const Archive& archive) {
  KeptPreconditioner loaded;
  if (!archive.reals.contains("flow/preconditioner/x")) return loaded;
  loaded.at = load_positions(archive, "flow/preconditioner");
  loaded.iterations = static_cast<int>(
      entry_of_size(archive.integers, "flow/preconditioner/iterations", 1).front());
  if (archive.reals.contains("flow/preconditioner/duration"))
    loaded.duration = entry_of_size(archive.reals, "flow/preconditioner/duration", 1).front();
  if (archive.reals.contains("flow/preconditioner/velocity"))
    loaded.convecting =
        vectors<NodeId>(entry_of_rows(archive.reals, "flow/preconditioner/velocity", 3));
  return loaded;
}

}  // namespace meniscus::fem
