#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "meniscus/case/case.hpp"
#include "meniscus/case/concentrations.hpp"
#include "meniscus/case/outer_boundary.hpp"
#include "meniscus/case/surface_source.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/core/log.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/scene/interface_tension.hpp"
#include "meniscus/surface/reconstructed_surface.hpp"

namespace meniscus {
namespace {

/// Throws InvalidInput, naming the size that is too small, when a drop reaches beyond a box, sphere
/// or cylinder. A coarse triangulation lies inside that shape; find_conflict checks against its
/// faces.
void require_within_domain(const Case& c, const SurfaceMesh& drop, int index) {
  Vec3 reach = Vec3::Zero();  // [R0] largest |x|, |y|, |z|
  double from_origin = 0.0, from_axis = 0.0;
  for (const Vec3& x : drop.x) {
    reach = reach.cwiseMax(x.cwiseAbs());
    from_origin = std::max(from_origin, x.norm());
    from_axis = std::max(from_axis, std::hypot(x.y(), x.z()));
  }
  const auto require = [&](const std::string& path, double size, double needed) {
    if (needed < size) return;
    if (!c.settings.is_given(
            path))  // a default has no line in the file, so the message names the drop's
      reject_input("{}: drop {} reaches {:.6g} from the origin, and {} is {} by default (unit: R0)",
                   c.settings.source(fmt::format("drop[{}]", index)), index, needed, path, size);
    c.settings.reject(path, "must exceed the reach of drop {}, {:.6g} (unit: R0)", index, needed);
  };
  switch (c.domain.shape) {
    case DomainCase::Shape::box: {
      const bool is_cube = !c.settings.is_given("domain.half-widths");
      for (int axis = 0; axis < 3; ++axis)
        require(is_cube ? "domain.half-width" : "domain.half-widths", c.domain.half_widths[axis],
                reach[axis]);
      return;
    }
    case DomainCase::Shape::sphere:
      return require("domain.radius", c.domain.radius, from_origin);
    case DomainCase::Shape::cylinder:
      require("domain.half-length", c.domain.half_length, reach.x());
      return require("domain.radius", c.domain.radius, from_axis);
    case DomainCase::Shape::file:
    case DomainCase::Shape::unbounded:
      return;
  }
}

Interface make_interface(const Case& c, int index, const WarningListener& warn) {
  const DropCase& drop = c.drops[static_cast<std::size_t>(index)];
  Interface result;
  result.drop = index;
  result.mesh = initial_surface(c, index, warn);
  result.inside = RegionId{index + 1};
  result.outside = RegionId{0};
  result.tension = std::isinf(c.Ca) ? 0.0 : drop.tension_ratio / c.Ca;
  result.C0 = drop.nodes / (4.0 * std::numbers::pi);
  result.volume = result.initial_volume =
      ReconstructedSurface(result.mesh, c.evolution.surface).volume();
  MENISCUS_ASSERT(result.volume > 0.0, "drop {} has a volume of {:g}", index, result.volume);
  result.surfactant = drop.surfactant;
  return result;
}

/// Gives every interface a concentration if one has a surfactant: 1, or 0 where there is none.
void spread_surfactants(Scene& scene) {
  if (!has_surfactant(scene)) return;
  for (Interface& interface : scene.interfaces)
    interface.fields.on_vertices.push_back(
        {.name = kSurfactantField,
         .unit = "",
         .transfer = FieldTransfer::conserved,
         .values =
             VertexField<double>(interface.mesh.num_vertices(), interface.surfactant ? 1.0 : 0.0)});
}

/// Sets the region outside each interface: the smallest drop that encloses it, else the matrix.
/// Overlaps are found later, by find_conflict.
void nest(std::vector<Interface>& interfaces) {
  for (Interface& inner : interfaces) {
    const Interface* around = nullptr;
    for (const Interface& outer : interfaces) {
      if (&outer == &inner || outer.volume <= inner.volume) continue;
      if (around != nullptr && outer.volume >= around->volume) continue;
      if (encloses(outer.mesh, inner.mesh.x[VertexId{0}])) around = &outer;
    }
    if (around != nullptr) inner.outside = around->inside;
  }
}

void add_drops(const Case& c, Scene& scene, const WarningListener& warn) {
  for (std::size_t i = 0; i < c.drops.size(); ++i) {
    scene.interfaces.push_back(make_interface(c, static_cast<int>(i), warn));
    require_within_domain(c, scene.interfaces.back().mesh, static_cast<int>(i));
  }
  nest(scene.interfaces);
  for ([[maybe_unused]] const Interface& interface : scene.interfaces)
    MENISCUS_ASSERT(interface.inside.value < scene.liquids.size() &&
                        interface.outside.value < scene.liquids.size() &&
                        interface.inside != interface.outside,
                    "drop {} lies between regions {} and {}", interface.drop,
                    interface.inside.value, interface.outside.value);
}

/// The drop that a message about a conflict names. It is the later of the first two drops that
/// touch, else the first one that is not inside the boundary.
std::size_t drop_in_conflict(const Scene& scene) {
  const auto& interfaces = scene.interfaces;
  for (std::size_t i = 0; i < interfaces.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (find_intersection(interfaces[j].mesh, interfaces[i].mesh)) return i;
  const auto is_first_to = [&](const auto& is_in_fault) {
    return static_cast<std::size_t>(std::ranges::find_if(interfaces, is_in_fault) -
                                    interfaces.begin());
  };
  const std::size_t touching = is_first_to([&](const Interface& interface) {
    return find_intersection(interface.mesh, scene.boundary.mesh).has_value();
  });
  if (touching < interfaces.size()) return touching;
  return is_first_to([&](const Interface& interface) {
    return !encloses(scene.boundary.mesh, interface.mesh.x[VertexId{0}]);
  });
}

void require_no_conflict(const Case& c, const Scene& scene) {
  const auto conflict = find_conflict(scene);
  if (!conflict) return;
  reject_input("{}: {}", c.settings.source(fmt::format("drop[{}]", drop_in_conflict(scene))),
               conflict->text);
}

/// ∮|v·n| dS of the imposed velocities, the scale for their net flux [G R0³].
double gross_flux(const OuterBoundary& boundary, double t) {
  double gross = 0.0;
  for (const FaceId f : boundary.mesh.faces.ids()) {
    const BoundaryCondition& condition = boundary.patches[boundary.patch[f]].condition;
    const auto* imposed = std::get_if<ImposedVelocity>(&condition);
    if (imposed == nullptr) continue;
    Vec3 mean = Vec3::Zero();
    for (const VertexId v : boundary.mesh.faces[f])
      mean += imposed->velocity(boundary.mesh.x[v], t) / 3.0;
    gross += std::abs(mean.dot(face_area_vector(boundary.mesh, f)));
  }
  return gross;
}

/// Throws InvalidInput when the imposed velocities have a net flux. Interpolation on flat faces
/// gives one of O(h²), which the solver projects out; a wrong profile gives far more.
void require_no_net_inflow(const Case& c, const Scene& scene) {
  // A parabola on a disc of 63 faces misses 2.6 % of its flux, on one of 27 faces 5.2 %.
  constexpr double kInterpolation = 0.05;
  if (has_open_patch(scene)) return;
  std::vector<double> times{0.0};
  for (const ImposedFlow::Entry& entry : c.flow.schedule())
    times.push_back(entry.time + entry.ramp);
  for (const double t : times) {
    const double net = imposed_flux(scene, t), gross = gross_flux(scene.boundary, t);
    if (std::abs(net) > kInterpolation * gross)
      reject_input(
          "{}: domain.patch: at t = {:.6g} the imposed velocities carry {:.4g} R0³G {} in sum; "
          "make them balance or one patch open",
          c.settings.source("domain.patch[0]"), t, std::abs(net), net > 0.0 ? "out" : "in");
  }
}

/// What the scalars meet in the matrix, 0, or in a drop, from 1.
std::vector<ScalarLiquid> scalars_in(const Case& c, std::size_t liquid) {
  std::vector<ScalarLiquid> result;
  for (const ScalarCase& each : c.scalars) result.push_back(each.liquids[liquid]);
  return result;
}

double squared_distance(const SurfaceMesh& mesh, const Vec3& position) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& x : mesh.x) least = std::min(least, (x - position).squaredNorm());
  return least;
}

/// Of the drop's liquid less the matrix's, per volume [μ_out G/R0].
Vec3 weight(const Case& c, const DropCase& drop) {
  if (c.gravity.isZero(0.0)) return Vec3::Zero();
  return (drop.density_ratio - 1.0) / c.Ca * c.gravity;
}

}  // namespace

void log_warning(const std::string& text) { log::warning("{}", text); }

Scene build_surroundings(const Case& c, const WarningListener& warn) {
  Scene scene;
  scene.Ca = c.Ca;
  scene.flow = c.flow;
  scene.is_unbounded = c.domain.shape == DomainCase::Shape::unbounded;
  if (!scene.is_unbounded) scene.boundary = build_boundary(c, warn);
  for (const ScalarCase& each : c.scalars) scene.scalars.push_back(each.scalar);
  scene.liquids.add({.viscosity = 1.0,
                     .density = c.reynolds,
                     .body_force = c.matrix_body_force,
                     .law = c.matrix_law,
                     .scalars = scalars_in(c, 0)});
  for (std::size_t i = 0; i < c.drops.size(); ++i)
    scene.liquids.add({.viscosity = c.drops[i].viscosity_ratio,
                       .density = c.reynolds * c.drops[i].density_ratio,
                       .body_force = c.drops[i].body_force + weight(c, c.drops[i]),
                       .law = c.drops[i].law,
                       .scalars = scalars_in(c, i + 1)});
  return scene;
}

Scene build_scene(const Case& c, const WarningListener& warn) {
  Scene scene = build_surroundings(c, warn);
  add_drops(c, scene, warn);
  MENISCUS_ASSERT(scene.interfaces.size() == c.drops.size(), "{} interfaces of {} drops",
                  scene.interfaces.size(), c.drops.size());
  spread_surfactants(scene);
  require_no_conflict(c, scene);
  require_no_net_inflow(c, scene);
  require_concentrations(c, scene);
  return scene;
}

std::string source_of_surface(const Case& c, const Scene& scene,
                              const std::optional<Vec3>& position) {
  std::string path = "drop[0]";
  if (!position) return c.settings.source(path);
  double nearest = std::numeric_limits<double>::infinity();
  const auto offer = [&](const SurfaceMesh& mesh, const std::string& its_path) {
    const double distance = squared_distance(mesh, *position);
    if (distance >= nearest) return;
    nearest = distance;
    path = its_path;
  };
  for (const Interface& interface : scene.interfaces)
    offer(interface.mesh, fmt::format("drop[{}]", interface.drop));
  if (!scene.is_unbounded) offer(scene.boundary.mesh, "domain");
  return c.settings.source(path);
}

}  // namespace meniscus
