#include "meniscus/transport/bulk/finite_element_scalars.hpp"

#include <algorithm>
#include <deque>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/core/log.hpp"
#include "meniscus/flow/fem/node_sources.hpp"
#include "meniscus/transport/bulk/cell_kernel.hpp"
#include "meniscus/transport/bulk/keep_range.hpp"
#include "meniscus/transport/bulk/scalar_measures.hpp"
#include "meniscus/transport/bulk/scalar_step.hpp"

namespace meniscus::bulk {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// The liquid's velocity at the nodes; zero where no flow is known.
Field<NodeId, Vec3> node_velocity(const FlowSolution& flow, const ScalarSpace& space) {
  Field<NodeId, Vec3> v;
  v.reserve(space.num_nodes());
  if (!flow.bulk) return Field<NodeId, Vec3>(space.num_nodes(), Vec3::Zero());
  for (const Vec3& each : flow.bulk->v) v.add(each);
  for (const Vec3& each : flow.bulk->v_at_edges) v.add(each);
  MENISCUS_ASSERT(v.size() == space.num_nodes(), "velocities of {} of {} nodes", v.size(),
                  space.num_nodes());
  return v;
}

double amount(std::span<const double> rows, std::span<const double> values) {
  return std::inner_product(rows.begin(), rows.end(), values.begin(), 0.0);
}

/// A fault where a species is below zero by more than a hundredth of its largest concentration, or
/// not a number.
std::optional<Fault> find_negative(const Scalar& kind, const BulkScalar& scalar,
                                   const NodePositions& positions) {
  if (!kind.is_species) return {};
  const double least =
      around(0.0, std::max(scalar.largest, *std::ranges::max_element(scalar.values))).least;
  for (const NodeId i : positions.x.ids()) {
    const double value = scalar.values[at(i.value)];
    if (value >= least) continue;
    return Fault{FaultKind::concentration,
                 fmt::format("the concentration of {} falls to {:.4g} (in the matrix) at {}; it "
                             "must be at least 0",
                             kind.name, value, text_of(positions.x[i])),
                 positions.x[i]};
  }
  return {};
}

/// Adds what interfaces took up of one species.
void take_up(const std::vector<VertexField<double>>& part,
             std::vector<VertexField<double>>& total) {
  if (total.empty()) total.resize(part.size());
  for (std::size_t i = 0; i < part.size(); ++i)
    if (!part[i].empty()) total[i] = part[i];
}

class FiniteElementScalars final : public ScalarSolver {
 public:
  explicit FiniteElementScalars(std::shared_ptr<fem::KnownElements> elements)
      : elements_(std::move(elements)) {}

  Report initial(const FlowDomain& domain, BulkScalars& scalars) override;
  std::size_t num_values(const FlowDomain& domain) override;
  ScalarAdvance advance(const ScalarPath& path, BulkScalars& scalars) override;
  void ride(const FlowDomain& from, const FlowDomain& to, BulkScalars& scalars) override;
  BulkScalars follow(const MeshChange& change, const Scene& before, const FlowDomain& domain,
                     const BulkScalars& scalars) override;
  std::vector<ScalarMeasures> measures(const FlowDomain& domain,
                                       const BulkScalars& scalars) override;
  const PhaseTimes& times() const override { return times_; }

 private:
  /// The space on a domain's mesh, and where its nodes are.
  struct Placed {
    std::int64_t connectivity = 0;
    std::shared_ptr<const ScalarSpace> space;
    Field<TetVertexId, Vec3> vertices;  ///< that the positions were found for
    std::shared_ptr<const NodePositions> positions;
    /// By scalar, those that were asked for.
    std::shared_ptr<std::vector<std::unique_ptr<const MassMatrix>>> masses;
  };
  const Placed& placed(const FlowDomain& domain);
  static std::vector<double> initial_values(const Scene& scene, const TetMesh& mesh,
                                            const Placed& here, std::size_t k);
  static const MassMatrix& mass(const Placed& at, const Scene& scene, const TetMesh& mesh,
                                std::size_t k);

  std::shared_ptr<fem::KnownElements> elements_;
  std::deque<Placed> last_;  // a step asks again for its start
  PhaseTimes times_;
};

const FiniteElementScalars::Placed& FiniteElementScalars::placed(const FlowDomain& domain) {
  constexpr std::size_t kMostKept = 3;
  MENISCUS_ASSERT(domain.mesh != nullptr, "bulk scalars need a volume mesh");
  std::shared_ptr<const ScalarSpace> space;
  for (const Placed& each : last_) {
    if (each.connectivity != domain.connectivity) continue;
    space = each.space;
    if (each.vertices == domain.mesh->x) return each;
  }
  if (!space)
    space = std::make_shared<const ScalarSpace>(scalar_space(domain, elements_->space(domain)));
  last_.push_front({domain.connectivity, std::move(space), domain.mesh->x,
                    elements_->positions(domain),
                    std::make_shared<std::vector<std::unique_ptr<const MassMatrix>>>(
                        domain.scene.scalars.size())});
  if (last_.size() > kMostKept) last_.pop_back();
  return last_.front();
}

const MassMatrix& FiniteElementScalars::mass(const Placed& at, const Scene& scene,
                                             const TetMesh& mesh, std::size_t k) {
  std::unique_ptr<const MassMatrix>& known = (*at.masses)[k];
  if (!known)
    known = std::make_unique<const MassMatrix>(
        mass_matrix(scene, mesh, *at.space, *at.positions, capacities(scene, k)));
  return *known;
}

/// The liquids' profiles at the nodes; where liquids meet, their mean by what the node holds of
/// each.
std::vector<double> FiniteElementScalars::initial_values(const Scene& scene, const TetMesh& mesh,
                                                         const Placed& here, std::size_t k) {
  const std::vector<double> filling =
      volume_shares(scene, element_volumes(mesh, *here.space, *here.positions));
  std::vector<double> held(at(here.space->num_nodes()), 0.0), room = held;
  with_kernel(*here.space, *here.positions, [&](auto& cell) {
    for (const CellId c : mesh.cells.ids()) {
      cell.go_to(c, false);
      const ScalarLiquid& liquid = scene.liquids[mesh.region[c]].scalars[k];
      const double unit = scene.scalars[k].is_species ? liquid.capacity : 1.0;
      const auto shares = cell.shares();
      for (std::size_t i = 0; i < shares.size(); ++i) {
        const std::int32_t node = cell.nodes()[i];
        const double weight = filling[at(mesh.region[c].value)] * liquid.capacity * shares[i];
        held[at(node)] += weight * liquid.initial.at(here.positions->x[NodeId{node}]) / unit;
        room[at(node)] += weight;
      }
    }
  });
  for (std::size_t i = 0; i < held.size(); ++i) held[i] /= room[i];
  return held;
}

Report FiniteElementScalars::initial(const FlowDomain& domain, BulkScalars& scalars) {
  const PhaseTimer timer(times_, "scalars");
  const Scene& scene = domain.scene;
  const TetMesh& mesh = *domain.mesh;
  const Placed here = placed(domain);
  scalars.assign(scene.scalars.size(), {});
  for (std::size_t k = 0; k < scalars.size(); ++k) {
    scalars[k].values = initial_values(scene, mesh, here, k);
    const auto [least, largest] = std::ranges::minmax(scalars[k].values);
    scalars[k].least = least;
    scalars[k].largest = largest;
    if (scene.scalars[k].peclet == 0.0)
      if (Report solved = conduct(scene, mesh, *here.space, *here.positions, k, {}, scalars[k]);
          !solved.ok())
        return solved;
    if (auto fault = find_negative(scene.scalars[k], scalars[k], *here.positions))
      return {std::move(fault)};
  }
  return {};
}

std::size_t FiniteElementScalars::num_values(const FlowDomain& domain) {
  return at(placed(domain).space->num_nodes());
}

ScalarAdvance FiniteElementScalars::advance(const ScalarPath& path, BulkScalars& scalars) {
  const PhaseTimer timer(times_, "scalars");
  const Placed from = placed(path.start), to = placed(path.end);
  MENISCUS_ASSERT(from.connectivity == to.connectivity, "a path between meshes {} and {}",
                  from.connectivity, to.connectivity);
  const Field<NodeId, Vec3> v = node_velocity(path.flow, *to.space);
  ScalarAdvance result;
  const DissipatedHeat heat =
      std::ranges::any_of(path.end.scene.scalars,
                          [](const Scalar& each) { return each.brinkman > 0.0; })
          ? dissipated_heat(path.end.scene, *path.end.mesh, *to.space, *to.positions, v, scalars)
          : DissipatedHeat{};
  for (std::size_t k = 0; k < scalars.size(); ++k) {
    const Scalar& scalar = path.end.scene.scalars[k];
    if (scalar.peclet > 0.0) {
      const ScalarMotion motion{path.start.scene,
                                path.end.scene,
                                *path.end.mesh,
                                *to.space,
                                *from.positions,
                                *to.positions,
                                mass(from, path.start.scene, *path.start.mesh, k),
                                mass(to, path.end.scene, *path.end.mesh, k),
                                v,
                                heat,
                                path.duration,
                                path.expected_adsorption};
      ScalarAdvance moved = convect(motion, k, scalars[k]);
      if (!moved.ok()) return moved;
      // A species that is exchanged has no bounds (`keep_range`), and undershoots beside fronts.
      if (moved.uptake.empty())
        if (auto fault = find_negative(scalar, scalars[k], *to.positions))
          return {std::move(fault)};
      take_up(moved.uptake, result.uptake);
      result.error = std::max(result.error, moved.error);
      continue;
    }
    std::vector<double> sources;
    if (scalar.brinkman > 0.0)
      for (const double each : heat.by_node) sources.push_back(scalar.brinkman * each);
    if (Report solved = conduct(path.end.scene, *path.end.mesh, *to.space, *to.positions, k,
                                sources, scalars[k]);
        !solved.ok())
      return {std::move(solved)};
    if (auto fault = find_negative(scalar, scalars[k], *to.positions)) return {std::move(fault)};
  }
  return result;
}

void FiniteElementScalars::ride(const FlowDomain& from, const FlowDomain& to,
                                BulkScalars& scalars) {
  const PhaseTimer timer(times_, "scalars");
  const Placed before = placed(from), after = placed(to);
  for (std::size_t k = 0; k < scalars.size(); ++k) {
    if (to.scene.scalars[k].peclet == 0.0) continue;  // has no amount to keep
    keep_range({}, amount(mass(before, from.scene, *from.mesh, k).rows, scalars[k].values),
               mass(after, to.scene, *to.mesh, k).rows, *after.space,
               given_values(to.scene, k, *after.space, *after.positions).is_given,
               scalars[k].values);
  }
}

BulkScalars FiniteElementScalars::follow(const MeshChange& change, const Scene& before,
                                         const FlowDomain& domain, const BulkScalars& scalars) {
  const PhaseTimer timer(times_, "scalars");
  const auto old_space = std::ranges::find_if(
      last_, [&](const Placed& each) { return each.vertices == change.before.x; });
  MENISCUS_ASSERT(old_space != last_.end(), "the mesh before the change is not known");
  const Placed old = *old_space;
  const Placed now = placed(domain);
  auto sources = elements_->sources(change, domain);
  if (!sources)  // after many stages of the flow on the mesh before
    sources = std::make_shared<const std::vector<fem::NodeSource>>(
        fem::node_sources({change.before, old.space->elements, *old.positions},
                          {*domain.mesh, now.space->elements, *now.positions}, change.sources));
  BulkScalars result(scalars.size());
  for (std::size_t k = 0; k < scalars.size(); ++k) {
    result[k] = scalars[k];
    if (!change.sources.empty()) result[k].region_loss.clear();
    result[k].values =
        fem::interpolated_values<double>(scalars[k].values, old.space->elements, *sources);
    const GivenValues given = given_values(domain.scene, k, *now.space, *now.positions);
    for (std::size_t i = 0; i < given.value.size(); ++i)
      if (given.is_given[i] != 0) result[k].values[i] = given.value[i];
    const Scalar& scalar = domain.scene.scalars[k];
    if (scalar.peclet == 0.0) {  // has no amount to keep
      if (scalar.brinkman == 0.0 &&
          !conduct(domain.scene, *domain.mesh, *now.space, *now.positions, k, {}, result[k]).ok())
        log::debug("{} stays as interpolated", scalar.name);
      continue;
    }
    const auto [low, high] = std::ranges::minmax(scalars[k].values);
    const ValueBounds range = around(scalars[k].least, scalars[k].largest);
    keep_range({std::min(range.least, low), std::max(range.largest, high)},
               amount(mass(old, before, change.before, k).rows, scalars[k].values),
               mass(now, domain.scene, *domain.mesh, k).rows, *now.space, given.is_given,
               result[k].values);
  }
  return result;
}

std::vector<ScalarMeasures> FiniteElementScalars::measures(const FlowDomain& domain,
                                                           const BulkScalars& scalars) {
  const PhaseTimer timer(times_, "diagnostics");
  const Placed here = placed(domain);
  std::vector<ScalarMeasures> result;
  for (std::size_t k = 0; k < scalars.size(); ++k)
    result.push_back(scalar_measures(domain.scene, *domain.mesh, *here.space, *here.positions,
                                     mass(here, domain.scene, *domain.mesh, k), k, scalars[k]));
  return result;
}

}  // namespace

std::unique_ptr<ScalarSolver> make_finite_element_scalars(
    std::shared_ptr<fem::KnownElements> elements) {
  return std::make_unique<FiniteElementScalars>(std::move(elements));
}

}  // namespace meniscus::bulk
