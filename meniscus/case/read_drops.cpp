#include <string>

#include "meniscus/case/case_parts.hpp"

namespace meniscus {
namespace {

Vec3 read_axes(Settings& settings, const std::string& path) {
  Vec3 axes = settings.vector(path);
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
  if (kind == "radius") return BallShape{settings.number(found)};
  if (kind == "axes") return EllipsoidShape{read_axes(settings, found)};
  if (kind == "surface") return FileShape{settings.file(found)};
  RunShape shape{settings.file(found), std::nullopt};
  if (settings.is_given(table + ".from-drop")) shape.drop = settings.whole(table + ".from-drop");
  return shape;
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
                     .body_force = settings.vector(table + ".body-force")});
  }
  return drops;
}

}  // namespace meniscus
