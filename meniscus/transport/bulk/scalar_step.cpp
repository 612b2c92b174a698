#include "meniscus/transport/bulk/scalar_step.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/face_elements.hpp"
#include "meniscus/flow/fem/scalar_coupling.hpp"
#include "meniscus/linear/transport_solver.hpp"
#include "meniscus/transport/bulk/adsorption.hpp"
#include "meniscus/transport/bulk/cell_kernel.hpp"
#include "meniscus/transport/bulk/keep_range.hpp"

namespace meniscus::bulk {
namespace {

/// The share of a step that each of the two stages is implicit in (alexander1977): 1 − 1/√2.
constexpr double kStage = 1.0 - 0.5 * std::numbers::sqrt2;
/// Of the linear systems; what an amount loses by it is put back.
constexpr double kTolerance = 1e-6, kExchangeTolerance = 1e-11;
constexpr int kMostIterations = 500;

double sum(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

double dot(std::span<const double> a, std::span<const double> b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

double over_peclet(const Scalar& scalar) {
  return std::isinf(scalar.peclet) ? 0.0 : 1.0 / scalar.peclet;
}

Coefficients coefficients(const Scene& scene, std::size_t k) {
  Coefficients result;
  for (const Liquid& liquid : scene.liquids) {
    result.capacity.push_back(liquid.scalars[k].capacity);
    result.conductivity.push_back(liquid.scalars[k].conductivity * over_peclet(scene.scalars[k]));
    result.source.push_back(liquid.scalars[k].source);
  }
  return result;
}

/// ∮ flux φ_i/Pe of the patches where the flux is given.
std::vector<double> given_flux(const Scene& scene, std::size_t k, const ScalarSpace& space,
                               const NodePositions& positions, double factor) {
  std::vector<double> result(static_cast<std::size_t>(space.num_nodes()), 0.0);
  for (const FaceId f : space.boundary.faces()) {
    const ScalarCondition& condition = scene.boundary.patches[scene.boundary.patch[f]].scalars[k];
    if (condition.kind != ScalarCondition::Kind::flux) continue;
    const auto nodes = space.boundary.of(f);
    for (const fem::FacePoint& point : fem::face_points(positions.x, nodes))
      for (std::size_t i = 0; i < nodes.size(); ++i)
        result[static_cast<std::size_t>(nodes[i].value)] +=
            factor * condition.flux * point.value[i] * point.area.norm();
  }
  return result;
}

/// Makes the rows of given values identities.
void fix_rows(const ScalarSpace& space, const GivenValues& given, MatrixValues& matrix,
              std::vector<double>& right) {
  const fem::NodeGraph& graph = space.graph;
  for (std::size_t i = 0; i < right.size(); ++i) {
    if (given.is_given[i] == 0) continue;
    for (auto e = static_cast<std::size_t>(graph.row_start[i]);
         e < static_cast<std::size_t>(graph.row_start[i + 1]); ++e)
      matrix[e] = graph.columns[e] == static_cast<std::int32_t>(i) ? 1.0 : 0.0;
    right[i] = given.value[i];
  }
}

/// Whether conduction outweighs the masses of most nodes in a stage of this length.
linear::ScalarSystem kind_of(const ScalarSpace& space, const MassMatrix& mass,
                             const TransportMatrices& matrices, double stage) {
  double masses = 0.0, rates = 0.0;
  for (const NodeId i : ids<NodeId>(space.num_nodes())) {
    const std::size_t diagonal = place_of(space.graph, i, i);
    masses += mass.values[diagonal];
    rates += stage * std::abs(matrices.rates[diagonal]);
  }
  constexpr double kOutweighs = 100.0;
  return rates > kOutweighs * masses ? linear::ScalarSystem::conduction
                                     : linear::ScalarSystem::transport;
}

/// One step of a scalar: its matrices and its two stages.
class ScalarStep {
 public:
  ScalarStep(const ScalarMotion& motion, std::size_t k, const BulkScalar& scalar)
      : motion_(motion),
        space_(motion.space),
        dt_(motion.duration),
        coefficients_(coefficients(motion.start, k)),
        before_(scalar.values),
        mass0_(motion.mass_at_start),
        mass1_(motion.mass_at_end),
        middle_(halfway(motion.at_start, motion.at_end)),
        matrices_(matrices_of(motion.start.scalars[k].is_convected)),
        given_(given_values(motion.end, k, space_, motion.at_end)),
        exchange_(motion, middle_, k) {
    set_forcing(k);
  }

  ScalarAdvance take(BulkScalar& scalar) {
    const double stage = kStage * dt_, ratio = (1.0 - kStage) / kStage;
    start_ = set_system(kStage, 0.0, before_);
    Stage first{.right = start_, .begin = exchange_.carried(kStage), .T = before_};
    for (std::size_t i = 0; i < start_.size(); ++i) first.right[i] += stage * forcing_[i];
    if (Report solved = solve(first); !solved.ok()) return {std::move(solved)};

    // The first stage says what its rates are: (A first − start)/(kStage Δt).
    Stage second{
        .right = set_system(1.0, kStage, first.T), .begin = exchange_.carried(1.0), .T = before_};
    for (std::size_t i = 0; i < start_.size(); ++i) {
      second.right[i] = start_[i] + ratio * (second.right[i] - start_[i]) + stage * forcing_[i];
      // Stages lie on a line to first order.
      second.T[i] += (first.T[i] - before_[i]) / kStage;
    }
    add(second.begin, (1.0 - kStage) * dt_, first.rates);
    if (Report solved = solve(second); !solved.ok()) return {std::move(solved)};
    ByInterface mean = first.rates;
    for (std::vector<double>& values : mean)
      for (double& each : values) each *= 1.0 - kStage;
    add(mean, kStage, second.rates);
    ScalarAdvance result;
    if (!exchange_.empty()) result.uptake = exchange_.uptake(mean);
    settle(first.T, second.T, exchange_.loss(result.uptake), scalar);
    result.error = error_of(first.T, scalar);
    return result;
  }

 private:
  /// The right-hand sides of an implicit stage, whose matrix is the system, and what solves them.
  struct Stage {
    std::vector<double> right;
    ByInterface begin;  ///< Γ
    std::vector<double> T;
    ByInterface rates = {};  ///< j
  };

  static void add(ByInterface& sum, double factor, const ByInterface& term) {
    for (std::size_t i = 0; i < sum.size(); ++i)
      for (std::size_t n = 0; n < sum[i].size(); ++n) sum[i][n] += factor * term[i][n];
  }

  /// Solves a stage, once where nothing in it is a product of unknowns.
  Report solve(Stage& stage) {
    constexpr int kMostProducts = 20;
    constexpr double kProductTolerance = 1e-12;  // of concentrations, which are about 1
    const double length = kStage * dt_;
    const MatrixValues without = exchange_.is_linear() ? MatrixValues{} : system_;
    ByInterface guess = stage.begin;
    for (int pass = 0; pass < kMostProducts; ++pass) {
      std::vector<double> right = stage.right;
      if (pass > 0)
        std::ranges::copy(without, system_.begin());  // in place: the solver refers to it
      exchange_.add_to(system_, right, length, stage.begin, guess);
      fix_rows(space_, given_, system_, right);
      if (!solver_) solver_.emplace(view(system_), kind_of(space_, mass1_, matrices_, length));
      const linear::LinearReport report = solver_->solve(
          right, stage.T, exchange_.empty() ? kTolerance : kExchangeTolerance, kMostIterations);
      if (!report.converged)
        return {Fault{FaultKind::not_converged,
                      fmt::format("a scalar's equations were not solved: {}", report.reason)}};
      stage.rates = exchange_.rates(stage.T, length, stage.begin, guess);
      if (exchange_.is_linear()) return {};
      ByInterface reached = stage.begin;
      add(reached, length, stage.rates);
      double change = 0.0;
      for (std::size_t i = 0; i < guess.size(); ++i)
        for (std::size_t n = 0; n < guess[i].size(); ++n)
          change = std::max(change, std::abs(reached[i][n] - guess[i][n]));
      guess = std::move(reached);
      if (change < kProductTolerance) return {};
    }
    return {Fault{FaultKind::not_converged, "the adsorption of a surfactant was not found"}};
  }

  [[nodiscard]] TransportMatrices matrices_of(bool is_convected) const {
    Field<NodeId, Vec3> u(space_.num_nodes(), Vec3::Zero());
    const Field<NodeId, Vec3> none = u;
    const Field<NodeId, Vec3>& v = is_convected ? motion_.v : none;
    for (const NodeId i : u.ids())
      u[i] = v[i] - (motion_.at_end.x[i] - motion_.at_start.x[i]) / dt_;
    std::vector<double> growth(mass0_.rows.size());
    for (std::size_t i = 0; i < growth.size(); ++i)
      growth[i] = (mass1_.rows[i] - mass0_.rows[i]) / dt_;
    return transport_matrices(motion_.mesh, space_, middle_, {u, v, growth}, coefficients_, dt_);
  }

  /// What does not depend on the new values, as rates of amounts. The defect of the velocity takes
  /// the mean, so that a constant stays and no amount is lost.
  void set_forcing(std::size_t k) {
    const Scalar& scalar = motion_.start.scalars[k];
    forcing_ = given_flux(motion_.start, k, space_, middle_, over_peclet(scalar));
    flux_rate_ = sum(forcing_);
    std::vector<double> sources = std::move(matrices_.sources);
    if (scalar.brinkman > 0.0) {
      for (std::size_t i = 0; i < sources.size(); ++i)
        sources[i] += scalar.brinkman * over_peclet(scalar) * motion_.heat.by_node[i];
    }
    source_rate_ = sum(sources);
    note_drives(k);
    const double mean = dot(mass0_.rows, before_) / sum(mass0_.rows);
    for (std::size_t i = 0; i < forcing_.size(); ++i)
      forcing_[i] += sources[i] - mean * matrices_.defect[i];
  }

  /// Notes what may lead beyond the range of the values.
  void note_drives(std::size_t k) {
    const auto note = [&](double rate) {
      is_driven_up_ = is_driven_up_ || rate > 0.0;
      is_driven_down_ = is_driven_down_ || rate < 0.0;
    };
    note(motion_.start.scalars[k].brinkman);
    for (const double source : coefficients_.source) note(source);
    for (const Patch& patch : motion_.start.boundary.patches)
      if (patch.scalars[k].kind == ScalarCondition::Kind::flux) note(patch.scalars[k].flux);
  }

  [[nodiscard]] linear::CsrView view(const MatrixValues& values) const {
    return {space_.num_nodes(), space_.num_nodes(), space_.graph.row_start, space_.graph.columns,
            values};
  }

  /// Makes M_s + S − kStage Δt L the system, M_s the mass matrix after a share s of the step.
  /// Returns (M_r + S) x at another share r.
  [[nodiscard]] std::vector<double> set_system(double share, double share_of_x,
                                               std::span<const double> x) {
    const fem::NodeGraph& graph = space_.graph;
    system_.resize(matrices_.rates.size());
    std::vector<double> result(x.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
      double total = 0.0;
      for (auto e = static_cast<std::size_t>(graph.row_start[i]);
           e < static_cast<std::size_t>(graph.row_start[i + 1]); ++e) {
        const double start = mass0_.values[e] + matrices_.streamline[e],
                     change = mass1_.values[e] - mass0_.values[e];
        system_[e] = start + share * change - kStage * dt_ * matrices_.rates[e];
        total += (start + share_of_x * change) * x[static_cast<std::size_t>(graph.columns[e])];
      }
      result[i] = total;
    }
    return result;
  }

  /// Records the rates, and puts back what the linear solver's residual took of the amount.
  void settle(std::span<const double> first, std::vector<double>& second, double loss,
              BulkScalar& scalar) {
    const double before = dot(mass0_.rows, before_);
    double boundary = flux_rate_;
    if (!matrices_.inflow.empty())
      boundary +=
          (1.0 - kStage) * dot(matrices_.inflow, first) + kStage * dot(matrices_.inflow, second);
    if (given_.any) boundary += reaction(first, second);
    const double amount = before + dt_ * (boundary + source_rate_ - loss);
    keep_range(bounds(scalar), amount, mass1_.rows, space_, given_.is_given, second);
    scalar.boundary_rate = boundary;
    scalar.source_rate = source_rate_;
    scalar.values = std::move(second);
  }

  /// What lies between the step's end and the line through its first stage, as a root of the mean
  /// square. It is over that of the values before about their mean; 0 where they hardly vary.
  [[nodiscard]] double error_of(std::span<const double> first, const BulkScalar& scalar) const {
    const double mean = dot(mass0_.rows, before_) / sum(mass0_.rows);
    double difference = 0.0, spread = 0.0, whole = 0.0;
    for (std::size_t i = 0; i < before_.size(); ++i) {
      const double weight = std::abs(mass1_.rows[i]);
      const double line = before_[i] + (first[i] - before_[i]) / kStage;
      difference += weight * (scalar.values[i] - line) * (scalar.values[i] - line);
      spread += weight * (before_[i] - mean) * (before_[i] - mean);
      whole += weight;
    }
    constexpr double kHardly = 1e-3;  // of the values that the scalar may have
    const double size = kHardly * std::max({scalar.largest - scalar.least, std::abs(scalar.largest),
                                            std::abs(scalar.least)});
    return spread > size * size * whole ? std::sqrt(difference / spread) : 0.0;
  }

  /// The range that the scalar may have, with the values given; open where sources or fluxes lead
  /// beyond.
  [[nodiscard]] ValueBounds bounds(BulkScalar& scalar) const {
    for (std::size_t i = 0; i < given_.value.size(); ++i) {
      if (given_.is_given[i] == 0) continue;
      scalar.least = std::min(scalar.least, given_.value[i]);
      scalar.largest = std::max(scalar.largest, given_.value[i]);
    }
    ValueBounds result = around(scalar.least, scalar.largest);
    if (is_driven_down_ || !exchange_.empty()) result.least = ValueBounds{}.least;
    if (is_driven_up_ || !exchange_.empty()) result.largest = ValueBounds{}.largest;
    return result;
  }

  /// What comes through the nodes of given values: what their rows leave over.
  [[nodiscard]] double reaction(std::span<const double> first,
                                std::span<const double> second) const {
    const fem::NodeGraph& graph = space_.graph;
    double total = 0.0;
    for (std::size_t i = 0; i < start_.size(); ++i) {
      if (given_.is_given[i] == 0) continue;
      double end = 0.0, rate = 0.0;
      for (auto e = static_cast<std::size_t>(graph.row_start[i]);
           e < static_cast<std::size_t>(graph.row_start[i + 1]); ++e) {
        const auto j = static_cast<std::size_t>(graph.columns[e]);
        end += (mass1_.values[e] + matrices_.streamline[e]) * second[j];
        rate += matrices_.rates[e] * ((1.0 - kStage) * first[j] + kStage * second[j]);
      }
      total += (end - start_[i]) / dt_ - rate - forcing_[i];
    }
    return total;
  }

  const ScalarMotion& motion_;
  const ScalarSpace& space_;
  double dt_;
  Coefficients coefficients_;
  std::vector<double> before_;
  const MassMatrix &mass0_, &mass1_;
  NodePositions middle_;
  TransportMatrices matrices_;
  GivenValues given_;
  InterfaceExchange exchange_;
  MatrixValues system_;
  std::vector<double> start_;                      // (M_0 + S) T at the start
  std::optional<linear::TransportSolver> solver_;  // refers to the system
  std::vector<double> forcing_;
  double flux_rate_ = 0.0, source_rate_ = 0.0;
  bool is_driven_up_ = false, is_driven_down_ = false;
};

}  // namespace

std::vector<double> capacities(const Scene& scene, std::size_t k) {
  std::vector<double> result;
  for (const Liquid& liquid : scene.liquids) result.push_back(liquid.scalars[k].capacity);
  return result;
}

ScalarAdvance convect(const ScalarMotion& motion, std::size_t k, BulkScalar& scalar) {
  MENISCUS_ASSERT(static_cast<std::int32_t>(scalar.values.size()) == motion.space.num_nodes(),
                  "{} values at {} nodes", scalar.values.size(), motion.space.num_nodes());
  const std::vector<double> before = region_amounts(motion.mass_at_start, scalar.values);
  ScalarAdvance report = ScalarStep(motion, k, scalar).take(scalar);
  if (!report.ok()) return report;
  const std::vector<double> after = region_amounts(motion.mass_at_end, scalar.values);
  scalar.region_loss.resize(after.size());
  const Scalar& kind = motion.end.scalars[k];
  std::vector<double> heating(after.size(), 0.0);
  if (kind.brinkman > 0.0)
    for (std::size_t r = 0; r < heating.size(); ++r)
      heating[r] = kind.brinkman * over_peclet(kind) * motion.heat.by_region[r];
  for (std::size_t r = 0; r < after.size(); ++r)
    scalar.region_loss[r] = (before[r] - after[r]) / motion.duration + heating[r];
  return report;
}

DissipatedHeat dissipated_heat(const Scene& scene, const TetMesh& mesh, const ScalarSpace& space,
                               const NodePositions& positions, const Field<NodeId, Vec3>& v,
                               const BulkScalars& scalars) {
  const CellField<double> factors = fem::viscosity_factors(scene, mesh, space.elements, scalars);
  DissipatedHeat result{std::vector<double>(static_cast<std::size_t>(space.num_nodes()), 0.0),
                        std::vector<double>(static_cast<std::size_t>(scene.liquids.size()), 0.0)};
  with_kernel(space, positions, [&](auto& cell) {
    for (const CellId c : mesh.cells.ids()) {
      cell.go_to(c);
      const Liquid& liquid = scene.liquids[mesh.region[c]];
      const auto gradients = cell.gradients_of(v);
      for (std::size_t q = 0; q < gradients.size(); ++q) {
        const double squared = (0.5 * (gradients[q] + gradients[q].transpose())).squaredNorm();
        const double viscosity = factors[c] * liquid.viscosity *
                                 relative_viscosity(liquid.law, std::sqrt(2.0 * squared)).value;
        const double heat = cell.weights()[q] * 2.0 * viscosity * squared;
        result.by_region[static_cast<std::size_t>(mesh.region[c].value)] += heat;
        for (std::size_t i = 0; i < cell.nodes().size(); ++i)
          result.by_node[static_cast<std::size_t>(cell.nodes()[i])] +=
              heat * cell.values()[q * cell.kWidth + i];
      }
    }
  });
  return result;
}

Report conduct(const Scene& scene, const TetMesh& mesh, const ScalarSpace& space,
               const NodePositions& positions, std::size_t k, std::span<const double> heat,
               BulkScalar& scalar) {
  std::vector<double> conductivity;
  for (const Liquid& liquid : scene.liquids) conductivity.push_back(liquid.scalars[k].conductivity);
  const MatrixValues stiffness = stiffness_matrix(mesh, space, positions, conductivity);
  const GivenValues given = given_values(scene, k, space, positions);
  MENISCUS_ASSERT(given.any, "{} conducts at once and is given nowhere", scene.scalars[k].name);
  std::vector<double> right = given_flux(scene, k, space, positions, 1.0);
  const double flux = sum(right);
  for (std::size_t i = 0; i < heat.size(); ++i) right[i] += heat[i];
  const std::vector<double> free_right = right;
  MatrixValues system = stiffness;
  fix_rows(space, given, system, right);
  const linear::TransportSolver solver(
      {space.num_nodes(), space.num_nodes(), space.graph.row_start, space.graph.columns, system},
      linear::ScalarSystem::conduction);
  const linear::LinearReport report =
      solver.solve(right, scalar.values, kTolerance, kMostIterations);
  if (!report.converged)
    return {Fault{FaultKind::not_converged, fmt::format("the conduction of {} was not solved: {}",
                                                        scene.scalars[k].name, report.reason)}};
  const std::vector<double> left = product(space, stiffness, scalar.values);
  scalar.boundary_rate = flux;
  scalar.source_rate = sum(heat);
  for (std::size_t i = 0; i < left.size(); ++i)
    if (given.is_given[i] != 0) scalar.boundary_rate += left[i] - free_right[i];
  return {};
}

}  // namespace meniscus::bulk
