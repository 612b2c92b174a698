#include "meniscus/evolve/time_schemes.hpp"

#include <algorithm>
#include <cmath>

#include "meniscus/core/error.hpp"
#include "meniscus/evolve/chebyshev.hpp"
#include "meniscus/evolve/constants.hpp"
#include "meniscus/evolve/vertex_travel.hpp"
#include "meniscus/mesh/sphere_radius.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/scene/interface_tension.hpp"

namespace meniscus {
namespace {

/// sum ← sum + factor · term, for motions and for rates of amounts.
template <class Value>
void add(std::vector<VertexField<Value>>& sum, double factor,
         const std::vector<VertexField<Value>>& term) {
  for (std::size_t i = 0; i < sum.size(); ++i)
    for (const VertexId v : sum[i].ids()) sum[i][v] += factor * term[i][v];
}

/// factor · fields.
template <class Value>
std::vector<VertexField<Value>> scaled(double factor,
                                       const std::vector<VertexField<Value>>& fields) {
  std::vector<VertexField<Value>> result = fields;
  for (VertexField<Value>& field : result)
    for (Value& each : field) each *= factor;
  return result;
}

/// What a scheme takes along: how far from the start, over dt.
struct Displacement {
  InterfaceMotion vertices;
  AmountRates amounts;
};

Displacement scaled(double factor, const Displacement& displacement) {
  return {scaled(factor, displacement.vertices), scaled(factor, displacement.amounts)};
}

void add(Displacement& sum, double factor, const Displacement& term) {
  add(sum.vertices, factor, term.vertices);
  add(sum.amounts, factor, term.amounts);
}

/// The stage nearest to the middle of the step; never the first, which is of first order only.
std::size_t middle_stage(const std::vector<ChebyshevScheme::Stage>& stages) {
  std::size_t nearest = 1;
  for (std::size_t j = 2; j + 1 < stages.size(); ++j)
    if (std::abs(stages[j].c - 0.5) < std::abs(stages[nearest].c - 0.5)) nearest = j;
  return nearest;
}

/// By region.
std::vector<double> least_viscosities(const FlowSolution& flow, const Scene& scene) {
  if (!flow.least_viscosity.empty()) return flow.least_viscosity;
  std::vector<double> viscosities;
  for (const Liquid& liquid : scene.liquids) viscosities.push_back(liquid.viscosity);
  return viscosities;
}

double mean(const VertexField<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / values.size();
}

VertexField<double> difference(VertexField<double> a, const VertexField<double>& b) {
  for (const VertexId v : a.ids()) a[v] -= b[v];
  return a;
}

/// n·c, c the velocity of the enclosed centroid at normal speeds s.
VertexField<double> translation_speeds(const SurfaceMesh& mesh, const VertexField<double>& s) {
  const VertexField<Vec3> area = vertex_area_vectors(mesh);
  VertexField<double> swept = s, speeds;
  for (const VertexId v : s.ids()) swept[v] *= area[v].norm();
  const Vec3 c = centroid_velocity(mesh, swept);
  for (const Vec3& a : area) speeds.add(a.normalized().dot(c));
  return speeds;
}

/// Adds to rates of amounts what is expected to adsorb, and how it is carried.
void add_adsorption(AmountRates& rates, const SurfactantTransport& transport, const Step& step,
                    const SurfactantPath& path) {
  if (step.species.empty()) return;
  add(rates, 1.0,
      rates_of_sources(transport, path,
                       expected_uptake(step.start, path.at_start, step.species, path.duration)));
}

/// The same for a stage whose rates are those of transport alone, on its way from the start.
void add_adsorption(StageFlow& stage, const Step& step, double duration) {
  if (step.species.empty()) return;
  add_adsorption(stage.amount_rates, stage.surfactant, step,
                 surfactant_path(step, stage.motion, duration));
}

/// Gives a stage the rates with which a transport takes the amounts of surfactant from the start of
/// the step for `duration`.
void set_mean_rates(StageFlow& stage, const SurfactantTransport& transport, const Step& step,
                    double duration) {
  if (!has_surfactant(step.start)) return;
  const SurfactantPath path = surfactant_path(step, stage.motion, duration);
  stage.amount_rates = mean_amount_rates(transport, path);
  add_adsorption(stage.amount_rates, transport, step, path);
}
/// The same by the stage's own transport.
void set_mean_rates(StageFlow& stage, const Step& step, double duration) {
  set_mean_rates(stage, stage.surfactant, step, duration);
}

/// The same; what transport alone gives is damped about other rates of concentrations (none: zero).
/// Returns these rates.
ConcentrationRates set_damped_rates(StageFlow& stage, const Step& step, double duration,
                                    const ConcentrationRates& about, const StageDampers& damp) {
  if (!has_surfactant(step.start)) return {};
  const SurfactantPath path = surfactant_path(step, stage.motion, duration);
  ConcentrationRates rates = concentration_rates(path, mean_amount_rates(stage.surfactant, path));
  rates = damp.concentrations(stage, path, rates, about.empty() ? scaled(0.0, rates) : about);
  stage.amount_rates = amount_rates_of(path, rates);
  add_adsorption(stage.amount_rates, stage.surfactant, step, path);
  return rates;
}

/// Of rates that take amounts through the whole step.
double amount_error(const Step& step, const SurfactantTransport& transport,
                    const AmountRates& second, const AmountRates& first) {
  if (!has_surfactant(step.start)) return 0.0;
  return surfactant_error({step.start, step.carriers.of(step.start), {}, step.dt}, transport,
                          second, first);
}

double stage_error(const Step& step, const StageFlow& second, const StageFlow& first) {
  return std::max(step_error(step, second.normal_speed, first.normal_speed),
                  amount_error(step, second.surfactant, second.amount_rates, first.amount_rates));
}

/// Gives a stage other normal speeds beyond its rigid motions.
void set_rest(StageFlow& stage, const Scene& scene, const NormalSpeeds& rest,
              const NormalSpeeds& damped) {
  for (std::size_t i = 0; i < rest.size(); ++i)
    for (const VertexId v : rest[i].ids()) {
      const double change = damped[i][v] - rest[i][v];
      stage.normal_speed[i][v] += change;
      stage.shape.rest[i][v] += change * stage.normals[i][v];
      stage.flow.velocity[i][v] += change * stage.normals[i][v];
    }
  stage.surface_rate = surface_energy_rate(scene, velocity_of(stage.shape, scene));
}

/// Leaves a shape a share of its spin; the normal speeds of the other part join the rest.
void keep_spin(ShapeMotion& shape, std::size_t i, const SurfaceMesh& mesh,
               const VertexField<Vec3>& normals, double share) {
  RigidMotion& rigid = shape.rigid[i];
  const Vec3 given_up = (1.0 - share) * rigid.spin;
  rigid.spin *= share;
  for (const VertexId v : normals.ids())
    shape.rest[i][v] += normals[v].dot(given_up.cross(mesh.x[v] - rigid.center)) * normals[v];
}

/// a + factor (b − a), node by node.
std::vector<Vec3> beyond(const std::vector<Vec3>& a, const std::vector<Vec3>& b, double factor) {
  std::vector<Vec3> result = a;
  for (std::size_t i = 0; i < result.size(); ++i) result[i] += factor * (b[i] - a[i]);
  return result;
}

/// The velocity in the bulk a + factor (b − a), which carries the scalars of a step.
std::optional<FlowSolution> carrier_of(const Step& step, const FlowSolution& a,
                                       const FlowSolution& b, double factor) {
  if (step.start.scalars.empty()) return {};
  FlowSolution result;
  result.bulk = *a.bulk;
  for (const TetVertexId v : result.bulk->v.ids())
    result.bulk->v[v] += factor * (b.bulk->v[v] - a.bulk->v[v]);
  result.bulk->v_at_edges = beyond(a.bulk->v_at_edges, b.bulk->v_at_edges, factor);
  return result;
}

/// a − b.
InterfaceMotion difference(InterfaceMotion a, const InterfaceMotion& b) {
  add(a, -1.0, b);
  return a;
}

NormalSpeeds zero_speeds(NormalSpeeds like) {
  for (VertexField<double>& speeds : like) std::ranges::fill(speeds, 0.0);
  return like;
}

}  // namespace

StageFlow euler_step(const StageFlow& first, const Step& step) {
  StageFlow whole = first;
  set_mean_rates(whole, step, step.dt);
  return whole;
}

StageFlow midpoint_step(const StageFlow& first, const Step& step, const StageSolver& solve) {
  const double half = 0.5 * step.dt;
  StageFlow start = first;
  set_mean_rates(start, step, half);
  StageFlow middle =
      solve(start, half, {.t = step.t + half, .dt = step.dt, .stage = Stage::middle});
  if (!middle.ok()) return middle;
  set_mean_rates(middle, step, step.dt);
  middle.error = stage_error(step, middle, start);
  return middle;
}

StageFlow semi_implicit_step(const StageFlow& first, const Step& step, const StageSolver& solve,
                             const StageDampers& damp) {
  const double half = 0.5 * step.dt;
  StageFlow start = first;
  damp.speeds(start, zero_speeds(first.normal_speed));
  start.motion = mean_motion(step.start, first.shape, start.shape, half);
  const ConcentrationRates at_start = set_damped_rates(start, step, half, {}, damp);
  StageFlow middle =
      solve(start, half, {.t = step.t + half, .dt = step.dt, .stage = Stage::middle});
  if (!middle.ok()) return middle;
  damp.speeds(middle, normal_speeds(start.normals, start.shape.rest));
  middle.motion = mean_motion(step.start, first.shape, middle.shape, step.dt);
  set_damped_rates(middle, step, step.dt, at_start, damp);
  middle.error = stage_error(step, middle, start);
  middle.damps_waves = true;
  return middle;
}

void damp(StageFlow& stage, const Scene& scene, const NormalSpeeds& about, const Damping& damping) {
  const std::vector<double> viscosities = least_viscosities(stage.flow, scene);
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i)
    keep_spin(stage.shape, i, scene.interfaces[i].mesh, stage.normals[i],
              share_of_spin(scene.interfaces[i], viscosities, damping));
  const NormalSpeeds rest = normal_speeds(stage.normals, stage.shape.rest);
  set_rest(stage, scene, rest, damped_speeds(scene, viscosities, rest, about, damping));
}

void slow_down(StageFlow& stage, const Scene& scene, const NormalSpeeds& about, double duration) {
  const NormalSpeeds rest = normal_speeds(stage.normals, stage.shape.rest);
  set_rest(stage, scene, rest, expected_speeds(scene, rest, about, duration));
}

SurfactantPath surfactant_path(const Step& step, const InterfaceMotion& motion, double duration) {
  Scene end = step.start;
  move_interfaces(end, motion, duration);
  return {step.start, step.carriers.of(step.start), step.carriers.of(end), duration};
}

ConcentrationRates damped(const StageFlow& stage, const SurfactantPath& path,
                          const ConcentrationRates& rates, const ConcentrationRates& about,
                          const Damping& damping) {
  return damped_concentration_rates(path.start, least_viscosities(stage.flow, path.start), rates,
                                    about, path.at_end, damping);
}

StageFlow implicit_step(const StageFlow& first, const Step& step, const ImplicitSolver& solve,
                        const StageDamper& expect) {
  const double gamma = kImplicitShare, first_part = gamma * step.dt, weight = 1.0 - gamma;
  const NodalFlow& at_start = *first.flow.nodal;
  // First stage, to which interfaces are expected to go as they begin.
  StageFlow start = first;
  expect(start, zero_speeds(first.normal_speed));
  start.motion = velocity_of(start.shape, step.start);
  set_mean_rates(start, step, first_part);
  StageFlow middle =
      solve(start, first_part, {.t = step.t + first_part, .dt = step.dt, .stage = Stage::middle},
            {first_part, at_start.x, at_start.v, at_start.v,
             difference(start.shape.rest, first.shape.rest)});
  if (!middle.ok()) return middle;
  const NodalFlow& at_middle = *middle.flow.nodal;
  // Second stage: what remains of the way is expected at a speed that goes on to change.
  const double ahead = weight / gamma;
  StageFlow expected = middle;
  for (std::size_t i = 0; i < expected.motion.size(); ++i)
    for (const VertexId v : expected.motion[i].ids()) {
      const double change =
          ahead * middle.normals[i][v].dot(middle.shape.rest[i][v] - first.shape.rest[i][v]);
      expected.shape.rest[i][v] += change * middle.normals[i][v];
      expected.motion[i][v] += ahead * (middle.motion[i][v] - first.motion[i][v]);
    }
  const InterfaceMotion undamped = expected.shape.rest;
  expect(expected, normal_speeds(middle.normals, start.shape.rest));
  const InterfaceMotion slowing = difference(expected.shape.rest, undamped);
  add(expected.motion, 1.0, slowing);
  StageFlow to_end = middle;
  to_end.motion = scaled(weight, middle.motion);
  add(to_end.motion, gamma, expected.motion);
  set_mean_rates(to_end, combined(1.0 + weight, middle.surfactant, -weight, first.surfactant), step,
                 step.dt);
  StageFlow end = solve(
      to_end, step.dt, {.t = step.t + step.dt, .dt = step.dt, .stage = Stage::end},
      {first_part, beyond(at_start.x, at_middle.x, ahead), beyond(at_start.v, at_middle.v, ahead),
       beyond(at_middle.v, at_start.v, -ahead), slowing});
  if (!end.ok()) return end;
  // The whole: what the stages give together.
  InterfaceMotion whole = scaled(weight, middle.motion);
  add(whole, gamma, end.motion);
  end.motion = std::move(whole);
  end.carrier = carrier_of(step, middle.flow, end.flow, gamma);
  set_mean_rates(end, combined(weight, middle.surfactant, gamma, end.surfactant), step, step.dt);
  end.surface_rate = weight * middle.surface_rate + gamma * end.surface_rate;
  const InterfaceNormals normals = interface_normals(step.start, MotionNormal::area_vector);
  end.error = std::max(
      step_error(step, normal_speeds(normals, end.motion), normal_speeds(normals, start.motion)),
      amount_error(step, end.surfactant, end.amount_rates, start.amount_rates));
  end.damps_waves = true;
  return end;
}

StageFlow chebyshev_step(const StageFlow& first, const Step& step, const ChebyshevScheme& scheme,
                         const StageSolver& solve) {
  const std::size_t middle = middle_stage(scheme.stages());
  // Displacements from the start over dt: of the last two stages, and of the middle one.
  const Displacement at_first{first.motion, first.amount_rates};
  Displacement before = scaled(0.0, at_first), now = before, to_middle;
  StageFlow stage = first;
  double middle_rate = 0.0;
  std::optional<FlowSolution> carrier;
  for (std::size_t j = 0; j < scheme.stages().size(); ++j) {
    const ChebyshevScheme::Stage& c = scheme.stages()[j];
    Displacement next = scaled(c.mu, now);
    add(next, c.nu, before);
    add(next, c.mu_F, Displacement{stage.motion, stage.amount_rates});
    add(next, c.gamma_F, at_first);
    before = std::exchange(now, std::move(next));
    if (j + 1 == scheme.stages().size()) break;
    stage.motion = scaled(1.0 / c.c, now.vertices);
    stage.amount_rates = scaled(1.0 / c.c, now.amounts);
    add_adsorption(stage, step, c.c * step.dt);
    stage = solve(stage, c.c * step.dt,
                  {.t = step.t + c.c * step.dt, .dt = step.dt, .stage = Stage::middle});
    if (!stage.ok()) return stage;
    if (j != middle) continue;
    to_middle = now;
    middle_rate = stage.surface_rate;
    carrier = carrier_of(step, first.flow, stage.flow, 1.0 / (2.0 * c.c));
  }
  const double c = scheme.stages()[middle].c;
  const InterfaceNormals normals = interface_normals(step.start, MotionNormal::area_vector);
  const Displacement line = scaled(1.0 / c, to_middle);
  stage.error = std::max(step_error(step, normal_speeds(normals, now.vertices),
                                    normal_speeds(normals, line.vertices)),
                         amount_error(step, stage.surfactant, now.amounts, line.amounts)) /
                (1.0 - c);
  stage.surface_rate = first.surface_rate + (middle_rate - first.surface_rate) / (2.0 * c);
  stage.motion = std::move(now.vertices);
  stage.carrier = std::move(carrier);
  stage.amount_rates = std::move(now.amounts);
  add_adsorption(stage, step, step.dt);
  stage.damps_waves = true;
  return stage;
}

double step_error(const Step& step, const NormalSpeeds& second, const NormalSpeeds& first) {
  MENISCUS_ASSERT(first.size() == second.size(), "{} {}", first.size(), second.size());
  std::vector<VertexField<double>> edges;
  double coarse_edge = 0.0;
  for (const Interface& interface : step.start.interfaces) {
    edges.push_back(shortest_edges(interface.mesh));
    coarse_edge = std::max(coarse_edge, mean(edges.back()));
  }
  double largest = 0.0;
  for (std::size_t i = 0; i < second.size(); ++i) {
    const Interface& interface = step.start.interfaces[i];
    const double way = std::min(coarse_edge, sphere_radius(interface.volume));
    const VertexField<double> apart = difference(second[i], first[i]),
                              carried = translation_speeds(interface.mesh, apart);
    for (const VertexId v : apart.ids()) {
      const double edge = edges[i][v];
      const double error = (apart[v] - carried[v]) / edge + carried[v] / std::max(edge, way);
      largest = std::max(largest, step.dt * std::abs(error));
    }
  }
  return largest;
}

}  // namespace meniscus
