#include "meniscus/flow/bem/boundary_integral_flow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/bem/integral_equation.hpp"
#include "meniscus/linear/matrix_free_solver.hpp"

namespace meniscus::bem {
namespace {

FlowReport failure(std::string text, int iterations = 0) {
  return {false, std::move(text), iterations};
}

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

  FlowReport rebuild(const Scene& scene) override {
    if (!scene.is_unbounded)
      return failure("the boundary-integral solver needs an unbounded scene");
    if (!std::ranges::all_of(scene.liquids, is_newtonian, &Liquid::law))
      return failure("boundary integrals describe Newtonian liquids alone");
    velocity_.clear();
    return {};
  }

  FlowReport solve(const Scene& scene, double t) override;

  std::span<const VertexField<Vec3>> velocity() const override { return velocity_; }
  std::optional<Power> power() const override { return std::nullopt; }

  void mark(const Scene&) override {}
  FlowReport move_from_mark(const Scene&, std::span<const VertexField<Vec3>>, double) override {
    return {};
  }
  double shortest_mesh_edge() const override { return std::numeric_limits<double>::infinity(); }

  void save(Archive& archive) const override;
  void load(const Archive& archive, const Scene& scene) override;

  const PhaseTimes& times() const override { return times_; }

 private:
  Options options_;
  std::vector<VertexField<Vec3>> velocity_;  // of the last solve: the next one's first guess
  PhaseTimes times_;
};

FlowReport BoundaryIntegralFlow::solve(const Scene& scene, double t) {
  std::optional<IntegralEquation> equation;
  {
    const PhaseTimer timer(times_, "assemble");
    equation.emplace(scene, t, options_);
  }
  const PhaseTimer timer(times_, "solve");
  std::vector<double> w =
      velocity_.empty() ? equation->right_hand_side() : equation->unknowns(velocity_);
  linear::LinearReport report;
  if (equation->has_double_layer()) {
    report = linear::solve_matrix_free(
        [&](std::span<const double> x, std::span<double> result) { equation->apply(x, result); },
        equation->right_hand_side(), w,
        {.rtol = options_.rtol, .max_iterations = options_.max_iterations});
    if (!report.converged)
      return failure(fmt::format("the double layer's equation was not solved in {} iterations: {}",
                                 report.iterations, report.reason),
                     report.iterations);
  } else {
    w = equation->right_hand_side();
  }
  std::vector<VertexField<Vec3>> u = equation->velocity(w);
  if (!is_finite(u)) return failure("the velocity on an interface is not finite");
  velocity_ = std::move(u);
  return {true, {}, report.iterations};
}

void BoundaryIntegralFlow::save(Archive& archive) const {
  for (std::size_t i = 0; i < velocity_.size(); ++i) {
    std::vector<double>& values = archive.reals[guess_name(i)];
    for (const Vec3& v : velocity_[i]) values.insert(values.end(), v.begin(), v.end());
  }
}

void BoundaryIntegralFlow::load(const Archive& archive, const Scene& scene) {
  velocity_.clear();
  if (!archive.reals.contains(guess_name(0))) return;
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
    const auto found = archive.reals.find(guess_name(i));
    const auto count = static_cast<std::size_t>(scene.interfaces[i].mesh.num_vertices());
    if (found == archive.reals.end() || found->second.size() != 3 * count)
      reject_input("checkpoint: {} does not fit interface {}", guess_name(i), i);
    VertexField<Vec3>& u = velocity_.emplace_back();
    for (std::size_t v = 0; v < count; ++v) u.add(Vec3(found->second.data() + 3 * v));
  }
}

}  // namespace

std::unique_ptr<FlowSolver> make_boundary_integral_flow(const Options& options) {
  return std::make_unique<BoundaryIntegralFlow>(options);
}

}  // namespace meniscus::bem
