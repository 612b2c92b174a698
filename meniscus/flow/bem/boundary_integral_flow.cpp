#include "meniscus/flow/bem/boundary_integral_flow.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "meniscus/core/archive_entries.hpp"
#include "meniscus/flow/bem/integral_equation.hpp"
#include "meniscus/linear/matrix_free_solver.hpp"

namespace meniscus::bem {
namespace {

bool is_finite(std::span<const VertexField<Vec3>> fields) {
  for (const VertexField<Vec3>& field : fields)
    for (const Vec3& v : field)
      if (!v.allFinite()) return false;
  return true;
}

std::string guess_name(std::size_t interface) { return fmt::format("flow/guess/{}", interface); }

class BoundaryIntegralFlow final : public FlowSolver {
 public:
  explicit BoundaryIntegralFlow(const Options& options) : options_(options) {}

  FlowSolution solve(const FlowDomain& domain, const Instant& instant) override;

  void save(Archive& archive, const FlowDomain& domain) const override;
  void load(const Archive& archive, const FlowDomain& domain) override;

  const PhaseTimes& times() const override { return times_; }

 private:
  Options options_;
  std::vector<VertexField<Vec3>> velocity_;  // of the last solve: the next one's first guess
  std::int64_t connectivity_ = 0;            // of the interfaces it is given on
  PhaseTimes times_;
};

/// Why boundary integrals do not describe a scene; none where they do.
std::optional<Fault> find_misfit(const Scene& scene) {
  if (!scene.is_unbounded)
    return Fault{FaultKind::no_flow, "the boundary-integral solver needs an unbounded scene"};
  if (!std::ranges::all_of(scene.liquids, is_newtonian, &Liquid::law))
    return Fault{FaultKind::no_flow, "boundary integrals describe Newtonian liquids alone"};
  return {};
}

/// Solves the double layer's equation from the unknowns of the last velocity. After a jump of the
/// flow these may be so far off that PETSc gives up at once. So they may where the double layer
/// makes much of small changes. Then the right-hand side is the first guess.
linear::LinearReport solve_equation(const IntegralEquation& equation,
                                    std::span<const VertexField<Vec3>> last_velocity,
                                    const Options& options, std::vector<double>& w) {
  const auto solve_from = [&](std::vector<double> guess) {
    w = std::move(guess);
    return linear::solve_matrix_free(
        [&](std::span<const double> x, std::span<double> result) { equation.apply(x, result); },
        equation.right_hand_side(), w,
        {.rtol = options.rtol, .max_iterations = options.max_iterations});
  };
  if (last_velocity.empty()) return solve_from(equation.right_hand_side());
  linear::LinearReport report = solve_from(equation.unknowns(last_velocity));
  if (report.converged || report.iterations >= options.max_iterations) return report;
  return solve_from(equation.right_hand_side());
}

FlowSolution BoundaryIntegralFlow::solve(const FlowDomain& domain, const Instant& instant) {
  if (auto misfit = find_misfit(domain.scene)) return failed_flow(*std::move(misfit));
  if (connectivity_ != domain.connectivity) velocity_.clear();
  connectivity_ = domain.connectivity;
  std::optional<IntegralEquation> equation;
  {
    const PhaseTimer timer(times_, "assemble");
    equation.emplace(domain.scene, instant.t, options_);
  }
  const PhaseTimer timer(times_, "solve");
  std::vector<double> w;
  linear::LinearReport report;
  if (equation->has_double_layer()) {
    report = solve_equation(*equation, velocity_, options_, w);
    if (!report.converged)
      return failed_flow(
          {FaultKind::not_converged,
           fmt::format("the double layer's equation was not solved in {} iterations: {}",
                       report.iterations, report.reason)},
          report.iterations);
  } else {
    w = equation->right_hand_side();
  }
  std::vector<VertexField<Vec3>> u = equation->velocity(w);
  if (!is_finite(u))
    return failed_flow({FaultKind::not_finite, "the velocity on an interface is not finite"});
  velocity_ = u;
  FlowSolution solution;
  solution.iterations = report.iterations;
  solution.velocity = std::move(u);
  return solution;
}

void BoundaryIntegralFlow::save(Archive& archive, const FlowDomain& domain) const {
  if (connectivity_ != domain.connectivity) return;
  for (std::size_t i = 0; i < velocity_.size(); ++i)
    archive.reals[guess_name(i)] = flat(velocity_[i]);
}

void BoundaryIntegralFlow::load(const Archive& archive, const FlowDomain& domain) {
  velocity_.clear();
  connectivity_ = domain.connectivity;
  if (!archive.reals.contains(guess_name(0))) return;
  for (std::size_t i = 0; i < domain.scene.interfaces.size(); ++i) {
    const auto count = static_cast<std::size_t>(domain.scene.interfaces[i].mesh.num_vertices());
    velocity_.push_back(vectors<VertexId>(entry_of_size(archive.reals, guess_name(i), 3 * count)));
  }
}

}  // namespace

std::unique_ptr<FlowSolver> make_boundary_integral_flow(const Options& options) {
  return std::make_unique<BoundaryIntegralFlow>(options);
}

}  // namespace meniscus::bem
