#include <cmath>
#include <optional>
#include <string>

#include "meniscus/case/case_parts.hpp"
#include "meniscus/case/words.hpp"

namespace meniscus {
namespace {

/// [R0] With [scale]: R0 is the size of a drop.
constexpr double kLargestDrop = 100.0;

double read_radius(Settings& settings, const std::string& path) {
  const double radius = settings.number(path);
  settings.require_metres(path, radius, kLargestDrop);
  return radius;
}

Vec3 read_axes(Settings& settings, const std::string& path) {
  Vec3 axes = settings.vector(path);
  settings.require_metres(path, axes.minCoeff(), kLargestDrop);
  // The number of vertices grows as N0 times the ratio of axes. Threads in experiments are up to
  // some 300 times longer than wide.
  constexpr double kLargestRatio = 1000.0;
  if (axes.maxCoeff() > kLargestRatio * axes.minCoeff())
    settings.reject(path, "must not differ by more than a factor {}", kLargestRatio);
  return axes;
}

DropShapeCase read_shape(Settings& settings, const std::string& table) {
  std::string found;
  for (const char* name : {"radius", "axes", "surface", "from-run"}) {
    const std::string path = fmt::format("{}.{}", table, name);
    if (!settings.is_given(path)) continue;
    if (!found.empty())
      settings.reject(path, "conflicts with {}: a drop has one shape", schema::leaf(found));
    found = path;
  }
  if (found.empty() && settings.is_added(table))
    reject_input(
        "{0}: there is no {1}; to add it, set one of {1}.radius, {1}.axes, {1}.surface, "
        "{1}.from-run too",
        settings.source(table), table);
  if (found.empty())
    reject_input("{}: {} needs one of radius, axes, surface, from-run", settings.source(table),
                 schema::without_indices(table));
  const std::string_view kind = schema::leaf(found);
  if (kind == "radius") return BallShape{read_radius(settings, found)};
  if (kind == "axes") return EllipsoidShape{read_axes(settings, found)};
  if (kind == "surface") return FileShape{settings.file(found), settings.flag(table + ".repair")};
  RunShape shape{settings.file(found), std::nullopt};
  if (settings.is_given(table + ".from-drop")) shape.drop = settings.whole(table + ".from-drop");
  return shape;
}

EquationOfState read_equation_of_state(Settings& settings, const std::string& table) {
  const auto kind = settings.choice(table + ".equation-of-state", words::equations_of_state);
  const std::string path = table + ".elasticity";
  const double elasticity = settings.number(path);
  if (kind == words::StateKind::linear) return LinearState{elasticity};
  const LangmuirState law{elasticity, settings.number(table + ".coverage")};
  if (!(zero_tension_concentration(law) > 1.0))
    settings.reject(path,
                    "leaves no tension at the initial concentration; with this coverage it "
                    "must be below {:.6g}",
                    -1.0 / std::log1p(-law.coverage));
  return law;
}

std::optional<Surfactant> read_surfactant(Settings& settings, const std::string& table) {
  bool is_given = settings.has_table(table);
  for (const char* key : {"equation-of-state", "elasticity", "coverage", "peclet"})
    is_given |= settings.is_given(fmt::format("{}.{}", table, key));
  if (!is_given) return {};
  return Surfactant{.state = read_equation_of_state(settings, table),
                    .diffusivity = 1.0 / settings.number(table + ".peclet")};
}

}  // namespace

std::vector<DropCase> read_drops(Settings& settings) {
  const int count = settings.count("drop");
  if (count == 0) reject_input("{}: needs at least one [[drop]]", settings.source(""));
  std::vector<DropCase> drops;
  for (int i = 0; i < count; ++i) {
    const std::string table = fmt::format("drop[{}]", i);
    drops.push_back({.shape = read_shape(settings, table),
                     .center = settings.vector(table + ".center"),
                     .viscosity_ratio = settings.number(table + ".viscosity-ratio"),
                     .law = read_viscosity_law(settings, table),
                     .tension_ratio = settings.number(table + ".tension-ratio"),
                     .nodes = settings.whole(table + ".nodes"),
                     .body_force = settings.vector(table + ".body-force"),
                     .surfactant = read_surfactant(settings, table + ".surfactant")});
  }
  return drops;
}

}  // namespace meniscus
