#include "meniscus/evolve/state.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "meniscus/core/archive_entries.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/evolve/constants.hpp"
#include "meniscus/evolve/event_archive.hpp"
#include "meniscus/mesh/field_archive.hpp"
#include "meniscus/mesh/surface_archive.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/scene/interface_tension.hpp"
#include "meniscus/surface/carry_fields.hpp"

namespace meniscus {
namespace {

// Name of an entry in a checkpoint. A `from-run` drop reads interfaces/<i>/x and faces.
std::string interface_path(std::size_t i) { return fmt::format("interfaces/{}", i); }
std::string interface_path(std::size_t i, const char* name) {
  return fmt::format("{}/{}", interface_path(i), name);
}

/// Kind and constants of the equation of state, and the diffusivity.
void save_surfactant(const Surfactant& surfactant, std::size_t i, Archive& archive) {
  std::array<double, 4> values{static_cast<double>(surfactant.state.index()), 0.0, 0.0,
                               surfactant.diffusivity};
  if (const auto* law = std::get_if<LinearState>(&surfactant.state)) values[1] = law->elasticity;
  if (const auto* law = std::get_if<LangmuirState>(&surfactant.state)) {
    values[1] = law->elasticity;
    values[2] = law->coverage;
  }
  archive.reals[interface_path(i, "surfactant")].assign(values.begin(), values.end());
  if (const auto& law = surfactant.adsorption)
    archive.reals[interface_path(i, "adsorption")] = {static_cast<double>(law->species), law->biot,
                                                      law->constant, law->depth};
}

/// Throws InvalidInput where the concentration saved with it leaves no tension.
void load_surfactant(Interface& interface, std::size_t i, const Archive& archive) {
  const std::string path = interface_path(i, "surfactant");
  if (!archive.reals.contains(path)) return;
  const auto& values = entry_of_size(archive.reals, path, 4);
  Surfactant surfactant{LinearState{values[1]}, values[3], {}};
  if (values[0] == 1.0) surfactant.state = LangmuirState{values[1], values[2]};
  if (const std::string law = interface_path(i, "adsorption"); archive.reals.contains(law)) {
    const auto& row = entry_of_size(archive.reals, law, 4);
    surfactant.adsorption = {static_cast<int>(row[0]), row[1], row[2], row[3]};
  }
  const auto& fields = interface.fields.on_vertices;
  if (std::ranges::find(fields, kSurfactantField, &CarriedField<VertexId>::name) == fields.end())
    reject_input("checkpoint: drop {} has a surfactant and no concentration", interface.drop);
  interface.surfactant = surfactant;
}

void save_interface(const Interface& interface, std::size_t i, Archive& archive) {
  save(interface.mesh, archive, interface_path(i));
  archive.integers[interface_path(i, "ids")] = {interface.drop, interface.parent,
                                                interface.inside.value, interface.outside.value};
  archive.reals[interface_path(i, "properties")] = {interface.tension, interface.C0,
                                                    interface.volume, interface.initial_volume};
  save(interface.fields, archive, interface_path(i, "fields"));
  if (interface.surfactant) save_surfactant(*interface.surfactant, i, archive);
}

/// Throws InvalidInput unless the surface is closed and encloses about the volume saved with it, as
/// every interface does that was saved.
void require_sound(const Interface& interface) {
  if (const auto fault = find_broken_connectivity(interface.mesh))
    reject_input("checkpoint: drop {}: {}", interface.drop, fault->text);
  const double enclosed = enclosed_volume(interface.mesh);
  if (!(enclosed > kLeastVolumeKept * interface.volume &&
        enclosed < kMostVolumeKept * interface.volume))
    reject_input("checkpoint: drop {} encloses {:.4g}, and its volume is {:.4g}", interface.drop,
                 enclosed, interface.volume);
}

/// Throws InvalidInput unless time, step and regions are such as a run can have.
void require_sound(const State& state) {
  if (!(state.t >= 0.0) || !(state.dt >= 0.0) || !std::isfinite(state.t + state.dt) ||
      state.step < 0)
    reject_input("checkpoint: step {} at t = {:g} after {:g} is none of a run", state.step, state.t,
                 state.dt);
  const auto is_region = [&](RegionId region) {
    return region.value >= 0 && region.value < state.scene.liquids.size();
  };
  for (const Interface& interface : state.scene.interfaces)
    if (!is_region(interface.inside) || !is_region(interface.outside))
      reject_input("checkpoint: drop {} lies between regions {} and {} of {}", interface.drop,
                   interface.inside.value, interface.outside.value, state.scene.liquids.size());
}

Interface load_interface(const Archive& archive, std::size_t i) {
  Interface interface;
  interface.mesh = load_surface(archive, interface_path(i));
  const auto& ids = entry_of_size(archive.integers, interface_path(i, "ids"), 4);
  interface.drop = static_cast<int>(ids[0]);
  interface.parent = static_cast<int>(ids[1]);
  interface.inside = RegionId{static_cast<std::int32_t>(ids[2])};
  interface.outside = RegionId{static_cast<std::int32_t>(ids[3])};
  const auto& properties = entry_of_size(archive.reals, interface_path(i, "properties"), 4);
  interface.tension = properties[0];
  interface.C0 = properties[1];
  interface.volume = properties[2];
  interface.initial_volume = properties[3];
  require_sound(interface);
  interface.fields = load_fields(archive, interface_path(i, "fields"), interface.mesh);
  load_surfactant(interface, i, archive);
  return interface;
}

// Saves the liquids of the regions, which change with the interfaces.
void save_liquids(const Scene& scene, Archive& archive) {
  std::vector<double>& values = archive.reals["evolution/liquids"];
  MENISCUS_ASSERT(scene.liquids.size() > static_cast<std::int32_t>(scene.interfaces.size()),
                  "{} liquids for {} interfaces", scene.liquids.size(), scene.interfaces.size());
  for (const Liquid& liquid : scene.liquids)
    values.insert(values.end(), {liquid.viscosity, liquid.body_force.x(), liquid.body_force.y(),
                                 liquid.body_force.z()});
}

// Saves kind and parameters of each viscosity law. Newtonian liquids write nothing, so that old
// checkpoints without laws stay valid.
void save_laws(const Scene& scene, Archive& archive) {
  if (std::ranges::all_of(scene.liquids, is_newtonian, &Liquid::law)) return;
  std::vector<double>& values = archive.reals["evolution/liquid-laws"];
  for (const Liquid& liquid : scene.liquids) {
    std::array<double, 5> row{static_cast<double>(liquid.law.index()), 0.0, 0.0, 0.0, 0.0};
    if (const auto* law = std::get_if<CarreauYasuda>(&liquid.law))
      row = {row[0], law->time_constant, law->power_index, law->yasuda_exponent,
             law->infinite_ratio};
    if (const auto* law = std::get_if<PowerLaw>(&liquid.law))
      row = {row[0], law->power_index, law->floor, law->ceiling, 0.0};
    values.insert(values.end(), row.begin(), row.end());
  }
}

void load_laws(const Archive& archive, Field<RegionId, Liquid>& liquids) {
  if (!archive.reals.contains("evolution/liquid-laws")) return;
  const auto count = static_cast<std::size_t>(liquids.size());
  const auto& values = entry_of_size(archive.reals, "evolution/liquid-laws", 5 * count);
  for (const RegionId region : liquids.ids()) {
    const double* row = values.data() + std::ptrdiff_t{5} * region.value;
    ViscosityLaw& law = liquids[region].law;
    if (row[0] == 1.0) law = CarreauYasuda{row[1], row[2], row[3], row[4]};
    if (row[0] == 2.0) law = PowerLaw{row[1], row[2], row[3]};
  }
}

// What bulk scalars meet in each liquid, and the scalars themselves. Scenes without write nothing.
void save_scalars(const State& state, Archive& archive) {
  for (std::size_t k = 0; k < state.scene.scalars.size(); ++k) {
    const std::string path = fmt::format("evolution/scalar{}", k);
    std::vector<double>& liquids = archive.reals[path + "/liquids"];
    for (const Liquid& liquid : state.scene.liquids)
      liquids.insert(liquids.end(), {liquid.scalars[k].capacity, liquid.scalars[k].conductivity,
                                     liquid.scalars[k].source});
    if (k >= state.scalars.size()) continue;
    archive.reals[path + "/values"] = state.scalars[k].values;
    archive.reals[path + "/region-loss"] = state.scalars[k].region_loss;
    archive.reals[path + "/rates"] = {state.scalars[k].boundary_rate, state.scalars[k].source_rate,
                                      state.scalars[k].least, state.scalars[k].largest};
  }
}

/// Whether the values fit the mesh is for the solver to say.
void load_scalars(State& state, const Archive& archive) {
  const auto num_regions = static_cast<std::size_t>(state.scene.liquids.size());
  state.scalars.clear();
  for (const Interface& interface : state.scene.interfaces)
    if (interface.surfactant && interface.surfactant->adsorption &&
        static_cast<std::size_t>(interface.surfactant->adsorption->species) >=
            state.scene.scalars.size())
      reject_input("checkpoint: drop {} has a surfactant of an unknown species", interface.drop);
  for (std::size_t k = 0; k < state.scene.scalars.size(); ++k) {
    const std::string path = fmt::format("evolution/scalar{}", k);
    const auto& liquids = entry_of_size(archive.reals, path + "/liquids", 3 * num_regions);
    for (const RegionId region : state.scene.liquids.ids()) {
      const double* row = liquids.data() + std::ptrdiff_t{3} * region.value;
      state.scene.liquids[region].scalars.push_back(
          {.capacity = row[0], .conductivity = row[1], .source = row[2]});
    }
    const auto values = archive.reals.find(path + "/values");
    if (values == archive.reals.end()) reject_input("checkpoint: {}/values is missing", path);
    const auto loss = archive.reals.find(path + "/region-loss");
    if (loss == archive.reals.end() ||
        (!loss->second.empty() && loss->second.size() != num_regions))
      reject_input("checkpoint: {}/region-loss does not fit the liquids", path);
    const auto& rates = entry_of_size(archive.reals, path + "/rates", 4);
    state.scalars.push_back({values->second, rates[0], rates[1], rates[2], rates[3], loss->second});
  }
}

// Densities, and the flow that a step begins with. Liquids without inertia write nothing.
void save_flow(const State& state, Archive& archive) {
  if (!has_inertia(state.scene)) return;
  std::vector<double>& densities = archive.reals["evolution/densities"];
  for (const Liquid& liquid : state.scene.liquids) densities.push_back(liquid.density);
  if (!state.flow) return;
  const NodalFlow& flow = *state.flow;
  archive.reals["evolution/flow/x"] = flat(Field<VertexId, Vec3>(flow.x));
  archive.reals["evolution/flow/v"] = flat(Field<VertexId, Vec3>(flow.v));
  archive.reals["evolution/flow/p"] = flow.p;
  archive.reals["evolution/flow/sums"] = {flow.power.in,           flow.power.dissipation,
                                          flow.power.kinetic_rate, state.momentum_lost,
                                          state.energy_lost,       state.record.courant};
}

/// Whether the values fit the mesh is for the solver to say.
void load_flow(State& state, const Archive& archive) {
  state.flow.reset();
  const auto densities = archive.reals.find("evolution/densities");
  if (densities == archive.reals.end()) return;
  if (densities->second.size() != static_cast<std::size_t>(state.scene.liquids.size()))
    reject_input("checkpoint: evolution/densities does not fit the liquids");
  for (const RegionId region : state.scene.liquids.ids())
    state.scene.liquids[region].density = densities->second[static_cast<std::size_t>(region.value)];
  if (!archive.reals.contains("evolution/flow/v")) return;
  const auto rows = [&](const std::string& name) {
    const Field<VertexId, Vec3> all = vectors<VertexId>(entry_of_rows(archive.reals, name, 3));
    return std::vector<Vec3>(all.begin(), all.end());
  };
  const auto& sums = entry_of_size(archive.reals, "evolution/flow/sums", 6);
  state.flow = {rows("evolution/flow/x"),
                rows("evolution/flow/v"),
                entry_of_rows(archive.reals, "evolution/flow/p", 1),
                {sums[0], sums[1], sums[2]}};
  state.momentum_lost = sums[3];
  state.energy_lost = sums[4];
  state.record.courant = sums[5];
}

Field<RegionId, Liquid> load_liquids(const Archive& archive, std::size_t num_interfaces) {
  const auto& values = entry_of_size(archive.reals, "evolution/liquids", 4 * (num_interfaces + 1));
  Field<RegionId, Liquid> liquids;
  for (std::size_t k = 0; k < values.size(); k += 4)
    liquids.add(
        {.viscosity = values[k], .body_force = Vec3(values[k + 1], values[k + 2], values[k + 3])});
  load_laws(archive, liquids);
  return liquids;
}

void save_record(const StepRecord& record, Archive& archive) {
  const VertexTravel& travel = record.travel;
  archive.reals["evolution/step-record"] = {record.error.value_or(-1.0), travel.displacement,
                                            travel.slip, travel.neck_loss};
  archive.integers["evolution/step-bound"] = {static_cast<std::int64_t>(record.bound)};
  archive.integers["evolution/mesh-kept"] = {record.is_mesh_kept ? 1 : 0};
}

// Checkpoints of versions without step control have no record.
StepRecord load_record(const Archive& archive) {
  StepRecord record;
  if (!archive.reals.contains("evolution/step-record")) return record;
  const auto& values = entry_of_size(archive.reals, "evolution/step-record", 4);
  const std::int64_t bound = entry_of_size(archive.integers, "evolution/step-bound", 1)[0];
  if (bound < 0 || bound > static_cast<std::int64_t>(StepBound::convection))
    reject_input("checkpoint entry \"evolution/step-bound\" = {} is no bound of a step", bound);
  record.bound = static_cast<StepBound>(bound);
  if (values[0] >= 0.0) record.error = values[0];
  record.travel = {values[1], values[2], values[3]};
  if (archive.integers.contains("evolution/mesh-kept"))
    record.is_mesh_kept = entry_of_size(archive.integers, "evolution/mesh-kept", 1)[0] != 0;
  return record;
}

/// Adds the concentration that an interface of a scene with surfactant carries to its new fields.
void keep_concentration(const Interface& interface, SurfaceFields& fields) {
  const auto& old = interface.fields.on_vertices;
  const auto at = std::ranges::find(old, kSurfactantField, &CarriedField<VertexId>::name);
  if (at != old.end()) fields.on_vertices.push_back(*at);
}

}  // namespace

void set_interface_fields(State& state, std::vector<SurfaceFields> fields) {
  std::vector<Interface>& interfaces = state.scene.interfaces;
  if (fields.size() != interfaces.size())
    reject_input("fields are given for {} interfaces of {}", fields.size(), interfaces.size());
  for (std::size_t i = 0; i < fields.size(); ++i) {
    keep_concentration(interfaces[i], fields[i]);
    check_fields(fields[i], interfaces[i].mesh);
    if (!have_same_fields(fields[0], fields[i]))
      reject_input("interface {} has other fields than interface 0", i);
  }
  for (std::size_t i = 0; i < fields.size(); ++i) interfaces[i].fields = std::move(fields[i]);
}

void save(const State& state, Archive& archive) {
  const std::vector<Interface>& interfaces = state.scene.interfaces;
  MENISCUS_ASSERT(state.volume_shift.size() == interfaces.size(), "{} shifts of {} interfaces",
                  state.volume_shift.size(), interfaces.size());
  archive.reals["evolution/time"] = {state.t, state.dt};
  archive.integers["evolution/step"] = {state.step, state.iterations};
  save_record(state.record, archive);
  archive.integers["evolution/interfaces"] = {static_cast<std::int64_t>(interfaces.size())};
  archive.reals["evolution/corrections"] = state.volume_shift;
  archive.integers["evolution/tolerates-shift"] = {state.tolerates_shift ? 1 : 0};
  const Vec3& start = state.start_centroid;
  archive.reals["evolution/field-excess"] = {state.field_excess.above, state.field_excess.below};
  archive.reals["evolution/centroid"] = {start.x(), start.y(), start.z()};
  for (std::size_t i = 0; i < interfaces.size(); ++i) {
    save_interface(interfaces[i], i, archive);
    state.surfaces->save(interfaces[i].mesh, archive, interface_path(i, "unscaled"));
  }
  save_liquids(state.scene, archive);
  save_laws(state.scene, archive);
  save_scalars(state, archive);
  save_flow(state, archive);
  save_events(state.events, archive);
  if (state.mesh) state.mesh->save(archive);
}

void load(State& state, const Archive& archive) {
  const auto& time = entry_of_size(archive.reals, "evolution/time", 2);
  state.t = time[0];
  state.dt = time[1];
  const auto& step = entry_of_size(archive.integers, "evolution/step", 2);
  state.step = step[0];
  state.iterations = static_cast<int>(step[1]);
  state.record = load_record(archive);
  const auto count =
      static_cast<std::size_t>(entry_of_size(archive.integers, "evolution/interfaces", 1)[0]);
  state.scene.interfaces.clear();
  for (std::size_t i = 0; i < count; ++i)
    state.scene.interfaces.push_back(load_interface(archive, i));
  if (const auto fault = find_surfactant_fault(state.scene))
    reject_input("checkpoint: {}", fault->text);
  state.scene.liquids = load_liquids(archive, count);
  require_sound(state);
  load_scalars(state, archive);
  load_flow(state, archive);
  state.events = load_events(archive);
  state.volume_shift = entry_of_size(archive.reals, "evolution/corrections", count);
  state.tolerates_shift = entry_of_size(archive.integers, "evolution/tolerates-shift", 1)[0] != 0;
  const auto& excess = entry_of_size(archive.reals, "evolution/field-excess", 2);
  state.field_excess = {excess[0], excess[1]};
  state.start_centroid = Vec3(entry_of_size(archive.reals, "evolution/centroid", 3).data());
  for (std::size_t i = 0; i < count; ++i)
    state.surfaces->load(state.scene.interfaces[i].mesh, archive, interface_path(i, "unscaled"));
  if (state.mesh) state.mesh->load(archive, state.scene);
}

}  // namespace meniscus
