#include "meniscus/surface/repair/mend.hpp"

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/isotropic_remesh.hpp"
#include "meniscus/surface/repair/creases.hpp"
#include "meniscus/surface/repair/smoothed_shapes.hpp"

namespace meniscus {
namespace {

/// Normals turn by 42° on an icosahedron, the coarsest sphere there is to be remeshed.
constexpr std::array<Rounding, 5> kRoundings{
    {{70.0, 0}, {70.0, 1}, {70.0, 2}, {70.0, 4}, {50.0, 0}}};
constexpr std::array<double, 4> kMargins{0.5, 1.0, 2.0, 3.0};  // mean edges
constexpr double kEvenEdge = 0.5;  // of the mean edge: creases need faces to be rounded with

/// The remedies of `remesh_or_mend` for a surface, which they refer to, in their order.
std::vector<Remedy> remedies(const SurfaceMesh& mesh, double volume) {
  const double edge = mean_edge(mesh);
  const auto even = [&mesh, edge, made = std::make_shared<std::optional<SurfaceMesh>>()] {
    if (!*made) *made = isotropic_remesh(mesh, kEvenEdge * edge);
    return *made;
  };
  const auto smooth = std::make_shared<SmoothedShapes>(mesh, edge);
  std::vector<Remedy> all;
  all.reserve(2 * kRoundings.size() + kMargins.size() + kSmoothingLengths.size() + 1);
  for (const Rounding& rounding : kRoundings)
    all.push_back({[&mesh, rounding] { return rounded_shape(mesh, rounding); }, volume});
  all.push_back({even, 0.0, true});
  for (const double margin : kMargins)
    all.push_back(
        {[&mesh, margin] { return capped_shape(mesh, kRoundings.front().crease_deg, margin); },
         volume});
  for (const Rounding& rounding : kRoundings)
    all.push_back({[even, rounding] { return rounded_shape(*even(), rounding); }, volume});
  for (const double length : kSmoothingLengths)
    all.push_back({[&mesh, smooth, over = length * edge]() -> std::optional<SurfaceMesh> {
                     if (find_self_intersection(mesh)) return std::nullopt;  // it has no inside
                     return smooth->at(over);
                   },
                   0.0, false, length* edge});
  return all;
}

/// Whether a surface with that fault is the boundary of a body that it can be brought nearer to.
bool has_shape(FaultKind kind) {
  return kind != FaultKind::not_finite && kind != FaultKind::connectivity &&
         kind != FaultKind::no_volume;
}

}  // namespace

MendReport remesh_or_mend(SurfaceMesh& mesh, const RemeshOptions& options) {
  SurfaceFields none;
  return remesh_or_mend(mesh, options, none);
}

MendReport remesh_or_mend(SurfaceMesh& mesh, const RemeshOptions& given, SurfaceFields& fields) {
  MendReport report{.remesh = remesh(mesh, given, fields)};
  const std::optional<Fault>& fault = report.remesh.fault;
  if (!fault || !has_shape(fault->kind)) return report;
  RemeshOptions options = given;
  if (options.volume == 0.0) options.volume = enclosed_volume(mesh);
  const std::vector<Remedy> ladder = remedies(mesh, options.volume);
  return apply_first(mesh, fields, ladder, options).value_or(std::move(report));
}

}  // namespace meniscus
